//! A photograph as the first, thin dry layer of a painting.

use documents::hint::Explain;
use graphics::picture::Photograph;
use graphics::tile::Rect;
use paint::amount::quanta_from_mm;
use paint::document::Document;
use paint::layer::Layer;
use paint::light::{Light, PaintLightError};
use paint::optics::LEVELLING_MM;
use paint::separation::{
    FilmMaterials, PaintFilm, Separation, SeparationError, SeparationSettings,
};

use super::stroke_painter::black_compensated;

/// Thin films through which the ground shows, from a coarse table. You start from this layer and
/// paint over it. It is not a copy of the photograph.
const THIN: SeparationSettings = SeparationSettings {
    lattice: 17,
    least_mm: 0.002,
    most_mm: 0.06,
    hides: false,
    refined: false,
};

/// Why a photograph cannot become a layer.
#[derive(Debug, thiserror::Error, Explain)]
pub enum FirstLayerError {
    /// The light of the painting is not known.
    #[error(transparent)]
    #[fault(Input)]
    Light(#[from] PaintLightError),
    /// The pigments of the painting give no separation.
    #[error(transparent)]
    Separation(#[from] SeparationError),
}

/// Paint of a dry layer that shows `photograph` on the ground of `document`, in its wet pigments
/// and under its light. We place the photograph in the middle, as large as the canvas allows
/// without stretching it. The rest of the canvas stays bare.
///
/// # Errors
/// [`FirstLayerError`] for an unknown light and for pigments that give no separation.
pub fn first_layer(photograph: &Photograph, document: &Document) -> Result<Layer, FirstLayerError> {
    let Document { library, slots, ground, medium, lighting, cell_mm, .. } = document;
    let light = Light::named(library, &lighting.illuminant, &lighting.observer)?;
    let scattering_per_mm = medium.scattering_per_mm;
    let materials =
        FilmMaterials { library, slots, ground: &ground.reflectance, scattering_per_mm };
    let separation = Separation::new(PaintFilm::at_nodes(materials, &light.quadrature), &THIN)?;
    let columns = document.wet.width();
    let rows = document.wet.height();
    let Rect { x, y, width, height } = fitted(photograph.size(), (columns, rows));
    let seen = photograph.on_canvas(width, height);
    let heights = separation.separate(&black_compensated(&seen, separation.black()));
    let mut part = Layer::empty(width, height);
    // So much vehicle levels the paint to even films.
    let levelling = if medium.films_break { quanta_from_mm(LEVELLING_MM, *cell_mm) } else { 0 };
    let cells = part.pigments.values_mut().iter_mut().zip(part.vehicle.values_mut());
    for ((pigments, vehicle), heights) in cells.zip(heights.values()) {
        *pigments = heights.map(|mm| quanta_from_mm(f64::from(mm), *cell_mm));
        *vehicle = if pigments.iter().any(|amount| *amount > 0) { levelling } else { 0 };
    }
    let mut paint = Layer::empty(columns, rows);
    paint.put((x, y), &part);
    Ok(paint)
}

/// The largest rectangle of the shape `size` in the middle of a canvas.
fn fitted(size: (usize, usize), (columns, rows): (usize, usize)) -> Rect {
    let scale = (columns as f64 / size.0 as f64).min(rows as f64 / size.1 as f64);
    let width = ((size.0 as f64 * scale).round() as usize).clamp(1, columns);
    let height = ((size.1 as f64 * scale).round() as usize).clamp(1, rows);
    Rect { x: (columns - width) / 2, y: (rows - height) / 2, width, height }
}

#[cfg(test)]
mod tests {
    use super::*;
    use graphics::export::png8;
    use graphics::field::Field;
    use paint::scene::{picture, scene};
    use paint::strokes::{Canvas, PaletteSpec, StrokeScript};
    use pigment::library::PigmentLibrary;
    use spectra::color::Rgb;

    #[test]
    fn a_photograph_fits_the_canvas_in_the_middle() {
        assert_eq!(fitted((400, 100), (200, 100)), Rect { x: 0, y: 25, width: 200, height: 50 });
        assert_eq!(fitted((10, 20), (100, 100)), Rect { x: 25, y: 0, width: 50, height: 100 });
    }

    #[test]
    fn the_layer_shows_the_colors_of_the_photograph() {
        let colors = [[150_u8, 60, 40], [60, 70, 130], [190, 170, 90], [120, 120, 120]];
        fn linear(color: [u8; 3]) -> [f32; 4] {
            let [r, g, b] = Rgb(color.map(|byte| f64::from(byte) / 255.0)).linear().0;
            [r as f32, g as f32, b as f32, 1.0]
        }
        let pixels = (0..800).map(|index| linear(colors[index % 40 / 10]));
        let seen = Field::from_values(40, 20, pixels.collect());
        let png = png8(&seen, 0.5).unwrap();
        let photograph = Photograph::from_bytes("made", &png.bytes).unwrap();
        let library = PigmentLibrary::van_gogh_oils();
        let canvas: Canvas = serde_json::from_str(
            r#"{"width_mm": 20, "height_mm": 20, "cell_mm": 0.5,
                "ground": {"kind": "panel", "relief_mm": 0}}"#,
        )
        .unwrap();
        let tubes = ["Zinc White", "Chrome Yellow", "Vermilion", "Ultramarine", "Bone Black"];
        let script = StrokeScript::new("", "", canvas, PaletteSpec::from_names(tubes));
        let (mut document, _) = script.surfaces(&library, None).unwrap();
        let layer = first_layer(&photograph, &document).unwrap();
        assert_eq!(layer.cell(0).volume(), 0, "above the photograph the ground is bare");
        document.push_dry(document.slots, layer);
        let lighting = &document.lighting;
        let light = Light::named(&library, &lighting.illuminant, &lighting.observer).unwrap();
        let shown = picture(&document, &scene(&document, &light));
        for (field, color) in colors.iter().enumerate() {
            let [red, green, blue, _] = shown[(10 * field + 5, 20)];
            for (found, wanted) in [red, green, blue].into_iter().zip(linear(*color)) {
                let off = found - wanted;
                // Black paint reflects about 4 %, so shadows are raised by as much.
                assert!((-0.03..=0.07).contains(&off), "field {field}: {found} for {wanted}");
            }
        }
    }
}
