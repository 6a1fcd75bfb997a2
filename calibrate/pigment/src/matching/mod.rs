//! Recipes for a colour.
//!
//! Finds which pigments of a library, and how much of each, come nearest to a target under one light or
//! several, or to its spectrum. Every set of pigments is tried, from one pigment up to the requested number.
//! The shares of each set are found by least squares in the difference itself, starting from the best recipe
//! of a set with one pigment fewer.

mod viewing_condition;
mod bounded_step;
mod bounded_descent;
mod spectral_target;
mod target;
mod film;
mod error;
mod request;
mod candidate;
mod forward;
mod descent;
mod search_control;
mod search;
mod whole_parts;
mod ranking;
mod prices;
mod options;
mod recipe_search;
mod told;
mod least_addition;
mod correction;

pub use bounded_descent::{Cost, descend_within_bounds};
pub use bounded_step::{Bounds, MAX_PIGMENTS, UNKNOWNS};
pub use correction::{Batch, Correction, CorrectionOptions, Corrections, USUAL_CORRECTION};
pub use error::MatchError;
pub use film::{FilmKind, Thickness};
pub use options::{MatchOptions, RequiredName, ToleranceOrigin};
pub use prices::{PriceError, PriceList, parse_price};
pub use ranking::{AmountLimit, RecipeMatch, recipes, recipes_with_control};
pub use recipe_search::{RecipeMatches, RecipeSearch};
pub use request::{MatchRequest, RequiredPigment, USUAL_SPECTRUM_TOLERANCE, USUAL_TOLERANCE};
pub use search_control::SearchControl;
pub use spectral_target::SpectralTarget;
pub use target::{ColorTarget, Target, TargetColor};
pub use viewing_condition::{Metric, SpectrumWeights, ViewingCondition};
pub use whole_parts::few_parts;
