//! From observed swatches to K and S.
//!
//! Three methods for shares of a mixture, each starting from the one before:
//!
//! | method | minimises, over K and S of every pigment |
//! |---|---|
//! | `qp` | per wavelength, the sum over mixtures of (C K - Q C S)^2, Q = K/S of each (Baxter, Wendt and Lin 2004, 5.2): a quadratic program, K and S 0 and up, S = 1 for the reference white |
//! | `weighted` | the same with each row times dR/dQ over the mixture's own C S, which makes the residual an error of measured reflectance; re-weighted, the best iterate kept per wavelength |
//! | `refined` | a robust loss of the residual in measured reflectance on a perceptual scale, plus the robust colour difference of each sample, plus roughness of log K and log S over wavelength; see `refined` |
//!
//! and one for absolute amounts on a known backing, `finite`, which fits the
//! finite layer equation itself.

mod problem;

mod program;

mod weighted;

mod banded;

mod curves;

mod forward;

mod color_term;

mod noise;

mod objective;

mod refined;

mod finite;

mod expected;

mod identification;

mod deviations;

mod condition;

pub use condition::{Condition, condition};
pub use deviations::linear_deviations;
pub use expected::ExpectedNoise;
pub(crate) use expected::{Belief, PRIOR_INFORMATION, Slopes};
pub use finite::{FiniteProblem, fit_finite};
pub use identification::{Unidentified, Unknown, unidentified};
pub use pigment::fit_settings::{FitSettings, Method, Smoothness};
pub(crate) use problem::root_mean_square;
pub use problem::{FitError, Problem};
pub use program::fit_qp;
pub use refined::{Refined, RefinedState, Refinement, fit_refined};
pub use weighted::fit_weighted;
