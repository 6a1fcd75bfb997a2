//! Fit of K and S to observed swatches.
//!
//! There are three methods for shares of a mixture, each of which starts from the one before:
//!
//! | method | minimises, over K and S of every pigment |
//! |---|---|
//! | `qp` | per wavelength, the sum over mixtures of (C K - Q C S)^2, Q = K/S of each (Baxter, Wendt and Lin 2004, section 5.2): a quadratic program, K and S 0 and up, S = 1 for the reference white |
//! | `weighted` | the same sum with each row times dR/dQ over the mixture's own C S, which makes the residual an error of measured reflectance; re-weighted several times, the best iterate kept per wavelength |
//! | `refined` | a robust loss of the residuals in measured reflectance on a perceptual scale, plus the robust colour difference of each sample, plus the roughness of log K and log S over wavelength; see [`fit_refined`] |
//!
//! Absolute amounts on known backings have a method of their own, [`fit_finite`], which fits the finite
//! layer equation.

mod stage;
mod curves;
mod problem;
mod program;
mod weighted;
mod banded;
mod forward;
mod color_term;
mod noise;
mod objective;
mod deviations;
mod refined;
mod finite;
mod expected;
mod identification;
mod condition;

pub use condition::{Condition, condition};
pub use deviations::linear_deviations;
pub(crate) use expected::{AssumedPaints, PRIOR_INFORMATION, Slopes};
pub use finite::{FiniteProblem, MeasuredFilm, fit_finite};
pub use identification::{Unidentified, Unknown, unidentified};
pub use noise::ExpectedNoise;
pub use pigment::fit_settings::{FitSettings, Method, Smoothness};
pub(crate) use problem::root_mean_square;
pub use problem::{FitError, Problem};
pub use program::fit_qp;
pub(crate) use program::fit_qp_watched;
pub use refined::{Refined, RefinedState, Refinement, fit_refined};
pub use stage::{FitStage, Watch};
pub use weighted::fit_weighted;
pub(crate) use weighted::fit_weighted_watched;
