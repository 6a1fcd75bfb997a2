//! The door of photographs: flat regions with smooth outlines.

use super::morphology::Morphology;
use super::segmentation::{SegmentationError, SegmentationSettings, segment};
use super::wash::{Controls, Wash};
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::picture::Photograph;

/// How a photograph is abstracted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhotographSettings {
    /// Of mean shift.
    pub segmentation: SegmentationSettings,
    /// Of the brush that opens and closes; 0 for none, 128 at most.
    pub smoothing_radius_px: u32,
}

impl PhotographSettings {
    /// The largest brush.
    pub const MOST_SMOOTHING_PX: u32 = 128;
}

impl Default for PhotographSettings {
    /// Mean shift's own, and a brush of 3 px.
    fn default() -> Self {
        Self { segmentation: SegmentationSettings::default(), smoothing_radius_px: 3 }
    }
}

/// A photograph on its way, each stage encoded sRGB with coverage.
#[derive(Debug, Clone, PartialEq)]
pub struct AbstractedPhotograph {
    /// As it was read, of the size of the painting.
    pub original: Field<[f32; 4]>,
    /// Each region in its mean colour.
    pub segmented: Field<[f32; 4]>,
    /// Opened and closed.
    pub smoothed: Field<[f32; 4]>,
    /// How many regions there are.
    pub regions: usize,
}

impl AbstractedPhotograph {
    /// The last stage, with effects the same everywhere.
    #[must_use]
    pub fn into_wash(self) -> Wash {
        Wash { color: self.smoothed, controls: Controls::default() }
    }
}

/// Abstracts `photograph` on a painting of `width_px`, its height by its own shape.
///
/// # Errors
/// [`PhotographDoorError`]: no width, a setting out of its range, or the device.
pub fn from_photograph<B: Morphology>(
    backend: &mut B,
    photograph: &Photograph,
    width_px: usize,
    settings: &PhotographSettings,
) -> Result<AbstractedPhotograph, PhotographDoorError> {
    let radius_px = settings.smoothing_radius_px;
    if radius_px > PhotographSettings::MOST_SMOOTHING_PX {
        return Err(PhotographDoorError::Smoothing { found: radius_px });
    }
    if width_px == 0 {
        return Err(PhotographDoorError::NoWidth);
    }
    let (width, height) = photograph.size();
    let height_px = ((width_px as f64 * height as f64 / width as f64).round() as usize).max(1);
    let original = photograph.with_opacity(width_px, height_px);
    let segmentation = segment(&original, &settings.segmentation)?;
    let segmented = segmentation.flat();
    let smoothed = if radius_px == 0 {
        segmented.clone()
    } else {
        let there = backend.color_of(&segmented)?;
        let there = backend.smoothed(&there, radius_px)?;
        backend.color_field(&there)?
    };
    Ok(AbstractedPhotograph { original, segmented, smoothed, regions: segmentation.colors.len() })
}

/// A photograph that cannot be abstracted so.
#[derive(Debug, thiserror::Error)]
pub enum PhotographDoorError {
    /// A painting needs a pixel.
    #[error("a painting is 1 px wide at least, found `0`")]
    NoWidth,
    /// The brush is out of its range.
    #[error(
        "a smoothing brush has a radius of {} px at most, found `{found}`",
        PhotographSettings::MOST_SMOOTHING_PX
    )]
    Smoothing {
        /// Its radius, in pixels.
        found: u32,
    },
    /// Segmentation refuses its settings.
    #[error(transparent)]
    Segmentation(#[from] SegmentationError),
    /// The device fails.
    #[error(transparent)]
    Gpu(#[from] DeviceError),
}

impl PhotographDoorError {
    /// What to try.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::NoWidth => "give the width of the painting in pixels",
            Self::Smoothing { .. } => "3 px rounds the outlines of a photograph of 1 megapixel",
            Self::Segmentation(error) => error.hint(),
            Self::Gpu(_) => "`--backend cpu` works without a device",
        }
    }
}
