//! Recipes for a colour.
//!
//! You learn which pigments of a library, and how much of each, come nearest to a target under one light or
//! several, or to its spectrum. We try every set of pigments, from one pigment up to the number that you
//! request. For each set we find the shares by least squares in the difference itself. We start from the
//! best recipe of a set with one pigment fewer.

mod target;
mod target_book;
mod limits;
mod forward;
mod search;
mod ranking;
mod request;
mod recipe_search;
mod pot;
mod additions;
mod correction;

pub use super::least_squares::{Bounds, Cost, MAX_PIGMENTS, UNKNOWNS, descend_within_bounds};
pub use correction::{
    Batch, BatchRound, CorrectRequest, Correction, Corrections, PotPaint, USUAL_CORRECTION,
};
pub use limits::{
    FilmKind, MatchError, RecipeLimits, RequiredPigment, Thickness, USUAL_SPECTRUM_TOLERANCE,
    USUAL_TOLERANCE,
};
pub use ranking::{AmountLimit, RecipeMatch, few_parts, recipes};
pub use recipe_search::{RecipeMatches, RecipeSearch};
pub use request::{
    MatchRequest, PriceError, PriceList, RequiredName, ToleranceOrigin, parse_price, parse_share,
};
pub use target::{
    ColorTarget, Metric, SpectralTarget, SpectrumWeights, Target, TargetColor, ViewingCondition,
};
pub use target_book::TargetBook;
