//! How far maps can be believed: measured mixtures and simulated paintings, whose pigments are known.
//!
//! No scan of a painting with known pigments is at hand. These trials use measured swatches as pixels, each
//! with a library that was fitted without it, and simulated pixels whose real K and S are off. Linear
//! methods that are in common use stand beside them.

mod scores;
mod baselines;
mod swatches;
mod simulated;
mod oils;

pub use baselines::{Baseline, Unmixed};
pub use oils::{
    Missing, PaintingTrials, Told, light_palette, missing_pigment, oil_groups, painting_trials,
    prepared_oils, tone,
};
pub use scores::{Coverage, Reliability, ScoreSums, Scores, Trial, coverage, covered, reliability};

pub use simulated::{BesideTruth, Painting, PaintingPlan};
pub use swatches::{
    Choice, NamedGroups, SwatchTrials, choose_penalty, residuals_of, swatch_trials,
};
