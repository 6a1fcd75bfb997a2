//! From flat colours to a watercolor: effects in their order.
//!
//! Wobble, edges, flow, dispersion and paper as in Bousseau et al. 2006, figure 4; then the
//! dry brush, and the sheet.

use spectra::color::Rgb;

use super::color_mask::{ColorMask, ColorRange};
use super::density::{Density, DensityLayer};
use super::dry_brush::{DryBrush, DryBrushReach};
use super::edges::Edges;
use super::settings::{DryBrushSettings, Settings};
use super::sheet::{OnSheet, Sheet};
use super::textures::{PaperOn, PaperTexture};
use super::wash::Wash;
use super::wobble::Wobble;
use graphics::gpu::DeviceError;
use graphics::image::Backend;

/// A backend that does all that watercolor needs.
pub trait Watercolor: Wobble + Edges + Density + ColorMask + DryBrush + OnSheet {}

impl<B: Wobble + Edges + Density + ColorMask + DryBrush + OnSheet> Watercolor for B {}

/// A picture on its way, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Flat colours, as they came.
    Wash,
    /// Displaced by the paper's grain.
    Wobble,
    /// Of the wash's density, and denser at its edges.
    Edges,
    /// With clouds.
    Flow,
    /// With grains of pigment.
    Dispersion,
    /// Denser in the hollows of the paper.
    Paper,
    /// Bare where the brush was dry.
    DryBrush,
    /// On its sheet.
    Sheet,
}

impl Stage {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Wash,
        Self::Wobble,
        Self::Edges,
        Self::Flow,
        Self::Dispersion,
        Self::Paper,
        Self::DryBrush,
        Self::Sheet,
    ];

    /// As files are named.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Wash => "wash",
            Self::Wobble => "wobble",
            Self::Edges => "edges",
            Self::Flow => "flow",
            Self::Dispersion => "dispersion",
            Self::Paper => "paper",
            Self::DryBrush => "dry-brush",
            Self::Sheet => "sheet",
        }
    }
}

/// A wash with a backend.
#[derive(Debug)]
pub struct WashOn<B: Backend> {
    /// Encoded sRGB and coverage.
    pub color: B::Color,
    /// Where the brush is dry; everywhere if none.
    pub dry_brush: Option<B::Grey>,
    /// Where density changes; everywhere if none.
    pub density: Option<B::Grey>,
}

impl Wash {
    /// Puts it where it is worked on.
    ///
    /// # Errors
    /// As [`Backend::color_of`].
    pub fn on<B: Backend>(&self, backend: &mut B) -> Result<WashOn<B>, DeviceError> {
        let mut grey = |field: &Option<_>| field.as_ref().map(|f| backend.grey_of(f)).transpose();
        let (dry_brush, density) = (grey(&self.controls.dry_brush)?, grey(&self.controls.density)?);
        Ok(WashOn { color: backend.color_of(&self.color)?, dry_brush, density })
    }
}

/// Told of every stage: the picture is only lent, and later stages change it.
pub type Watcher<'a, B> =
    &'a mut dyn FnMut(&mut B, Stage, &<B as Backend>::Color) -> Result<(), DeviceError>;

/// Paints `wash` with clouds and grains of this moment on `paper`; the picture on its
/// sheet. Settings are those for its size ([`Settings::for_size`]). All stages are as
/// they are without a `watcher`, bit for bit with the processor, which then changes all
/// densities in one go.
///
/// # Errors
/// As [`Backend::color_of`], and what the watcher says.
///
/// # Panics
/// If sizes differ.
pub fn paint<B: Watercolor>(
    backend: &mut B,
    wash: WashOn<B>,
    flow: &B::Grey,
    dispersion: &B::Grey,
    paper: &PaperOn<B>,
    settings: &Settings,
    mut watcher: Option<Watcher<'_, B>>,
) -> Result<B::Color, DeviceError> {
    let WashOn { color, dry_brush, density } = wash;
    tell(&mut watcher, backend, Stage::Wash, &color)?;
    let heights = &paper.heights;
    let displaced = paper.texture.per_slope(settings.wobble.amount_px);
    let mut color = backend.wobbled(color, heights, displaced)?;
    tell(&mut watcher, backend, Stage::Wobble, &color)?;
    let dry = settings.dry_brush.amount > 0.0;
    let dry_brush = match settings.dry_brush.color.as_deref().and_then(Rgb::from_hex) {
        Some(like) if dry => {
            let range = ColorRange::around(like, settings.dry_brush.tolerance);
            Some(backend.color_mask(&color, range, dry_brush.as_ref())?)
        }
        _ => dry_brush,
    };
    let edges = match settings.edges.strength {
        0.0 => None,
        _ => Some(backend.edges(&color, settings.edges.width_px)?),
    };
    let layers = [
        (Stage::Edges, edges.as_ref(), settings.edges.strength, 0.0),
        (Stage::Flow, Some(flow), settings.flow.strength, 0.5),
        (Stage::Dispersion, Some(dispersion), settings.dispersion.strength, 0.5),
        // Pigment settles in the hollows.
        (Stage::Paper, Some(heights), -settings.paper.strength, 0.5),
    ];
    let layer = |(stage, texture, strength, pivot): (_, Option<_>, _, _)| {
        (stage, texture.map(|texture| DensityLayer { texture, strength, pivot }))
    };
    let (layers, overall) = (layers.map(layer), settings.wash.density);
    if watcher.is_some() {
        for (stage, layer) in layers {
            let overall = if stage == Stage::Edges { overall } else { 1.0 };
            color = backend.densified(color, overall, layer.as_slice(), density.as_ref())?;
            tell(&mut watcher, backend, stage, &color)?;
        }
    } else {
        let layers: Vec<_> = layers.into_iter().filter_map(|(_, layer)| layer).collect();
        color = backend.densified(color, overall, &layers, density.as_ref())?;
    }
    color = backend.dry_brushed(
        color,
        heights,
        flow,
        reach(&paper.texture, settings),
        dry_brush.as_ref(),
    )?;
    tell(&mut watcher, backend, Stage::DryBrush, &color)?;
    color = backend.on_sheet(color, heights, sheet(paper, settings))?;
    tell(&mut watcher, backend, Stage::Sheet, &color)?;
    Ok(color)
}

fn tell<B: Backend>(
    watcher: &mut Option<Watcher<'_, B>>,
    backend: &mut B,
    stage: Stage,
    color: &B::Color,
) -> Result<(), DeviceError> {
    match watcher {
        Some(watcher) => watcher(backend, stage, color),
        None => Ok(()),
    }
}

/// The dry brush of `settings` on this paper: half of the band in which paint fades
/// lies above the height that leaves the wanted share bare.
pub(super) fn reach(paper: &PaperTexture, settings: &Settings) -> DryBrushReach {
    let DryBrushSettings { softness, patches, .. } = settings.dry_brush;
    let threshold = match settings.dry_brush.amount {
        amount if amount > 0.0 => paper.height_above(amount) + 0.5 * softness,
        _ => 0.0,
    };
    DryBrushReach { threshold, softness, patches }
}

fn sheet<B: Backend>(paper: &PaperOn<B>, settings: &Settings) -> Sheet {
    let color = Rgb::from_hex(&settings.paper.color).unwrap_or(Rgb([1.0; 3]));
    let relief = paper.texture.relief_per_slope(settings.paper.relief);
    Sheet { color: color.0.map(|value| value as f32), relief }
}
