//! Rounding of numbers to the digits of a file.
//!
//! Every number is rounded before it takes effect, so that a recording, which holds the
//! rounded numbers, paints the same bits when it is played.

use pigment::digits;

use super::action::{Action, Load, Recipe, Squeeze};
use super::stroke_action::Stroke;
use crate::document::Lighting;
use crate::optics::Gloss;
use crate::painting::MaskChange;
use crate::pose::Sample;
use crate::stroke::SampleDecimals;

impl Action {
    /// The action with its numbers rounded: samples to four decimals, all others to six
    /// significant digits. Writing and reading leaves a rounded action as it is.
    #[must_use]
    pub fn rounded(&self) -> Self {
        match self {
            Self::Load(load) => Self::Load(Load {
                brush: load.brush.clone(),
                recipe: recipe(&load.recipe),
                vehicle: six_digits(load.vehicle),
                amount_mm: six_digits(load.amount_mm),
            }),
            Self::Stroke(stroke) => Self::Stroke(round_stroke(stroke)),
            Self::Cut(stroke) => Self::Cut(round_stroke(stroke)),
            Self::Wipe { brush, keep } => {
                Self::Wipe { brush: brush.clone(), keep: six_digits(*keep) }
            }
            Self::Dry { fraction } => Self::Dry { fraction: six_digits(*fraction) },
            Self::Light(lighting) => Self::Light(Lighting {
                azimuth_deg: six_digits(lighting.azimuth_deg),
                elevation_deg: six_digits(lighting.elevation_deg),
                ambient: six_digits(lighting.ambient),
                relief: six_digits(lighting.relief),
                adaptation: six_digits(lighting.adaptation),
                ..lighting.clone()
            }),
            Self::Opacity { layer, value } => {
                Self::Opacity { layer: *layer, value: six_digits(*value) }
            }
            Self::Squeeze(squeeze) => Self::Squeeze(Squeeze {
                on: squeeze.on,
                recipe: recipe(&squeeze.recipe),
                vehicle: six_digits(squeeze.vehicle),
                x_mm: six_digits(squeeze.x_mm),
                y_mm: six_digits(squeeze.y_mm),
                volume_mm3: six_digits(squeeze.volume_mm3),
            }),
            Self::Mask(MaskChange::PolygonMm(points)) => {
                let points = points.iter().map(|point| point.map(six_digits));
                Self::Mask(MaskChange::PolygonMm(points.collect()))
            }
            Self::Gloss { wet, dry } => Self::Gloss { wet: gloss(*wet), dry: gloss(*dry) },
            Self::Stiffness { value } => Self::Stiffness { value: six_digits(*value) },
            Self::Wash { .. }
            | Self::Palette(_)
            | Self::Undo {}
            | Self::Redo {}
            | Self::Name { .. }
            | Self::Visible { .. }
            | Self::Order { .. }
            | Self::Swap { .. }
            | Self::Merge { .. }
            | Self::Scrape { .. }
            | Self::Mask(_)
            | Self::Save { .. } => self.clone(),
        }
    }
}

fn round_stroke(stroke: &Stroke) -> Stroke {
    Stroke {
        brush: stroke.brush.clone(),
        on: stroke.on,
        tool: stroke.tool.map(six_digits),
        samples: stroke
            .samples
            .iter()
            .map(|sample: &Sample| SampleDecimals::RECORDING.round(sample))
            .collect(),
    }
}

fn recipe(parts: &Recipe) -> Recipe {
    parts.iter().map(|(name, part)| (name.clone(), six_digits(*part))).collect()
}

fn gloss(gloss: Gloss) -> Gloss {
    let round = |value: f32| six_digits(f64::from(value)) as f32;
    Gloss { strength: round(gloss.strength), exponent: round(gloss.exponent) }
}

/// `value` rounded to six significant digits, and never -0, which a file cannot tell
/// from 0.
pub(crate) fn six_digits(value: f64) -> f64 {
    digits::rounded(value) + 0.0
}
