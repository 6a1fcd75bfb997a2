//! How surfaces are lit and drawn.

use graphics::distant_light::DistantLight;
use graphics::tones::ToneRamp;

use super::error::{DrawingError, check_range};
use super::grey::GreyWeights;
use crate::hatching::HatchingLook;

/// Most samples along each side of a pixel.
const MOST_SAMPLES: f32 = 8.0;

/// How surfaces are lit and drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawingLook {
    /// Direction of the light.
    pub light: DistantLight,
    /// Tone by the cosine between light and surface.
    pub tones: ToneRamp,
    /// Whether light falls on surfaces. If not, as for a photograph on a plane, colours stay as
    /// they are and the tones of hatching are those of the colours' own grey, lifted between
    /// black and white: what is seen of a colour between the strokes is dark itself.
    pub lit: bool,
    /// Share of its colour that a surface loses in full shade, 0 to 1, beside the hatching.
    pub shade: f32,
    /// Share by which greys outside of volumes are lifted towards white paper before they are
    /// hatched, 0 to 1. At 0 the grey is exactly as light as the colour.
    pub pale: f32,
    /// How a colour becomes grey.
    pub weights: GreyWeights,
    /// How hatching looks.
    pub hatching: HatchingLook,
    /// Samples along each side of a pixel, 1 to 8. What is seen and counted is this many times as
    /// wide and high as the picture.
    pub samples: usize,
}

impl Default for DrawingLook {
    /// Six tones, lit from the upper left, pencil hatching, one sample a pixel.
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

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn numbers_that_are_none_are_refused_by_name() {
        assert_eq!(DrawingLook::default().check(), Ok(()));
        let refused = |change: &dyn Fn(&mut DrawingLook)| {
            let mut look = DrawingLook::default();
            change(&mut look);
            look.check().unwrap_err().to_string()
        };
        let found = refused(&|look| look.hatching.pencil = f32::NAN);
        assert_eq!(found, "pencil is 0 to 1, found `NaN`");
        assert!(refused(&|look| look.shade = 1.5).starts_with("shade"));
        assert!(refused(&|look| look.samples = 0).starts_with("samples"));
        assert!(refused(&|look| look.hatching.softness = 0.0).starts_with("softness"));
        assert!(refused(&|look| look.hatching.angle_deg = f32::INFINITY).starts_with("angle"));
        let light = DistantLight::WithModel(Vec3::NAN);
        assert!(refused(&|look| look.light = light).contains("light's direction"));
    }
}
