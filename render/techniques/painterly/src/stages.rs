//! Pictures of what happens on the way to a painted one.

use glam::{Vec2, Vec3};
use graphics::camera::Camera;
use graphics::compute::GreyImage;
use graphics::field::Field;

use super::composed::over;
use super::error::PainterError;
use super::lists::{Lists, SIDE};
use super::painter::Painter;
use super::splat::StrokeSplat;

/// Depths of the subject are shown from this grey (far) to white (near).
const FAR: f32 = 0.15;

/// A picture of a step, encoded sRGB with cover.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Its content, in lower case with hyphens.
    pub name: String,
    /// The picture.
    pub picture: Field<[f32; 4]>,
}

impl Painter {
    /// The steps to the picture that [`Self::paint`] gives: depth; of each layer the strokes (each in
    /// a colour of its own where it is the strongest), their directions (as hues: red level, cyan
    /// upright), their tones and what they paint; the height of the brushwork; and the picture.
    ///
    /// # Errors
    /// Those of [`Self::paint`].
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
                let part = |axis: [f32; 2]| Vec2::from(axis).dot(off);
                let square = part(splat.across).powi(2) + part(splat.along).powi(2);
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

/// Depth as grey: the nearest white, nothing bare.
fn greys(depth: &Field<f32>) -> Field<[f32; 4]> {
    let seen = || depth.values().iter().copied().filter(|depth| *depth < 1.0);
    let near = seen().fold(1.0, f32::min);
    let far = seen().fold(0.0, f32::max);
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

/// A colour that tells a stroke from its neighbours.
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

#[cfg(test)]
mod tests {
    use graphics::camera::Framing;
    use graphics::mesh::Mesh;

    use super::super::made_up::map;
    use super::super::settings::Settings;
    use super::*;

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
            let seen = |picture: &Field<[f32; 4]>| {
                picture.values().iter().filter(|pixel| pixel[3] > 0.5).count() as f32
            };
            let share = seen(&stage.picture) / seen(&painted);
            assert!((0.7..1.1).contains(&share), "{}: {share}", stage.name);
        }
    }
}
