//! From flat colours to a watercolor: the effects in their order.
//!
//! We apply wobble, edges, flow, dispersion and paper in the order of Bousseau et al. 2006, figure
//! 4, then the dry brush and the shading of the paper. You apply the effects to a [`Wash`], which
//! holds flat colours and says where effects are weaker.

use graphics::compute::{ColorImage, Compute, GreyImage};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel};
use graphics::picture::Photograph;
use rayon::prelude::*;
use spectra::color::Rgb;

use super::effects::{
    COLOR_MASK, ColorRange, DENSITY, DRY_BRUSH, DensityLayer, DryBrushReach, EDGE_BLUR, EDGES,
    PAPER_SHADING, PaperShading, WOBBLE, apply_density, apply_dry_brush, color_mask, edges,
    shade_paper, wobble,
};
use super::settings::{DryBrushSettings, Settings};
use super::textures::{PaperImage, PaperTexture, Quantiles, TextureImages};
use super::toon::TOON;

/// A step of the pipeline, in the order of their execution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// The flat colours that the pipeline starts from.
    Wash,
    /// After displacement by the grain of the paper.
    Wobble,
    /// After the overall density and denser edges.
    Edges,
    /// After clouds of pigment.
    Flow,
    /// After back-runs of water into drying washes.
    BackRuns,
    /// After grains of pigment.
    Dispersion,
    /// After pigment gathered in the hollows of the paper.
    Paper,
    /// After the dry brush left paper bare.
    DryBrush,
    /// Composited on the shaded paper: the finished picture.
    OnPaper,
}

impl Stage {
    /// All stages in their order.
    pub const ALL: [Self; 9] = [
        Self::Wash,
        Self::Wobble,
        Self::Edges,
        Self::Flow,
        Self::BackRuns,
        Self::Dispersion,
        Self::Paper,
        Self::DryBrush,
        Self::OnPaper,
    ];

    /// The name of the stage in file names.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Wash => "wash",
            Self::Wobble => "wobble",
            Self::Edges => "edges",
            Self::Flow => "flow",
            Self::BackRuns => "back-runs",
            Self::Dispersion => "dispersion",
            Self::Paper => "paper",
            Self::DryBrush => "dry-brush",
            Self::OnPaper => "sheet",
        }
    }
}

/// We call this with the picture after each stage. The picture is encoded sRGB with coverage.
pub type StageObserver<'a> = &'a mut dyn FnMut(Stage, Field<[f32; 4]>);

/// The textures of one frame.
#[derive(Debug, Clone, Copy)]
pub struct FrameTextures<'a> {
    /// Clouds of pigment, 0 to 1.
    pub flow: &'a GreyImage,
    /// Grains of pigment, 0 to 1.
    pub dispersion: &'a GreyImage,
    /// Heights of the paper, 0 to 1.
    pub paper: &'a PaperImage,
    /// Touch of the dry brush. If this is `None`, the heights of the paper decide.
    pub touch: Option<(&'a GreyImage, &'a Quantiles)>,
    /// Change of density by back-runs, 0 to 1. At 0.5 nothing changes.
    pub back_runs: Option<&'a GreyImage>,
}

impl<'a> From<&'a TextureImages> for FrameTextures<'a> {
    /// The textures of a still picture.
    fn from(textures: &'a TextureImages) -> Self {
        let TextureImages { flow, dispersion, paper, touch, back_runs } = textures;
        let touch = touch.as_ref().map(|(image, own)| (image, own));
        Self { flow, dispersion, paper, touch, back_runs: back_runs.as_ref() }
    }
}

/// Paints `wash`: applies all effects and composites the result on the paper. You pass the
/// `settings` for its size ([`Settings::for_size`]).
///
/// With an `observer` every stage is computed by itself and downloaded. On the processor the
/// result is bit for bit the same as without an observer, where we apply all changes of
/// density in one pass.
///
/// # Errors
/// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
/// processor.
///
/// # Panics
/// If sizes differ, or another form of [`Compute`] made an image.
pub fn paint(
    compute: &mut Compute,
    wash: WashImages,
    textures: FrameTextures<'_>,
    settings: &Settings,
    mut observer: Option<StageObserver<'_>>,
) -> Result<ColorImage, DeviceError> {
    let paper = textures.paper;
    let color = paint_layer(compute, wash, textures, settings, &mut observer)?;
    let shading = paper_shading(&paper.texture, settings);
    let color = shade_paper(compute, color, &paper.heights, shading)?;
    report(&mut observer, compute, Stage::OnPaper, &color)?;
    Ok(color)
}

/// The layer of paint of [`paint`] with its coverage, before it is composited on the paper.
pub(super) fn paint_layer(
    compute: &mut Compute,
    wash: WashImages,
    textures: FrameTextures<'_>,
    settings: &Settings,
    observer: &mut Option<StageObserver<'_>>,
) -> Result<ColorImage, DeviceError> {
    let WashImages { color, dry_brush, density } = wash;
    let FrameTextures { flow, dispersion, paper, touch, back_runs } = textures;
    report(observer, compute, Stage::Wash, &color)?;
    let heights = &paper.heights;
    let (grain, px_per_slope) = match (&paper.fine, paper.texture.fine()) {
        (Some(image), Some(fine)) => (image, fine.per_slope(settings.wobble.amount_px)),
        _ => (heights, paper.texture.per_slope(settings.wobble.amount_px)),
    };
    let mut color = wobble(compute, color, grain, px_per_slope)?;
    report(observer, compute, Stage::Wobble, &color)?;
    let dry = settings.dry_brush.amount > 0.0;
    let dry_brush = match settings.dry_brush.color.as_deref().and_then(Rgb::from_hex) {
        Some(center) if dry => {
            let range = ColorRange::around(center, settings.dry_brush.tolerance);
            Some(color_mask(compute, &color, range, dry_brush.as_ref())?)
        }
        _ => dry_brush,
    };
    let outlines = match settings.dry_brush.outline_px {
        px if dry && px > 0.0 => Some(edges(compute, &color, px / OUTLINE_SIGMAS)?),
        _ => None,
    };
    let edges = match settings.edges.strength {
        0.0 => None,
        _ => Some(edges(compute, &color, settings.edges.width_px)?),
    };
    let layers = [
        (Stage::Edges, edges.as_ref(), settings.edges.strength, 0.0),
        (Stage::Flow, Some(flow), settings.flow.strength, 0.5),
        (Stage::BackRuns, back_runs, settings.back_runs.strength, 0.5),
        (Stage::Dispersion, Some(dispersion), settings.dispersion.strength, 0.5),
        // Pigment settles in the hollows.
        (Stage::Paper, Some(heights), -settings.paper.strength, 0.5),
    ];
    let layers = layers.map(|(stage, texture, strength, pivot)| {
        (stage, texture.map(|texture| DensityLayer { texture, strength, pivot }))
    });
    let overall = settings.wash.density;
    if observer.is_some() {
        for (stage, layer) in layers {
            let overall = if stage == Stage::Edges { overall } else { 1.0 };
            color = apply_density(compute, color, overall, layer.as_slice(), density.as_ref())?;
            report(observer, compute, stage, &color)?;
        }
    } else {
        let layers: Vec<_> = layers.into_iter().filter_map(|(_, layer)| layer).collect();
        color = apply_density(compute, color, overall, &layers, density.as_ref())?;
    }
    let reach = dry_brush_reach(&paper.texture, touch.map(|(_, own)| own), settings);
    let touched = touch.map_or(heights, |(image, _)| image);
    let outlines = outlines.as_ref();
    let dry_brush = dry_brush.as_ref();
    color = apply_dry_brush(compute, color, touched, flow, reach, outlines, dry_brush)?;
    report(observer, compute, Stage::DryBrush, &color)?;
    Ok(color)
}

/// The dry brush keeps this many standard deviations of the blur of outlines away from them.
const OUTLINE_SIGMAS: f32 = 2.0;

/// Contrast of an outline at which the brush is fully wet in the middle of the blurred outline.
const OUTLINE_CONTRAST: f32 = 0.02;

fn report(
    observer: &mut Option<StageObserver<'_>>,
    compute: &mut Compute,
    stage: Stage,
    color: &ColorImage,
) -> Result<(), DeviceError> {
    if let Some(observer) = observer {
        observer(stage, compute.download(color)?);
    }
    Ok(())
}

/// The reach of the dry brush of `settings` on this paper. The band in which paint fades is
/// centred on the height that leaves the wanted share of the paper bare.
fn dry_brush_reach(
    paper: &PaperTexture,
    touch: Option<&Quantiles>,
    settings: &Settings,
) -> DryBrushReach {
    let DryBrushSettings { softness, patches, darkest, outline_px, .. } = settings.dry_brush;
    let threshold = match settings.dry_brush.amount {
        amount if amount > 0.0 => {
            let above = touch.map_or_else(|| paper.height_above(amount), |touch| touch.at(amount));
            above + 0.5 * softness
        }
        _ => 0.0,
    };
    // A step of contrast c, blurred by sigma, has a gradient of 0.8 c / sigma in its middle.
    let outline = outline_px / OUTLINE_SIGMAS / 0.8 / OUTLINE_CONTRAST;
    // Water makes a dark of the subject paler, but it stays a dark.
    let darkest = darkest * (1.0 - (1.0 - darkest) * (settings.wash.density - 1.0)).max(0.0);
    DryBrushReach { threshold, softness, patches, outline, darkest }
}

fn paper_shading(paper: &PaperTexture, settings: &Settings) -> PaperShading {
    let color = Rgb::from_hex(&settings.paper.color).unwrap_or(Rgb([1.0; 3]));
    let relief = paper.relief_per_slope(settings.paper.relief);
    PaperShading { color: color.0.map(|value| value as f32), relief }
}

/// An abstracted picture, with the controls of the effects.
#[derive(Debug, Clone, PartialEq)]
pub struct Wash {
    /// Encoded sRGB in 0..1, then coverage: 1 where paint is, 0 on bare paper.
    pub color: Field<[f32; 4]>,
    /// Places with weaker effects.
    pub controls: Controls,
}

/// Factors of effects, 0 to 1 for each pixel, in the size of the picture. Without a control the
/// effect is at its full strength everywhere.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Controls {
    /// Factor of the dry brush.
    pub dry_brush: Option<Field<f32>>,
    /// Factor of all changes of density.
    pub density: Option<Field<f32>>,
}

/// Mask pictures of any size, which we stretch over a painting. White means full strength of the
/// effect, black means none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Masks {
    /// Mask of the dry brush.
    pub dry_brush: Option<Photograph>,
    /// Mask of all changes of density.
    pub density: Option<Photograph>,
}

impl Masks {
    /// The controls of a picture of `width` x `height` pixels: the mean of red, green and
    /// blue of each mask, as encoded.
    #[must_use]
    pub fn controls(&self, width: usize, height: usize) -> Controls {
        let [dry_brush, density] = [&self.dry_brush, &self.density].map(|mask| {
            let picture = mask.as_ref()?.on_canvas(width, height);
            let values = picture
                .values()
                .par_iter()
                .map(|rgb: &[f32; 3]| {
                    let encoded = Rgb(rgb.map(f64::from)).encoded().0;
                    (encoded.iter().sum::<f64>() / 3.0) as f32
                })
                .collect();
            Some(Field::from_values(width, height, values))
        });
        Controls { dry_brush, density }
    }
}

/// A [`Wash`] in the memory of a [`Compute`].
#[derive(Debug, Clone)]
pub struct WashImages {
    /// Encoded sRGB and coverage.
    pub color: ColorImage,
    /// Factor of the dry brush, 0 to 1.
    pub dry_brush: Option<GreyImage>,
    /// Factor of all changes of density, 0 to 1.
    pub density: Option<GreyImage>,
}

impl Wash {
    /// Copies the wash into the memory of `compute`.
    ///
    /// # Errors
    /// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
    /// processor.
    pub fn upload(&self, compute: &mut Compute) -> Result<WashImages, DeviceError> {
        let color = compute.upload(&self.color)?;
        WashImages::new(compute, color, &self.controls)
    }
}

impl WashImages {
    /// A picture in the memory of `compute`. This copies the controls there.
    ///
    /// # Errors
    /// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
    /// processor.
    pub fn new(
        compute: &mut Compute,
        color: ColorImage,
        controls: &Controls,
    ) -> Result<Self, DeviceError> {
        let dry_brush =
            controls.dry_brush.as_ref().map(|field| compute.upload(field)).transpose()?;
        let density = controls.density.as_ref().map(|field| compute.upload(field)).transpose()?;
        Ok(Self { color, dry_brush, density })
    }
}

/// Every compute kernel of watercolor.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![&TOON, &DENSITY, &EDGE_BLUR, &EDGES, &WOBBLE, &DRY_BRUSH, &COLOR_MASK, &PAPER_SHADING]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn darks_stay_darks_for_the_dry_brush_however_wet_the_wash_is() {
        let paper = PaperTexture::new(16, 16, &Settings::default().paper).unwrap();
        for (density, wanted) in [(1.0, 0.25), (0.5, 0.343_75), (2.0, 0.0625)] {
            let mut settings = Settings::default();
            (settings.dry_brush.darkest, settings.wash.density) = (0.25, density);
            let reach = dry_brush_reach(&paper, None, &settings);
            assert!((reach.darkest - wanted).abs() < 1e-6, "{} for {wanted}", reach.darkest);
        }
    }
}
