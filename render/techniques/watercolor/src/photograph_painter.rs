//! Photographs to watercolors.
//!
//! We abstract a photograph to flat regions with smooth outlines (Bousseau et al. 2006, section
//! 4.1). A segmentation by mean shift finds the regions. Then an opening and a closing round the
//! outlines. The regions become the wash that you apply the effects of water and paper to.

use documents::hint::Explain;
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::morphology::opening_then_closing;
use graphics::picture::Photograph;
use graphics::segmentation::{SegmentationError, SegmentationSettings, segment};

use super::photograph::{enlarged, photograph_wash};
use super::pipeline::{FrameTextures, Masks, StageObserver, Wash, WashImages, paint};
use super::settings::{AbstractionSettings, Settings};
use super::textures::{PaperTextureError, Textures};

/// Longer side in pixels of the largest picture in which we look for regions. Regions of larger
/// pictures are enlarged.
const REGIONS_LONGER_SIDE_PX: usize = 1600;

/// Paints photographs as watercolors, by default on the processor. For example:
///
/// ```
/// use graphics::picture::Photograph;
/// use watercolor::{PhotographPainter, Preset};
///
/// # let bytes = graphics::export::frame_png(&graphics::field::Field::filled(24, 16, [200, 90, 60]))?;
/// let photograph = Photograph::from_bytes("a.png", &bytes)?;
/// let style = Preset::Landscape.settings();
/// let picture = PhotographPainter::new(style).paint(&photograph)?;
/// assert_eq!((picture.width(), picture.height()), (24, 16));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct PhotographPainter {
    settings: Settings,
    compute: Compute,
    width_px: Option<usize>,
    masks: Masks,
}

/// A photograph that is ready for painting, with its wash and the textures of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedPhotograph {
    /// The photograph in the size in which we look for regions, encoded sRGB with coverage: as
    /// large as the painting, with its longer side at most 1600 px.
    pub original: Field<[f32; 4]>,
    /// Each region of the photograph in its mean colour, in the size of `original`.
    pub segmented: Field<[f32; 4]>,
    /// Number of regions.
    pub regions: usize,
    /// The abstracted photograph, and where effects are weaker.
    pub wash: Wash,
    /// The textures of the picture.
    pub textures: Textures,
    /// The settings for the size of the picture.
    pub settings: Settings,
}

impl PreparedPhotograph {
    /// Each region of the photograph in its mean colour, in the size of the painting.
    #[must_use]
    pub fn flat_regions(&self) -> Field<[f32; 4]> {
        enlarged(&self.segmented, self.wash.color.width(), self.wash.color.height())
    }
}

impl PhotographPainter {
    /// A painter of this style. We adapt its lengths to the size of each picture
    /// ([`Settings::for_size`]).
    #[must_use]
    pub fn new(settings: Settings) -> Self {
        Self { settings, compute: Compute::cpu(), width_px: None, masks: Masks::default() }
    }

    /// Computes with `compute` instead of the processor.
    #[must_use]
    pub fn with_compute(self, compute: Compute) -> Self {
        Self { compute, ..self }
    }

    /// Sets the width of pictures in pixels, 1 and up. If you do not set it, the width is
    /// [`Photograph::usual_width_px`].
    #[must_use]
    pub fn with_width_px(self, width_px: usize) -> Self {
        Self { width_px: Some(width_px), ..self }
    }

    /// Stretches `masks` over each picture.
    #[must_use]
    pub fn with_masks(self, masks: Masks) -> Self {
        Self { masks, ..self }
    }

    /// Width and height in pixels of a painting of `photograph`.
    #[must_use]
    pub fn picture_size(&self, photograph: &Photograph) -> (usize, usize) {
        let width = self.width_px.unwrap_or_else(|| photograph.usual_width_px());
        (width, height_for_width(photograph, width))
    }

    /// Name of the device that computes: `cpu`, or the name of a graphics adapter.
    #[must_use]
    pub fn compute_name(&self) -> &str {
        self.compute.name()
    }

    /// Paints a photograph. The picture is encoded sRGB and covered everywhere.
    ///
    /// # Errors
    /// [`PhotographPainterError`] if the width is 0, a setting is out of its range, the
    /// paper's scan cannot be read, or the device fails.
    pub fn paint(
        &mut self,
        photograph: &Photograph,
    ) -> Result<Field<[f32; 4]>, PhotographPainterError> {
        let prepared = self.prepare(photograph)?;
        Ok(self.finish(prepared)?)
    }

    /// Abstracts a photograph and makes the textures of its picture. You need this before you apply
    /// the effects with [`Self::paint_prepared`], or paint with glazes
    /// ([`super::GlazePainter::paint`]).
    ///
    /// # Errors
    /// [`PhotographPainterError`] if the width is 0, a setting is out of its range, the
    /// paper's scan cannot be read, or the device fails.
    pub fn prepare(
        &mut self,
        photograph: &Photograph,
    ) -> Result<PreparedPhotograph, PhotographPainterError> {
        let (width, height) = self.picture_size(photograph);
        let settings = self.settings.for_size(width, height);
        let most = REGIONS_LONGER_SIDE_PX as f64 / width.max(height).max(1) as f64;
        let own_width = (most.min(1.0) * width as f64).round() as usize;
        let own = self.settings.for_size(own_width, height_for_width(photograph, own_width.max(1)));
        let regions = RegionSettings::from(&own.abstraction);
        let AbstractedPhotograph { original, segmented, smoothed, regions } =
            abstract_photograph(&mut self.compute, photograph, own_width, &regions)?;
        let color = photograph_wash((&original, &smoothed), (width, height), &own, &settings);
        drop(smoothed);
        let textures = Textures::of_photograph(&color, &settings)?;
        let wash = Wash { color, controls: self.masks.controls(width, height) };
        Ok(PreparedPhotograph { original, segmented, regions, wash, textures, settings })
    }

    /// Applies all effects. The picture is encoded sRGB and covered everywhere. We call `observer`
    /// with the picture after each stage.
    ///
    /// # Errors
    /// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
    /// processor.
    pub fn paint_prepared(
        &mut self,
        prepared: &PreparedPhotograph,
        observer: Option<StageObserver<'_>>,
    ) -> Result<Field<[f32; 4]>, DeviceError> {
        let wash = prepared.wash.clone();
        let textures = prepared.textures.clone();
        self.paint_wash(wash, textures, &prepared.settings, observer)
    }

    /// Applies all effects as [`Self::paint_prepared`] does, in the memory of `prepared`.
    ///
    /// # Errors
    /// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
    /// processor.
    pub fn finish(&mut self, prepared: PreparedPhotograph) -> Result<Field<[f32; 4]>, DeviceError> {
        let PreparedPhotograph { original, segmented, wash, textures, settings, .. } = prepared;
        drop((original, segmented));
        self.paint_wash(wash, textures, &settings, None)
    }

    /// Applies all effects to a wash, in its memory.
    fn paint_wash(
        &mut self,
        Wash { color, controls }: Wash,
        textures: Textures,
        settings: &Settings,
        observer: Option<StageObserver<'_>>,
    ) -> Result<Field<[f32; 4]>, DeviceError> {
        let compute = &mut self.compute;
        let color = compute.give(color)?;
        let wash = WashImages::new(compute, color, &controls)?;
        let textures = textures.give(compute)?;
        let color = paint(compute, wash, FrameTextures::from(&textures), settings, observer)?;
        compute.take(color)
    }
}

/// Why a photograph cannot be painted.
#[derive(Debug, thiserror::Error, Explain)]
pub enum PhotographPainterError {
    /// The photograph cannot be abstracted.
    #[error(transparent)]
    #[fault(Setting)]
    Abstraction(#[from] AbstractionError),
    /// The paper cannot be made.
    #[error(transparent)]
    Paper(#[from] PaperTextureError),
    /// The graphics device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

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
    /// Rounds lengths to pixels and clamps them to values that segmentation and smoothing take.
    /// First scale the `settings` to the size of the picture, with [`Settings::for_size`].
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

/// Abstracts `photograph` to a picture of `width_px` pixels. The height keeps the proportions of
/// the photograph.
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
        return Err(AbstractionError::Smoothing(radius_px));
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
#[derive(Debug, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum AbstractionError {
    /// The painting would have no pixel.
    #[error("a painting is 1 px wide at least, found `0`")]
    #[hint("give the width of the painting in pixels")]
    NoWidth,
    /// The structuring element is too large.
    #[error("a smoothing radius is at most {} px, found `{found}`", RegionSettings::MAX_SMOOTHING_PX, found = .0)]
    #[hint("3 px rounds the outlines of a photograph of 1 megapixel")]
    Smoothing(u32),
    /// A setting of the segmentation is out of its range.
    #[error(transparent)]
    #[fault(Setting)]
    Segmentation(#[from] SegmentationError),
    /// The graphics device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
}
