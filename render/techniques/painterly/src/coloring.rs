//! The coordinates in which we mix strokes, and the map's brushwork on the model's colours.
//!
//! We follow Yan and others (2008), equations 9 and 10. We take the mean of all texels of the map
//! from each texel, and add the rest to the colour of the splat. Lightness and chroma each have
//! their own share. Both steps are linear, so we lay the detail out with the map, and add the
//! weighted mean of the splats' colours to the weighted mean of details.

use artmap::map::ArtMap;
use glam::Vec3;
use graphics::encoding::lab_from_linear;
use graphics::field::Field;
use graphics::picture::Picture;
use rayon::prelude::*;
use spectra::color::{Lab, Rgb, RgbSpace};

use super::settings::{ColorSettings, ColorSource, ColorSpace};

/// Steps of the table that encodes linear light.
const STEPS: usize = 4096;

/// Coordinates of colours while they are mixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub(super) enum Coordinates {
    /// Encoded sRGB.
    Encoded = 0,
    /// YUV (Rec. 601) of encoded sRGB.
    Yuv = 1,
    /// CIELAB under the white of sRGB.
    Cielab = 2,
}

/// Kind of subject.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SubjectKind {
    /// A model. Its colours are without light. Tones add this light.
    Model,
    /// A picture. Its colours have their light already.
    Picture,
}

/// How the maps and the subject make colours.
#[derive(Debug, Clone)]
pub(super) struct Coloring {
    pub(super) coordinates: Coordinates,
    maps: Vec<MapColors>,
    kind: SubjectKind,
    /// Whether splats add the model's colour.
    of_model: bool,
    pub(super) rgb_from_xyz: [[f32; 3]; 3],
    pub(super) white: [f32; 3],
    /// Table from linear to encoded values, in even steps of the linear value.
    pub(super) encoded: Vec<f32>,
}

/// How the texels of a map become detail: we subtract the mean and scale the rest.
#[derive(Debug, Clone, Copy)]
struct MapColors {
    /// Mean of all texels.
    mean: Vec3,
    /// Factor on the difference from the mean, for each coordinate.
    share: Vec3,
}

impl Coloring {
    /// Colours of `maps` on a subject that shows `colors` (encoded sRGB, each with its area).
    pub(super) fn new(
        maps: &[&ArtMap],
        colors: &[(Vec3, f64)],
        settings: &ColorSettings,
        kind: SubjectKind,
    ) -> Self {
        let of_model = match settings.from {
            ColorSource::Auto => kind == SubjectKind::Picture,
            from => from == ColorSource::Model,
        };
        let coordinates = match (of_model, settings.space) {
            (false, _) => Coordinates::Encoded,
            (true, ColorSpace::Cielab) => Coordinates::Cielab,
            (true, ColorSpace::Yuv) => Coordinates::Yuv,
        };
        let rgb_from_xyz = RgbSpace::Srgb.xyz_from_linear().inverse();
        let columns = [0, 1, 2].map(|axis: usize| {
            let unit = std::array::from_fn(|i| if i == axis { 1.0 } else { 0.0 });
            rgb_from_xyz.apply(unit).map(|value| value as f32)
        });
        fn encoded(step: usize) -> f32 {
            let value = step as f64 / STEPS as f64;
            Rgb([value; 3]).encoded().0[0] as f32
        }
        let mut own = Self {
            coordinates,
            maps: vec![MapColors { mean: Vec3::ZERO, share: Vec3::ONE }; maps.len()],
            kind,
            of_model,
            rgb_from_xyz: [0, 1, 2].map(|row| [0, 1, 2].map(|axis| columns[axis][row])),
            white: Lab { lightness: 100.0, a: 0.0, b: 0.0 }
                .to_xyz(RgbSpace::Srgb.white())
                .to_array()
                .map(|value| value as f32),
            encoded: (0..=STEPS + 1).map(|step| encoded(step.min(STEPS))).collect(),
        };
        if own.of_model {
            let shown: Vec<(Vec3, f64)> =
                colors.iter().map(|&(color, area)| (own.of_encoded(color), area)).collect();
            let (_, of_model) = moments(&shown);
            own.maps = maps
                .iter()
                .map(|map: &&ArtMap| {
                    let texels = map.keys.iter().flat_map(|key| own.mapped(&key.tile.color));
                    let (mean, of_map) =
                        moments(&texels.map(|color| (color, 1.0)).collect::<Vec<_>>());
                    let [a, b] = [1, 2].map(|axis: usize| {
                        let like_model =
                            if of_map[axis] > 0.0 { of_model[axis] / of_map[axis] } else { 1.0 };
                        settings.chroma * (1.0 + settings.statistics * (like_model.min(1.0) - 1.0))
                    });
                    MapColors { mean, share: Vec3::new(settings.lightness, a, b) }
                })
                .collect();
        }
        own
    }

    /// The mean colour that we subtract from the texels of a tile (linear sRGB) of a map. On models
    /// it is the mean of all tiles of the map. On pictures it is the mean of this tile, since
    /// pictures have their lightness already.
    pub(super) fn mean(&self, map: usize, tile: &Picture) -> Vec3 {
        if !self.of_model || self.kind == SubjectKind::Model {
            return self.maps[map].mean;
        }
        let texels: Vec<_> = self.mapped(tile).into_iter().map(|color| (color, 1.0)).collect();
        moments(&texels).0
    }

    /// Colours that texels (linear sRGB) of a map add to a pixel, after `mean` is subtracted from
    /// them.
    pub(super) fn details(&self, map: usize, mean: Vec3, texels: &Picture) -> Vec<Vec3> {
        let share = self.maps[map].share;
        self.mapped(texels).into_iter().map(|color| (color - mean) * share).collect()
    }

    /// Whether splats add colours of their own.
    pub(super) fn of_model(&self) -> bool {
        self.of_model
    }

    /// Colour that a splat adds to be lighter by a share of the whole range of lightness.
    pub(super) fn lighter(&self, share: f32) -> Vec3 {
        let range = if self.coordinates == Coordinates::Cielab { 100.0 } else { 1.0 };
        if self.of_model { Vec3::X * (share * range) } else { Vec3::ZERO }
    }

    /// L* of a colour of encoded sRGB.
    pub(super) fn lightness(color: Vec3) -> f32 {
        lab_of(color).x
    }

    /// Returns the colour that a splat adds where the model has this encoded sRGB.
    pub(super) fn of_splat(&self, color: Vec3) -> Vec3 {
        if self.of_model { self.of_encoded(color) } else { Vec3::ZERO }
    }

    /// Encoded sRGB, clipped to 0..1, of a colour in the coordinates of mixing.
    #[inline(always)]
    pub(super) fn shown(&self, color: Vec3) -> Vec3 {
        let Vec3 { x, y, z } = color;
        let encoded = match self.coordinates {
            Coordinates::Encoded => color,
            Coordinates::Yuv => {
                Vec3::new(x + 1.139_83 * z, x - 0.394_65 * y - 0.580_60 * z, x + 2.032_11 * y)
            }
            Coordinates::Cielab => self.of_lab(color),
        };
        encoded.clamp(Vec3::ZERO, Vec3::ONE)
    }

    /// Texels of linear sRGB in the coordinates of mixing.
    fn mapped(&self, texels: &Picture) -> Vec<Vec3> {
        if self.coordinates == Coordinates::Cielab {
            return lab_from_linear(texels).values().iter().map(|&lab| Vec3::from(lab)).collect();
        }
        let values = texels.values().par_iter().with_min_len(1024);
        let encoded = values.map(|rgb| {
            let inside = rgb.map(|value| f64::from(value.clamp(0.0, 1.0)));
            Vec3::from(Rgb(inside).encoded().0.map(|value| value as f32))
        });
        match self.coordinates {
            Coordinates::Yuv => encoded.map(yuv).collect(),
            _ => encoded.collect(),
        }
    }

    fn of_encoded(&self, color: Vec3) -> Vec3 {
        match self.coordinates {
            Coordinates::Encoded => color,
            Coordinates::Yuv => yuv(color),
            Coordinates::Cielab => lab_of(color),
        }
    }

    /// Encoded sRGB of CIELAB, without functions that differ in their last bits between machines.
    #[inline(always)]
    fn of_lab(&self, lab: Vec3) -> Vec3 {
        let middle = (lab.x + 16.0) / 116.0;
        let roots = [middle + lab.y / 500.0, middle, middle - lab.z / 200.0];
        let mut xyz = [0.0; 3];
        for axis in 0..3 {
            const KNEE: f32 = 6.0 / 29.0;
            let root = roots[axis];
            let above = root * root * root;
            let below = 3.0 * KNEE * KNEE * (root - 4.0 / 29.0);
            xyz[axis] = self.white[axis] * if root > KNEE { above } else { below };
        }
        Vec3::from(self.rgb_from_xyz.map(|row: [f32; 3]| {
            let linear = row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2];
            let at = linear.clamp(0.0, 1.0) * STEPS as f32;
            let step = at as usize;
            let [low, high] = [self.encoded[step], self.encoded[step + 1]];
            low + (high - low) * (at - step as f32)
        }))
    }
}

/// CIELAB of encoded sRGB.
fn lab_of(color: Vec3) -> Vec3 {
    let linear = Rgb(color.to_array().map(f64::from)).linear().0;
    let one = Field::from_values(1, 1, vec![linear.map(|value| value as f32)]);
    lab_from_linear(&one).values()[0].into()
}

/// YUV (Rec. 601) of encoded sRGB.
fn yuv(color: Vec3) -> Vec3 {
    let y = color.dot(Vec3::new(0.299, 0.587, 0.114));
    Vec3::new(y, 0.492 * (color.z - y), 0.877 * (color.x - y))
}

/// Mean and standard deviation of weighted colours.
fn moments(colors: &[(Vec3, f64)]) -> (Vec3, Vec3) {
    let total: f64 = colors.iter().map(|(_, weight)| weight).sum();
    if total <= 0.0 {
        return (Vec3::ZERO, Vec3::ZERO);
    }
    let mut mean = [0.0; 3];
    let mut square = [0.0; 3];
    for (color, weight) in colors {
        for (axis, value) in color.to_array().into_iter().enumerate() {
            mean[axis] += weight * f64::from(value) / total;
            square[axis] += weight * f64::from(value) * f64::from(value) / total;
        }
    }
    let spread = [0, 1, 2].map(|i| (square[i] - mean[i] * mean[i]).max(0.0).sqrt() as f32);
    (Vec3::from(mean.map(|value| value as f32)), Vec3::from(spread))
}

#[cfg(test)]
mod tests {
    use graphics::encoding::linear_from_lab;

    use super::super::test_scenes::map;
    use super::*;

    fn settings(space: ColorSpace) -> ColorSettings {
        ColorSettings { from: ColorSource::Model, space, ..ColorSettings::default() }
    }

    fn details(coloring: &Coloring, tile: &Picture) -> Vec<Vec3> {
        coloring.details(0, coloring.mean(0, tile), tile)
    }

    #[test]
    fn tones_do_not_change_the_lightness_of_a_picture() {
        let map = map(3);
        let settings = settings(ColorSpace::Cielab);
        for (subjects, least) in [(SubjectKind::Model, 5.0), (SubjectKind::Picture, 0.0)] {
            let coloring = Coloring::new(&[&map], &[(Vec3::ONE, 1.0)], &settings, subjects);
            let means = [0, 2].map(|tone: usize| {
                let details = details(&coloring, &map.keys[tone].tile.color);
                details.iter().map(|detail| detail.x).sum::<f32>() / details.len() as f32
            });
            let change = means[1] - means[0];
            assert!(
                change >= least && (least > 0.0 || change.abs() < 1e-2),
                "{subjects:?}: {means:?}"
            );
        }
    }

    #[test]
    fn a_mean_texel_shows_the_colour_of_the_model() {
        let map = map(3);
        let color = Vec3::new(0.7, 0.4, 0.2);
        for space in [ColorSpace::Cielab, ColorSpace::Yuv] {
            let coloring =
                Coloring::new(&[&map], &[(color, 1.0)], &settings(space), SubjectKind::Model);
            let shown = coloring.shown(coloring.of_splat(color));
            assert!(shown.distance(color) < 2e-3, "{space:?}: {shown}");
            let details =
                map.keys.iter().map(|key| details(&coloring, &key.tile.color)).collect::<Vec<_>>();
            let all: Vec<Vec3> = details.concat();
            let mean = all.iter().sum::<Vec3>() / all.len() as f32;
            let most = all.iter().map(|detail| detail.length()).fold(0.0, f32::max);
            assert!(mean.length() < 1e-3 * most, "{mean} of {most}");
        }
    }

    #[test]
    fn shares_scale_the_detail_of_lightness_and_of_chroma() {
        let map = map(2);
        let none = ColorSettings { lightness: 2.0, chroma: 0.0, ..settings(ColorSpace::Cielab) };
        let [usual, changed] = [&settings(ColorSpace::Cielab), &none].map(|settings| {
            let coloring =
                Coloring::new(&[&map], &[(Vec3::ONE, 1.0)], settings, SubjectKind::Model);
            details(&coloring, &map.keys[0].tile.color)
        });
        for (usual, changed) in usual.iter().zip(&changed) {
            assert!((changed.x - 2.0 * usual.x).abs() < 1e-3);
            assert_eq!((changed.y, changed.z), (0.0, 0.0));
        }
    }

    #[test]
    fn statistics_keep_the_chroma_of_a_model_of_one_colour() {
        let map = map(2);
        let like = ColorSettings { statistics: 1.0, ..settings(ColorSpace::Cielab) };
        let grey = [(Vec3::splat(0.5), 1.0)];
        let coloring = Coloring::new(&[&map], &grey, &like, SubjectKind::Model);
        assert_eq!((coloring.maps[0].share.y, coloring.maps[0].share.z), (0.0, 0.0));
        let mixed = [(Vec3::X, 1.0), (Vec3::Y, 1.0), (Vec3::Z, 1.0)];
        let coloring = Coloring::new(&[&map], &mixed, &like, SubjectKind::Model);
        assert_eq!(coloring.maps[0].share.y, like.chroma, "never more than asked for");
    }

    #[test]
    fn encoding_of_cielab_is_that_of_the_library() {
        let map = map(2);
        let coloring =
            Coloring::new(&[&map], &[], &settings(ColorSpace::Cielab), SubjectKind::Model);
        for color in [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [0.02, 0.3, 0.7], [0.9, 0.1, 0.4]] {
            let linear = Field::from_values(1, 1, vec![color]);
            let lab = lab_from_linear(&linear).values()[0];
            let back = linear_from_lab(&Field::from_values(1, 1, vec![lab])).values()[0];
            let wanted = Rgb(back.map(|value| f64::from(value.clamp(0.0, 1.0)))).encoded().0;
            let shown = coloring.shown(Vec3::from(lab)).to_array();
            for (found, wanted) in shown.into_iter().zip(wanted) {
                assert!((f64::from(found) - wanted).abs() < 1e-3, "{color:?}: {shown:?}");
            }
        }
    }
}
