//! The abstraction of photographs to flat regions with smooth outlines.
//!
//! Bousseau et al. 2006, section 4.1: a segmentation by mean shift, then an opening and a
//! closing that round the outlines of its regions.

use super::settings::AbstractionSettings;
use documents::hint::{Explain, Fault, Hint};
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::morphology::opening_then_closing;
use graphics::picture::Photograph;
use graphics::segmentation::{SegmentationError, SegmentationSettings, segment};

/// How a photograph is abstracted, in pixels of the abstracted picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegionSettings {
    /// Settings of the mean shift.
    pub segmentation: SegmentationSettings,
    /// Radius of the structuring element that smooths outlines, 0 (no smoothing) to
    /// [`Self::MAX_SMOOTHING_PX`].
    pub smoothing_radius_px: u32,
}

impl RegionSettings {
    /// Largest radius of the structuring element, in pixels.
    pub const MAX_SMOOTHING_PX: u32 = 128;
}

impl Default for RegionSettings {
    /// The usual segmentation, and a radius of 3 px.
    fn default() -> Self {
        Self { segmentation: SegmentationSettings::default(), smoothing_radius_px: 3 }
    }
}

impl From<&AbstractionSettings> for RegionSettings {
    /// Rounds lengths to pixels and clamps them to what segmentation and smoothing take.
    /// `settings` are those for the size of the picture.
    fn from(settings: &AbstractionSettings) -> Self {
        let AbstractionSettings { spatial_px, range_luv, tone_luv, least_region_px, brush_px } =
            *settings;
        let max_smoothing = Self::MAX_SMOOTHING_PX as f32;
        Self {
            segmentation: SegmentationSettings {
                spatial_radius_px: spatial_px.clamp(1.0, SegmentationSettings::MAX_SPATIAL_PX),
                range_radius: range_luv,
                least_region_px: least_region_px.round() as u32,
                tone_step: tone_luv,
            },
            smoothing_radius_px: (brush_px / 2.0).round().min(max_smoothing) as u32,
        }
    }
}

/// The stages of an abstraction, each encoded sRGB with coverage.
#[derive(Debug, Clone, PartialEq)]
pub struct AbstractedPhotograph {
    /// The photograph in the size of the painting.
    pub original: Field<[f32; 4]>,
    /// Each region in its mean colour.
    pub segmented: Field<[f32; 4]>,
    /// The regions with smoothed outlines.
    pub smoothed: Field<[f32; 4]>,
    /// Number of regions.
    pub regions: usize,
}

/// Abstracts `photograph` to a picture of `width_px` pixels, whose height follows from the
/// proportions of the photograph.
///
/// # Errors
/// [`AbstractionError`] if the width is 0, a setting is out of its range, or the device fails.
pub fn abstract_photograph(
    compute: &mut Compute,
    photograph: &Photograph,
    width_px: usize,
    settings: &RegionSettings,
) -> Result<AbstractedPhotograph, AbstractionError> {
    let radius_px = settings.smoothing_radius_px;
    if radius_px > RegionSettings::MAX_SMOOTHING_PX {
        return Err(AbstractionError::Smoothing { found: radius_px });
    }
    if width_px == 0 {
        return Err(AbstractionError::NoWidth);
    }
    let original = photograph.with_opacity(width_px, height_for_width(photograph, width_px));
    let segmentation = segment(&original, &settings.segmentation)?;
    let segmented = segmentation.flat();
    let smoothed = if radius_px == 0 {
        segmented.clone()
    } else {
        let image = compute.upload(&segmented)?;
        let image = opening_then_closing(compute, &image, radius_px)?;
        compute.download(&image)?
    };
    Ok(AbstractedPhotograph { original, segmented, smoothed, regions: segmentation.colors.len() })
}

/// The height in pixels, at least 1, that keeps the photograph's proportions.
pub(super) fn height_for_width(photograph: &Photograph, width_px: usize) -> usize {
    let (width, height) = photograph.size();
    ((width_px as f64 * height as f64 / width as f64).round() as usize).max(1)
}

/// Why a photograph cannot be abstracted.
#[derive(Debug, thiserror::Error)]
pub enum AbstractionError {
    /// The painting would have no pixel.
    #[error("a painting is 1 px wide at least, found `0`")]
    NoWidth,
    /// The structuring element is too large.
    #[error(
        "a smoothing radius is at most {} px, found `{found}`",
        RegionSettings::MAX_SMOOTHING_PX
    )]
    Smoothing {
        /// Its radius in pixels.
        found: u32,
    },
    /// A setting of the segmentation is out of its range.
    #[error(transparent)]
    Segmentation(#[from] SegmentationError),
    /// The graphics device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

impl Explain for AbstractionError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::NoWidth => Some(Hint::new("give the width of the painting in pixels")),
            Self::Smoothing { .. } => {
                Some(Hint::new("3 px rounds the outlines of a photograph of 1 megapixel"))
            }
            Self::Segmentation(error) => error.hint(),
            Self::Device(error) => error.hint(),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Device(error) => error.fault(),
            _ => Fault::Setting,
        }
    }
}
