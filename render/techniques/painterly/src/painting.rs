//! Paintings with pigments (a dry layer for each layer of strokes), pictures of the steps to them,
//! and frames for compositing: OpenEXR with cover, depth, height and direction.

use artmap::sample::PaintOfSamples;
use documents::hint::Explain;
use glam::{Vec2, Vec3};
use graphics::camera::Camera;
use graphics::coherence::Projection;
use graphics::compute::GreyImage;
use graphics::encoding::linear_from_encoded;
use graphics::export::{ExportError, float_exr};
use graphics::field::Field;
use paint::document::{Document, Lighting, Medium};
use paint::ground::GroundSpec;
use paint::technique::Stage;

use super::color_paint::{ColorPaint, ColorPaintSettings};
use super::paint_tones::{Amounts, paint_layer};
use super::painter::{BuiltGround, Painter, PainterError, over};
use super::passes::amounts;
use super::splats::{Lists, SIDE, StrokeSplat};

/// Amounts of pigments of all layers, and the pigments.
struct Mixed {
    of: PaintOfSamples,
    layers: Vec<Field<Amounts>>,
}

impl Painter {
    /// Paints the subject as [`Self::paint`] does, but with pigments. You get a painting with a dry
    /// layer for each layer of strokes and a cell for each pixel.
    ///
    /// If colours are the maps', amounts are the weighted means of the amounts that strokes show,
    /// so strokes that overlap do not pile up within a layer. If they are the subject's, each cell
    /// is a film of the mixture that shows its colour, as high as the brushwork. We mix it of up to
    /// eight pigments of the library ([`Self::set_pigments`]) that suit the picture.
    ///
    /// The width of a cell follows from the first map. For example, if its strokes are 3 mm apart
    /// and `strokes.width_px` is 30, a cell is 0.1 mm wide. We take 3 mm where the map does not
    /// give the distance of its strokes.
    ///
    /// # Errors
    /// The errors of [`Self::paint`], [`PainterError::NoPaint`] for the colours of maps without
    /// pigments, [`PainterError::Maps`] for maps with pigments that do not go together,
    /// [`PainterError::Colors`] for a library that cannot paint colours, and
    /// [`PainterError::Ground`] for a ground that we cannot make.
    pub fn painting(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
        seconds: f64,
        (title, ground): (&str, &GroundSpec),
    ) -> Result<Document, PainterError> {
        let mixed = match self.of_subject() {
            false => self.mixed_as_maps(camera, size, seconds)?,
            true => self.mixed_as_subject(camera, size, seconds, ground)?,
        };
        let Mixed { of: PaintOfSamples { library, slots }, layers } = mixed;
        let cell_mm = self.cell_mm(size);
        let ground =
            BuiltGround::reused_or_built(&mut self.ground, ground, (size, cell_mm), &library)?;
        let medium = Medium::of(&library);
        let library = library.as_ref().clone();
        let lighting = Lighting::default();
        let mut document = Document::bare(title, cell_mm, ground, library, medium, slots, lighting);
        for amounts in &layers {
            document.push_dry(slots, paint_layer(amounts, cell_mm));
        }
        Ok(document)
    }

    /// The paint that strokes of the maps show.
    fn mixed_as_maps(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
        seconds: f64,
    ) -> Result<Mixed, PainterError> {
        let (depth, layers) = self.splats(camera, size, seconds)?;
        let Some(paint) = self.paint_tones()? else { return Err(PainterError::NoPaint) };
        let overlap = &self.settings().overlap;
        let layers = layers.iter().enumerate();
        let layers = layers
            .map(|(layer, splats)| amounts(&depth, splats, &self.divide(layer), paint, overlap));
        Ok(Mixed { layers: layers.collect(), of: paint.of.clone() })
    }

    fn mixed_as_subject(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
        seconds: f64,
        ground: &GroundSpec,
    ) -> Result<Mixed, PainterError> {
        let (depth, layers) = self.splats(camera, size, seconds)?;
        let depth = depth.into();
        let layers = layers.iter().enumerate();
        let layers = layers.map(|(layer, splats)| self.painted(&depth, splats, layer));
        let layers = layers.collect::<Result<Vec<_>, _>>()?;
        let whole = layers[1..].iter().fold(layers[0].clone(), over);
        let (library, palette) = self.pigments();
        let lighting = Lighting::default();
        let under = (ground, &lighting);
        let settings = ColorPaintSettings::default();
        let slots = match palette {
            Some(slots) => slots,
            None => ColorPaint::palette(&whole, &library, under, &settings)?,
        };
        let paint = ColorPaint::new(library.clone(), slots, under, &settings)?;
        let layers = layers.iter().map(|layer| paint.amounts(layer, self.film())).collect();
        Ok(Mixed { of: PaintOfSamples { library, slots }, layers })
    }
}

/// Depths of the subject are shown from this grey (far) to white (near).
const FAR: f32 = 0.15;

impl Painter {
    /// The steps to the picture that [`Self::paint`] gives. The first step is the depth. For each
    /// layer, four steps show its strokes (each in a colour of its own where it is the strongest),
    /// their directions (as hues: red level, cyan upright), their tones, and what they paint. The
    /// last two steps are the height of the brushwork and the picture.
    ///
    /// # Errors
    /// The errors of [`Self::paint`].
    pub fn stages(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
        seconds: f64,
    ) -> Result<Vec<Stage>, PainterError> {
        let (depth, layers) = self.splats(camera, size, seconds)?;
        let mut named: Vec<(String, Field<[f32; 4]>)> = vec![("depth".to_owned(), greys(&depth))];
        let mut whole = None;
        let depth = GreyImage::from(depth);
        for (number, splats) in layers.iter().enumerate() {
            let strongest = strongest(depth.host(), splats);
            let mut shown = |name: &str, color: &dyn Fn(&StrokeSplat) -> Vec3| {
                let values = strongest
                    .values()
                    .iter()
                    .map(|index: &Option<u32>| match index {
                        Some(index) => color(&splats[*index as usize]).extend(1.0).to_array(),
                        None => [0.0; 4],
                    })
                    .collect();
                let picture = Field::from_values(size.0, size.1, values);
                named.push((format!("layer-{}-{name}", number + 1), picture));
            };
            shown("strokes", &|splat| own_color(splat));
            shown("directions", &|splat| hue(2.0 * splat.turn()));
            shown("tones", &|splat| Vec3::splat(self.tone_of(splat) / 100.0));
            let painted = self.painted(&depth, splats, number)?;
            named.push((format!("layer-{}-painted", number + 1), painted.color.clone()));
            whole = Some(match whole {
                None => painted,
                Some(lower) => over(lower, &painted),
            });
        }
        if let Some(whole) = whole {
            named.push(("height".to_owned(), heights(&whole.height_mm)));
            named.push(("picture".to_owned(), whole.color));
        }
        Ok(named.into_iter().map(|(name, picture)| Stage { name, picture }).collect())
    }
}

/// The strongest splat on the subject at each pixel.
pub(super) fn strongest(depth: &Field<f32>, splats: &[StrokeSplat]) -> Field<Option<u32>> {
    let width = depth.width();
    let height = depth.height();
    let lists = Lists::new(width, height, splats);
    let mut strongest = Field::filled(width, height, None);
    for y in 0..height {
        for x in 0..width {
            let mut best = 0.0;
            for &number in lists.of(y / SIDE * lists.across + x / SIDE) {
                let splat = &splats[number as usize];
                let off = Vec2::new(x as f32 + 0.5 - splat.x, y as f32 + 0.5 - splat.y);
                fn part(axis: [f32; 2], off: Vec2) -> f32 {
                    Vec2::from(axis).dot(off)
                }
                let square = part(splat.across, off).powi(2) + part(splat.along, off).powi(2);
                let plane = splat.depth + Vec2::from(splat.slope).dot(off);
                let hidden = plane > depth[(x, y)] + splat.tolerance;
                let weight = splat.weight * (1.0 - square);
                if weight > best && !hidden {
                    best = weight;
                    strongest[(x, y)] = Some(number);
                }
            }
        }
    }
    strongest
}

/// Depth as grey, the nearest white. Pixels that do not show the subject are transparent.
fn greys(depth: &Field<f32>) -> Field<[f32; 4]> {
    let seen = depth.values().iter().copied().filter(|depth| *depth < 1.0);
    let near = seen.clone().fold(1.0, f32::min);
    let far = seen.fold(0.0, f32::max);
    Field::from_values(
        depth.width(),
        depth.height(),
        depth
            .values()
            .iter()
            .map(|&depth: &f32| {
                if depth >= 1.0 {
                    return [0.0; 4];
                }
                let grey = 1.0 - (1.0 - FAR) * (depth - near) / (far - near).max(1e-6);
                [grey, grey, grey, 1.0]
            })
            .collect(),
    )
}

/// Height as grey: the highest white.
fn heights(heights: &Field<f32>) -> Field<[f32; 4]> {
    let most = heights.values().iter().copied().fold(1e-6, f32::max);
    let values = heights
        .values()
        .iter()
        .map(|height: &f32| {
            let grey = height / most;
            [grey, grey, grey, 1.0]
        })
        .collect();
    Field::from_values(heights.width(), heights.height(), values)
}

/// A colour that sets a stroke apart from its neighbours.
fn own_color(splat: &StrokeSplat) -> Vec3 {
    // Places in the map scatter over the whole of it.
    let place = splat.offset[0] * 7.0 + splat.offset[1] * 13.0;
    hue(std::f32::consts::TAU * place) * (0.55 + 0.4 * (splat.offset[0] * 29.0).fract().abs())
}

/// A colour of this hue in radians.
fn hue(angle: f32) -> Vec3 {
    let third = std::f32::consts::TAU / 3.0;
    Vec3::new(0.0, third, 2.0 * third).map(|shift| 0.5 + 0.5 * (angle - shift).cos())
}

/// Width of a pixel in mm: 96 pixels per inch.
const PX_MM: f64 = 25.4 / 96.0;

/// A frame for compositing cannot be made.
#[derive(Debug, thiserror::Error, Explain)]
pub enum CompositingError {
    /// The subject cannot be painted.
    #[error(transparent)]
    Painter(#[from] PainterError),
    /// The file cannot be made.
    #[error(transparent)]
    Export(#[from] ExportError),
}

impl Painter {
    /// The picture that [`Self::paint`] gives, as an OpenEXR file of 32-bit floats. `R`, `G`, `B`
    /// are linear sRGB times the cover, `A` is the cover, `Z` is the distance of the subject in
    /// front of the eye (infinite where there is none), and `height` is the height of the brushwork
    /// in mm. `direction.x` and `direction.y` are the unit direction of the strongest stroke of the
    /// uppermost layer that you see (x to the right, y downwards, 0 where there is none).
    ///
    /// # Errors
    /// The errors of [`Self::paint`], and [`CompositingError::Export`] for pictures that OpenEXR
    /// cannot hold.
    pub fn exr_frame(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
        seconds: f64,
    ) -> Result<Vec<u8>, CompositingError> {
        let (depth, layers) = self.splats(camera, size, seconds)?;
        let painted = self.picture(depth.clone(), &layers)?;
        let projection = Projection::new(camera, size.0, size.1);
        let [_, _, back] = camera.axes();
        let mut directions = vec![[0.0; 2]; size.0 * size.1];
        for splats in &layers {
            let strongest = strongest(&depth, splats);
            for (direction, index) in directions.iter_mut().zip(strongest.values()) {
                if let Some(index) = index {
                    let (sin, cos) = splats[*index as usize].turn().sin_cos();
                    *direction = [cos, sin];
                }
            }
        }
        let linear = linear_from_encoded(&painted.color);
        let [red, green, blue] = [0, 1, 2].map(|channel: usize| {
            linear.values().iter().map(|own| own[channel] * own[3]).collect::<Vec<f32>>()
        });
        let cover = linear.values().iter().map(|own| own[3]);
        let channels: [(&str, Vec<f32>); 8] = [
            ("R", red),
            ("G", green),
            ("B", blue),
            ("A", cover.collect()),
            (
                "Z",
                (0..size.0 * size.1)
                    .map(|index: usize| {
                        let at = (index % size.0, index / size.0);
                        match depth[at] < 1.0 {
                            true => (camera.eye - projection.unproject(at, depth[at])).dot(back),
                            false => f32::INFINITY,
                        }
                    })
                    .collect(),
            ),
            ("height", painted.height_mm.values().to_vec()),
            ("direction.x", directions.iter().map(|[x, _]| *x).collect()),
            ("direction.y", directions.iter().map(|[_, y]| *y).collect()),
        ];
        let channels = channels.into_iter().map(|(name, values)| (name.to_owned(), values));
        Ok(float_exr(size, PX_MM, channels.collect())?)
    }
}

#[cfg(test)]
mod tests {
    use super::super::settings::Settings;
    use super::super::test_scenes::map;
    use super::*;
    use graphics::camera::Framing;
    use graphics::mesh::Mesh;

    #[test]
    fn stages_end_with_the_picture_that_is_painted_without_them() {
        let mesh = Mesh::torus_knot(4000);
        let camera = Framing::default().fit(&mesh.positions);
        let mut settings = Settings::default();
        settings.layers.count = 2;
        let mut painter = Painter::of_model(&mesh, &map(2), &settings).unwrap();
        let stages = painter.stages(&camera, (96, 72), 0.0).unwrap();
        let names: Vec<&str> = stages.iter().map(|stage| &stage.name[..]).collect();
        assert_eq!((names.len(), names[0], names[2]), (11, "depth", "layer-1-directions"));
        assert_eq!(names[10], "picture");
        let painted = painter.paint(&camera, (96, 72), 0.0).unwrap().color;
        assert_eq!(stages[10].picture, painted);
        for stage in &stages[..5] {
            fn seen(picture: &Field<[f32; 4]>) -> f32 {
                picture.values().iter().filter(|pixel| pixel[3] > 0.5).count() as f32
            }
            let share = seen(&stage.picture) / seen(&painted);
            assert!((0.7..1.1).contains(&share), "{}: {share}", stage.name);
        }
    }
}
