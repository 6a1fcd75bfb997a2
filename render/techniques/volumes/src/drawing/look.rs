//! How surfaces are lit, drawn and turned into grey, and the reasons why we cannot draw a picture.

use std::sync::OnceLock;

use documents::hint::Explain;
use glam::Vec3;
use graphics::distant_light::DistantLight;
use graphics::gpu::DeviceError;
use graphics::tones::ToneRamp;
use serde::{Deserialize, Serialize};
use spectra::color::Rgb;

use crate::hatching::HatchingLook;

const MOST_SAMPLES: f32 = 8.0;

/// How surfaces are lit and drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawingLook {
    /// Direction of the light.
    pub light: DistantLight,
    /// The tone for each cosine between light and surface.
    pub tones: ToneRamp,
    /// Whether light falls on surfaces. If not, e.g. for a photograph on a plane, colours stay as
    /// they are, and the tones of hatching come from the grey of the colours. We lift this grey
    /// between black and white, because the colour that you see between the strokes is dark
    /// itself.
    pub lit: bool,
    /// Share of its colour that a surface loses in full shade, 0 to 1. Hatching comes on top of
    /// this.
    pub shade: f32,
    /// Share by which greys outside of volumes are lifted towards white paper before we hatch
    /// them, 0 to 1. If you pass 0, the grey is exactly as light as the colour.
    pub pale: f32,
    /// How a colour becomes grey.
    pub weights: GreyWeights,
    /// How hatching looks.
    pub hatching: HatchingLook,
    /// Samples along each side of a pixel, 1 to 8. We draw and count at this many times the width
    /// and height of the picture.
    pub samples: usize,
}

impl Default for DrawingLook {
    /// Six tones, lit from the upper left, pencil hatching, one sample per pixel.
    fn default() -> Self {
        Self {
            light: DistantLight::with_camera(315.0, 45.0),
            tones: ToneRamp::steps(6, 0.5),
            lit: true,
            shade: 0.3,
            pale: 0.0,
            weights: GreyWeights::Luminance,
            hatching: HatchingLook::default(),
            samples: 1,
        }
    }
}

impl DrawingLook {
    /// Checks that all numbers are in their ranges.
    ///
    /// # Errors
    /// [`DrawingError::Setting`] names the first that is not.
    pub fn check(&self) -> Result<(), DrawingError> {
        let hatching = &self.hatching;
        let light = match self.light {
            DistantLight::WithCamera(towards) | DistantLight::WithModel(towards) => towards,
        };
        for component in light.to_array() {
            check_range("a component of the light's direction", component, [-1e6, 1e6])?;
        }
        check_range("shade", self.shade, [0.0, 1.0])?;
        check_range("pale", self.pale, [0.0, 1.0])?;
        check_range("samples", self.samples as f32, [1.0, MOST_SAMPLES])?;
        check_range("hatching inside", hatching.inside, [0.0, 1.0])?;
        check_range("hatching outside", hatching.outside, [0.0, 1.0])?;
        check_range("pencil", hatching.pencil, [0.0, 1.0])?;
        check_range("width of strokes", hatching.width_px, [1.0, 16.0])?;
        check_range("softness of strokes", hatching.softness, [0.01, 0.15])?;
        check_range("darkest tone", hatching.darkest, [0.0, 1.0])?;
        check_range("angle of strokes", hatching.angle_deg, [-360.0, 360.0])
    }
}

/// A picture cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum DrawingError {
    /// The graphics device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// A setting is out of its range or NaN.
    #[error("{name} is {least} to {most}, found `{found}`")]
    #[hint("give a number from {least} to {most}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Least value.
        least: f32,
        /// Greatest value.
        most: f32,
        /// The value that was given.
        found: f32,
    },
    /// There are more regions than a picture can have.
    #[error("a picture has at most {most} regions, found `{found}`")]
    #[hint("let volumes of one colour share a region")]
    Regions {
        /// Greatest number of regions.
        most: usize,
        /// The number that was given.
        found: usize,
    },
}

/// Checks that a setting lies in its range; NaN does not.
pub(super) fn check_range(
    name: &'static str,
    found: f32,
    [least, most]: [f32; 2],
) -> Result<(), DrawingError> {
    if (least..=most).contains(&found) {
        return Ok(());
    }
    Err(DrawingError::Setting { name, least, most, found })
}

/// How to weigh a colour for its grey.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GreyWeights {
    /// The luminance Y of linear sRGB, encoded again. This is as light as the colour.
    #[default]
    Luminance,
    /// 0.299, 0.587 and 0.114 of the encoded values (ITU-R BT.601). This was common in 2005.
    Rec601,
}

/// Share of linear red, green and blue in the luminance of sRGB (IEC 61966-2-1).
const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// Share of encoded red, green and blue in luma (ITU-R BT.601).
const LUMA: [f32; 3] = [0.299, 0.587, 0.114];

const STEPS: usize = 1024;

#[derive(Debug)]
pub(super) struct Transfer {
    linear: Vec<f32>,
    encoded: Vec<f32>,
}

impl Transfer {
    pub(super) fn get() -> &'static Self {
        static TABLES: OnceLock<Transfer> = OnceLock::new();
        TABLES.get_or_init(|| {
            let steps = (0..=STEPS + 1).map(|i| Rgb([(i as f64 / STEPS as f64).min(1.0); 3]));
            Self {
                linear: steps.clone().map(|value| value.linear().0[0] as f32).collect(),
                encoded: steps.map(|value| value.encoded().0[0] as f32).collect(),
            }
        })
    }

    /// The grey of an encoded sRGB colour in 0..1, encoded.
    #[inline(always)]
    pub(super) fn grey(&self, color: Vec3, weights: GreyWeights) -> f32 {
        match weights {
            GreyWeights::Luminance => {
                let [r, g, b] = color.to_array().map(|value| interpolated(&self.linear, value));
                let y = LUMINANCE[0] * r + LUMINANCE[1] * g + LUMINANCE[2] * b;
                interpolated(&self.encoded, y)
            }
            GreyWeights::Rec601 => color.dot(Vec3::from(LUMA)),
        }
    }
}

#[inline(always)]
fn interpolated(table: &[f32], value: f32) -> f32 {
    let at = value.clamp(0.0, 1.0) * STEPS as f32;
    let below = at as usize;
    table[below] + (table[below + 1] - table[below]) * (at - below as f32)
}

/// The grey of an encoded sRGB colour, 0..1. This clips values outside.
#[must_use]
pub fn grey_of(color: [f32; 3], weights: GreyWeights) -> f32 {
    Transfer::get().grey(Vec3::from(color).clamp(Vec3::ZERO, Vec3::ONE), weights)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn numbers_that_are_none_are_refused_by_name() {
        assert_eq!(DrawingLook::default().check(), Ok(()));
        fn refused(change: &dyn Fn(&mut DrawingLook)) -> String {
            let mut look = DrawingLook::default();
            change(&mut look);
            look.check().unwrap_err().to_string()
        }
        let found = refused(&|look| look.hatching.pencil = f32::NAN);
        assert_eq!(found, "pencil is 0 to 1, found `NaN`");
        assert!(refused(&|look| look.shade = 1.5).starts_with("shade"));
        assert!(refused(&|look| look.samples = 0).starts_with("samples"));
        assert!(refused(&|look| look.hatching.softness = 0.0).starts_with("softness"));
        assert!(refused(&|look| look.hatching.angle_deg = f32::INFINITY).starts_with("angle"));
        let light = DistantLight::WithModel(Vec3::NAN);
        assert!(refused(&|look| look.light = light).contains("light's direction"));
    }

    #[test]
    fn grey_is_as_light_as_the_colour() {
        for i in 0..17 * 17 * 17 {
            let color = [i % 17, i / 17 % 17, i / 289].map(|step| step as f64 / 16.0);
            let [r, g, b] = Rgb(color).linear().0;
            let y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
            let wanted = Rgb([y; 3]).encoded().0[0] as f32;
            let found = grey_of(color.map(|value| value as f32), GreyWeights::Luminance);
            assert!((found - wanted).abs() < 0.25 / 255.0, "{color:?}: {found} {wanted}");
        }
    }

    #[test]
    fn a_grey_stays_what_it_is() {
        for i in 0..=255 {
            let value = i as f32 / 255.0;
            for weights in [GreyWeights::Luminance, GreyWeights::Rec601] {
                let found = grey_of([value; 3], weights);
                assert!((found - value).abs() < 0.15 / 255.0, "{value} {weights:?}: {found}");
            }
        }
        assert_eq!(grey_of([0.0; 3], GreyWeights::Luminance), 0.0);
        assert_eq!(grey_of([9.0, f32::INFINITY, 1.0], GreyWeights::Luminance), 1.0);
        let red = grey_of([1.0, 0.0, 0.0], GreyWeights::Rec601);
        assert!((red - 0.299).abs() < 1e-6);
    }
}
