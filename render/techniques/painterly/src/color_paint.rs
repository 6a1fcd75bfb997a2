//! Pigments for the colours of a painted picture. Each pixel becomes a film of the mixture that
//! shows its colour. This film is as high as the brushwork of the map there.

use std::sync::Arc;

use artmap::map::ArtMap;
use documents::hint::Explain;
use graphics::field::Field;
use graphics::picture::Picture;
use paint::document::{Lighting, Medium, Slots};
use paint::ground::{GroundError, GroundSpec};
use paint::layer::SLOTS;
use paint::light::{Light, PaintLightError};
use paint::separation::{
    FilmMaterials, PaintFilm, SeparationByHeight, SeparationError, SeparationSettings,
    choose_palette,
};
use pigment::PigmentLibrary;
use rayon::prelude::*;
use spectra::color::Rgb;

use super::paint_tones::Amounts;
use super::passes::PaintedPicture;

/// Height of a film in mm if the map has no relief. Photographs painted in strokes have this height
/// too.
const PLAIN_MM: f32 = 0.12;

/// Steps of the table that decodes encoded values.
const STEPS: usize = 4096;

/// Least number of pixels that a thread computes.
const PIXELS: usize = 1024;

/// How colours become films.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorPaintSettings {
    /// Films of at least `least_mm`, also in the furrows of the brushwork. Above `most_mm` the
    /// mixture no longer changes. You choose whether films hide what lies below them.
    pub films: SeparationSettings,
    /// Whether we raise the black of the picture to a tone that the pigments reach, so that
    /// differences in shadows survive.
    pub raised_black: bool,
}

impl Default for ColorPaintSettings {
    /// Films of 0.03 mm and more that hide the ground, with black raised.
    fn default() -> Self {
        let films = SeparationSettings { most_mm: 0.48, refined: false, ..Default::default() };
        Self { films, raised_black: true }
    }
}

/// Heights of films by the height of the brushwork.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmHeight {
    /// Height of the film in mm where the brushwork has its mean height.
    pub mean_mm: f32,
    /// Mean height of the brushwork in mm.
    pub brushwork_mm: f32,
}

impl FilmHeight {
    /// Films as high as the brushwork of a map. For maps without relief this is 0.12 mm.
    #[must_use]
    pub fn of(map: &ArtMap) -> Self {
        let heights = map.keys.iter().filter_map(|key| key.tile.height_mm.as_ref());
        let texels: Vec<&Field<f32>> = heights.collect();
        let count: usize = texels.iter().map(|heights| heights.values().len()).sum();
        if count == 0 {
            return Self { mean_mm: PLAIN_MM, brushwork_mm: 0.0 };
        }
        let all = texels.iter().flat_map(|heights| heights.values());
        let mean = (all.map(|mm| f64::from(*mm)).sum::<f64>() / count as f64) as f32;
        Self { mean_mm: mean, brushwork_mm: mean }
    }

    /// Films of another mean height. The relief stays.
    #[must_use]
    pub fn with_mean(self, mean_mm: f32) -> Self {
        Self { mean_mm, ..self }
    }
}

/// A palette that paints the colours of pictures.
#[derive(Debug, Clone)]
pub struct ColorPaint {
    library: Arc<PigmentLibrary>,
    slots: Slots,
    films: SeparationByHeight,
    least_mm: f32,
    /// Linear value of the darkest tone of the paintings.
    black: f32,
    /// Table from encoded to linear values, in even steps of the encoded value.
    linear: Vec<f32>,
}

impl ColorPaint {
    /// Finds the mixtures of the pigments `slots` of `library` for all colours, over `ground` under
    /// the light of `lighting`. This takes seconds.
    ///
    /// # Errors
    /// [`ColorPaintError`] for a light or a ground that cannot be used with the library, an empty
    /// palette, and settings out of range.
    ///
    /// # Panics
    /// If a slot refers to a pigment that the library lacks.
    pub fn new(
        library: Arc<PigmentLibrary>,
        slots: Slots,
        (ground, lighting): (&GroundSpec, &Lighting),
        settings: &ColorPaintSettings,
    ) -> Result<Self, ColorPaintError> {
        let light = Light::named(&library, &lighting.illuminant, &lighting.observer)?;
        let ground = ground.reflectance(&library)?;
        let scattering_per_mm = Medium::of(&library).scattering_per_mm;
        let materials =
            FilmMaterials { library: &library, slots: &slots, ground: &ground, scattering_per_mm };
        let film = PaintFilm::at_nodes(materials, &light.quadrature);
        let films = SeparationByHeight::new(film, &settings.films)?;
        let black = if settings.raised_black { films.black() } else { 0.0 };
        let least_mm = settings.films.least_mm as f32;
        Ok(Self { library, slots, films, least_mm, black, linear: linear_values() })
    }

    /// Up to eight pigments of `library` that come nearest to the colours of a painted picture.
    /// This takes seconds.
    ///
    /// # Errors
    /// The errors of [`Self::new`], and [`SeparationError::NoPigment`] if you cannot use any
    /// pigment of the library.
    pub fn palette(
        painted: &PaintedPicture,
        library: &PigmentLibrary,
        (ground, lighting): (&GroundSpec, &Lighting),
        settings: &ColorPaintSettings,
    ) -> Result<Slots, ColorPaintError> {
        let light = Light::named(library, &lighting.illuminant, &lighting.observer)?;
        let ground = ground.reflectance(library)?;
        let black = if settings.raised_black { library.saunderson.floor() as f32 } else { 0.0 };
        let table = linear_values();
        let covered = painted.color.values().iter().filter(|color| color[3] > 0.0);
        let colors: Vec<_> = covered.map(|color| target(&table, black, *color)).collect();
        let colors = Picture::from_values(colors.len(), 1, colors);
        let materials = FilmMaterials {
            library,
            slots: &Slots::default(),
            ground: &ground,
            scattering_per_mm: Medium::of(library).scattering_per_mm,
        };
        Ok(choose_palette(
            &colors,
            materials,
            |materials: FilmMaterials<'_>| PaintFilm::at_nodes(materials, &light.quadrature),
            &settings.films,
        )?
        .slots)
    }

    /// Library of the pigments.
    #[must_use]
    pub fn library(&self) -> &Arc<PigmentLibrary> {
        &self.library
    }

    /// Pigments of the paint by slot.
    #[must_use]
    pub fn slots(&self) -> &Slots {
        &self.slots
    }

    /// The mixtures by colour and height.
    #[must_use]
    pub fn films(&self) -> &SeparationByHeight {
        &self.films
    }

    /// Linear sRGB that we paint for an encoded colour: the colour itself, or with black raised.
    #[must_use]
    pub fn target(&self, color: [f32; 4]) -> [f32; 3] {
        target(&self.linear, self.black, color)
    }

    /// Paint of each pixel: the mixture of its colour, as high as the film of its brushwork. Where
    /// strokes cover only a share of a pixel, its paint is thinner by this share.
    ///
    /// # Panics
    /// If the colours and heights of `painted` differ in size.
    #[must_use]
    pub fn amounts(&self, painted: &PaintedPicture, film: FilmHeight) -> Field<Amounts> {
        let PaintedPicture { color, height_mm } = painted;
        assert_eq!(color.bounds(), height_mm.bounds(), "colours and heights differ in size");
        let pixels = color.values().par_iter().zip(height_mm.values()).with_min_len(PIXELS);
        Field::from_values(
            color.width(),
            color.height(),
            pixels
                .map(|(&color, &height_mm): (&[f32; 4], &f32)| {
                    let cover = color[3];
                    let mut amounts = [0.0; SLOTS + 1];
                    if cover > 0.0 {
                        // Heights of pixels that are covered in part are lower by as much.
                        let brushwork_mm = height_mm / cover;
                        let film_mm = film.mean_mm + brushwork_mm - film.brushwork_mm;
                        let film_mm = film_mm.max(self.least_mm);
                        let heights = self.films.heights_mm(self.target(color), film_mm);
                        amounts.iter_mut().zip(heights).for_each(|(own, mm)| *own = cover * mm);
                    }
                    amounts
                })
                .collect(),
        )
    }
}

/// Linear values for encoded values from 0 to 1 in even steps. The last is repeated once, so that
/// interpolation at 1 finds a next value.
fn linear_values() -> Vec<f32> {
    (0..=STEPS + 1)
        .map(|step: usize| {
            let value = step.min(STEPS) as f64 / STEPS as f64;
            Rgb([value; 3]).linear().0[0] as f32
        })
        .collect()
}

/// Linear sRGB of an encoded colour, black raised to `black`.
fn target(table: &[f32], black: f32, [r, g, b, _]: [f32; 4]) -> [f32; 3] {
    [r, g, b].map(|value| {
        let place = value.clamp(0.0, 1.0) * STEPS as f32;
        let step = place as usize;
        let rest = place.fract();
        let linear = table[step] + rest * (table[step + 1] - table[step]);
        black + (1.0 - black) * linear
    })
}

/// The colours of a picture cannot be painted.
#[derive(Debug, thiserror::Error, Explain)]
pub enum ColorPaintError {
    /// The light cannot be used with the library.
    #[error(transparent)]
    Light(#[from] PaintLightError),
    /// The ground cannot be made.
    #[error(transparent)]
    Ground(#[from] GroundError),
    /// The pigments give no mixtures.
    #[error(transparent)]
    Separation(#[from] SeparationError),
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use glam::Vec3;
    use graphics::camera::Framing;
    use graphics::mesh::{Material, Mesh, Texture, Triangle};
    use graphics::picture::Photograph;
    use paint::amount::mm_from_quanta;
    use paint::document::Document;
    use paint::ground::GroundKind;
    use paint::scene::{picture, scene};
    use spectra::color::{Lab, RgbSpace, delta_e_ciede2000};

    use super::super::paint_tones::paint_layer;
    use super::super::painter::Painter;
    use super::super::settings::Settings;
    use super::super::test_scenes::map;
    use super::*;

    const SIZE: (usize, usize) = (160, 120);
    const MM_PER_TEXEL: f64 = 0.25;

    static COFFEE: &[u8] = include_bytes!("../../../../docs/images/coffee.jpg");

    /// A palette of eight oils over a panel.
    static PAINT: LazyLock<ColorPaint> = LazyLock::new(|| {
        let names = [
            "Lead White",
            "Chrome Yellow",
            "Vermilion",
            "Cochineal Lake",
            "Ultramarine",
            "Viridian",
            "Minium",
            "Bone Black",
        ];
        let library = PigmentLibrary::van_gogh_oils();
        let slots = paint::document::palette_slots(&names.map(str::to_owned), &library).unwrap();
        let ground = GroundKind::Panel.spec(1);
        let settings = ColorPaintSettings::default();
        ColorPaint::new(Arc::new(library), slots, (&ground, &level()), &settings).unwrap()
    });

    /// The default light, on a painting without relief.
    fn level() -> Lighting {
        Lighting { relief: 0.0, ..Lighting::default() }
    }

    fn settings() -> Settings {
        let text = "colour.from = \"model\"\nstrokes.width_px = 50";
        Settings::default().changed("test", text).unwrap()
    }

    /// A wavy sheet with a picture on it, in the brushwork of the made-up map.
    fn painted(texture: Texture) -> PaintedPicture {
        let side = 25;
        let texture_coordinates: Vec<[f32; 2]> = (0..side * side)
            .map(|index: usize| {
                [index % side, index / side].map(|at| at as f32 / (side - 1) as f32)
            })
            .collect();
        fn corner(x: usize, y: usize, side: usize) -> u32 {
            (x + y * side) as u32
        }
        let squares = (0..(side - 1) * (side - 1)).map(|at| (at % (side - 1), at / (side - 1)));
        let mut mesh = Mesh {
            positions: texture_coordinates
                .iter()
                .map(|&[u, v]| [4.0 * u, 3.0 - 3.0 * v, 0.1 * (9.0 * u).sin()])
                .collect(),
            texture_coordinates,
            colors: vec![[1.0; 3]; side * side],
            triangles: squares
                .flat_map(|(x, y)| {
                    let [a, b, c, d] = [
                        corner(x, y, side),
                        corner(x, y + 1, side),
                        corner(x + 1, y + 1, side),
                        corner(x + 1, y, side),
                    ];
                    [[a, b, c], [a, c, d]].map(|corners| Triangle { corners, material: 0 })
                })
                .collect(),
            materials: vec![Material { texture: Some(texture), ..Material::plain([1.0; 3]) }],
            ..Mesh::default()
        };
        mesh.normals = mesh.vertex_normals();
        let framing = Framing {
            azimuth_deg: 0.0,
            elevation_deg: 0.0,
            aspect: 4.0 / 3.0,
            ..Framing::default()
        };
        let camera = framing.fit(&mesh.positions);
        let mut painter = Painter::of_model(&mesh, &map(4), &settings()).unwrap();
        painter.paint(&camera, SIZE, 0.0).unwrap()
    }

    fn texture(width: usize, height: usize, color: impl Fn(f32, f32) -> [f32; 3]) -> Texture {
        let texels = (0..width * height)
            .map(|index: usize| {
                let [u, v] =
                    [(index % width) as f32 / width as f32, (index / width) as f32 / height as f32];
                let bytes = color(u, v).map(|value| (255.0 * value.clamp(0.0, 1.0) + 0.5) as u32);
                0xff00_0000 | bytes[2] << 16 | bytes[1] << 8 | bytes[0]
            })
            .collect();
        Texture { width: width as u32, height: height as u32, texels }
    }

    /// Warm and cool colours from dark to light.
    fn made_up() -> PaintedPicture {
        painted(texture(64, 48, |u, v| {
            let turn = Vec3::new(0.0, 2.1, 4.2) + 5.0 * u;
            (Vec3::splat(0.15 + 0.65 * v) + 0.12 * turn.map(f32::sin)).to_array()
        }))
    }

    fn coffee() -> PaintedPicture {
        let picture = Photograph::from_bytes("coffee.jpg", COFFEE).unwrap().on_canvas(160, 120);
        painted(texture(160, 120, |u, v| {
            let linear = picture[((u * 160.0) as usize, (v * 120.0) as usize)];
            Rgb(linear.map(f64::from)).encoded().0.map(|value| value as f32)
        }))
    }

    /// Side of a cell in mm at which strokes have the size that the map gives.
    fn cell_mm() -> f64 {
        let width_px = settings().for_size(SIZE.0, SIZE.1).strokes.width_px;
        super::super::test_scenes::SPACING as f64 * MM_PER_TEXEL / f64::from(width_px)
    }

    fn document(amounts: &Field<Amounts>) -> Document {
        let width = amounts.width();
        let height = amounts.height();
        let cell_mm = cell_mm();
        let library = PAINT.library().as_ref().clone();
        let ground = GroundKind::Panel.spec(1).build(width, height, cell_mm, &library).unwrap();
        let paint = paint_layer(amounts, cell_mm);
        let medium = Medium::of(&library);
        let slots = *PAINT.slots();
        let mut document = Document::bare("test", cell_mm, ground, library, medium, slots, level());
        document.push_dry(slots, paint);
        document
    }

    fn lab(rgb: [f32; 3]) -> Lab {
        let xyz = RgbSpace::Srgb.xyz_from_linear().apply(rgb.map(f64::from));
        Lab::from_xyz(xyz.into(), RgbSpace::Srgb.white())
    }

    /// Mean CIEDE2000 between the picture of the document and the colours, over the pixels that
    /// strokes cover with a colour in gamut. Also returns the number of these pixels, and the
    /// number of all covered pixels.
    fn difference(painted: &PaintedPicture) -> (f64, usize, usize) {
        let film = FilmHeight::of(&map(4));
        let document = document(&PAINT.amounts(painted, film));
        let light = Light::named(PAINT.library(), "D65", "1931-2").unwrap();
        let seen = picture(&document, &scene(&document, &light));
        let mut sum = 0.0;
        let mut within = 0;
        let mut covered = 0;
        for (seen, color) in seen.values().iter().zip(painted.color.values()) {
            if color[3] < 1.0 {
                continue;
            }
            covered += 1;
            let wanted = PAINT.target(*color);
            let off = delta_e_ciede2000(lab(wanted), lab([seen[0], seen[1], seen[2]]));
            if off > 1.0 && PAINT.films().is_out_of_gamut(wanted, film.mean_mm) {
                continue;
            }
            within += 1;
            sum += off;
        }
        (sum / f64::from(within), within as usize, covered)
    }

    #[test]
    fn pictures_of_the_paint_have_the_colours_of_the_painted_picture() {
        for (name, painted) in [("made up", made_up()), ("coffee", coffee())] {
            let (mean, within, covered) = difference(&painted);
            assert!(mean <= 1.5, "{name}: {mean}");
            assert!(covered > 8000 && 2 * within > covered, "{name}: {within} of {covered} pixels");
        }
    }

    #[test]
    fn totals_of_pigments_are_those_of_sums_in_double_precision() {
        let amounts = PAINT.amounts(&made_up(), FilmHeight::of(&map(4)));
        let document = document(&amounts);
        let totals = document.dry[0].paint.totals();
        let quantum = mm_from_quanta(1, document.cell_mm);
        let mut found_any = 0;
        for slot in 0..SLOTS {
            let wanted: f64 = amounts.values().iter().map(|amounts| f64::from(amounts[slot])).sum();
            let found = totals[slot] as f64 * quantum;
            assert!((found - wanted).abs() <= 1e-4 * wanted + 1e-6, "{slot}: {found} {wanted}");
            found_any += usize::from(wanted > 1.0);
        }
        assert!(found_any >= 4, "{found_any} pigments are in use");
    }

    /// Root mean square of the slopes of heights in mm on cells of a width.
    fn slope(heights: &Field<f32>, cell_mm: f64) -> f64 {
        let mut sum = 0.0;
        let mut count = 0;
        for y in 1..heights.height() {
            for x in 1..heights.width() {
                let here = heights[(x, y)];
                for other in [heights[(x - 1, y)], heights[(x, y - 1)]] {
                    if here > 0.0 && other > 0.0 {
                        sum += (f64::from(here - other) / cell_mm).powi(2);
                        count += 1;
                    }
                }
            }
        }
        (sum / f64::from(count)).sqrt()
    }

    #[test]
    fn paint_stands_as_high_as_the_brushwork_about_its_mean() {
        let painted = made_up();
        let film = FilmHeight::of(&map(4)).with_mean(0.3);
        let amounts = PAINT.amounts(&painted, film);
        let heights: Vec<f32> = amounts.values().iter().map(|mm| mm.iter().sum()).collect();
        let heights = Field::from_values(SIZE.0, SIZE.1, heights);
        let mut compared = 0;
        for ((found, relief), color) in
            heights.values().iter().zip(painted.height_mm.values()).zip(painted.color.values())
        {
            let wanted = if color[3] > 0.0 {
                color[3] * (0.3 + relief / color[3] - film.brushwork_mm).max(0.03)
            } else {
                0.0
            };
            assert!((found - wanted).abs() < 1e-5, "{found} {wanted}");
            compared += usize::from(color[3] == 1.0);
        }
        assert!(compared > 8000, "{compared}");
        let exemplar = map(4).keys[2].tile.height_mm.clone().unwrap();
        let ratio = slope(&heights, cell_mm()) / slope(&exemplar, MM_PER_TEXEL);
        assert!(ratio >= 0.5, "slopes are {ratio} of those of the map");
    }

    #[test]
    fn furrows_keep_the_least_film_and_part_of_a_pixel_has_part_of_the_paint() {
        let color =
            Field::from_values(3, 1, vec![[0.6, 0.5, 0.3, 1.0], [0.6, 0.5, 0.3, 0.25], [0.0; 4]]);
        let height_mm = Field::from_values(3, 1, vec![0.0, 0.05, 0.0]);
        let film = FilmHeight { mean_mm: 0.1, brushwork_mm: 0.2 };
        let amounts = PAINT.amounts(&PaintedPicture { color, height_mm }, film);
        let [furrow, part, none] = [0, 1, 2].map(|x: usize| amounts[(x, 0)].iter().sum::<f32>());
        assert!(
            (furrow - 0.03).abs() < 1e-6 && (part - 0.25 * 0.1).abs() < 1e-6,
            "{furrow} {part}"
        );
        assert_eq!(none, 0.0);
    }

    #[test]
    fn black_is_raised_to_what_the_pigments_reach() {
        let black = PAINT.target([0.0, 0.0, 0.0, 1.0]);
        assert!((0.01..0.08).contains(&black[0]), "{black:?}");
        assert!(PAINT.target([1.0; 4]).iter().all(|value| (value - 1.0).abs() < 1e-6));
        let grey = PAINT.target([0.5, 0.5, 0.5, 1.0])[0];
        let wanted = black[0] + (1.0 - black[0]) * Rgb([0.5; 3]).linear().0[0] as f32;
        assert!((grey - wanted).abs() < 1e-6, "{grey} {wanted}");
    }

    #[test]
    fn a_palette_is_chosen_for_the_colours_of_the_picture() {
        let library = PigmentLibrary::van_gogh_oils();
        fn color(at: usize) -> [f32; 4] {
            [0.75, 0.2 + 0.01 * at as f32, 0.1, 1.0]
        }
        let colors: Vec<[f32; 4]> = (0..30).map(color).chain([[0.0; 4]; 30]).collect();
        let painted = PaintedPicture {
            color: Field::from_values(60, 1, colors),
            height_mm: Field::filled(60, 1, 0.0),
        };
        let ground = GroundKind::Panel.spec(1);
        let settings = ColorPaintSettings::default();
        let slots =
            ColorPaint::palette(&painted, &library, (&ground, &level()), &settings).unwrap();
        let names: Vec<&str> =
            slots.iter().flatten().map(|&id| library[id].name.as_str()).collect();
        assert!(names.contains(&"Minium") || names.contains(&"Vermilion"), "{names:?}");
        assert!(!names.contains(&"Prussian Blue") && !names.contains(&"Ultramarine"), "{names:?}");
    }

    #[test]
    fn empty_palettes_and_unknown_lights_are_refused() {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let ground = GroundKind::Panel.spec(1);
        fn made(
            slots: Slots,
            lighting: &Lighting,
            ground: &GroundSpec,
            library: &Arc<PigmentLibrary>,
        ) -> ColorPaintError {
            let settings = ColorPaintSettings::default();
            ColorPaint::new(library.clone(), slots, (ground, lighting), &settings).unwrap_err()
        }
        let error = made(Slots::default(), &level(), &ground, &library);
        assert!(
            matches!(error, ColorPaintError::Separation(SeparationError::NoPigment)),
            "{error}"
        );
        assert!(error.hint().is_some());
        let candle = Lighting { illuminant: "candle".to_owned(), ..level() };
        let error = made(*PAINT.slots(), &candle, &ground, &library);
        assert!(matches!(error, ColorPaintError::Light(_)), "{error}");
    }
}
