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
mod problem;
mod program;
mod banded;
mod forward;
mod objective;
mod scattering;
mod refined;
mod finite;

pub use finite::{FiniteProblem, MeasuredFilm, fit_finite};
pub use forward::{Condition, Unidentified, Unknown, condition, unidentified};
pub use objective::ExpectedNoise;
pub use pigment::fit_settings::{FitSettings, Method, Smoothness};
pub(crate) use problem::root_mean_square;
pub use problem::{FitError, Problem};
pub use program::{fit_qp, fit_weighted};
pub(crate) use refined::{AssumedPaints, PRIOR_INFORMATION, Slopes};
pub use refined::{Refined, RefinedState, Refinement, fit_refined, linear_deviations};
