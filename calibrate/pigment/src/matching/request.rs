//! What is asked of a recipe.

use super::film::{FilmKind, Thickness};
use super::forward::MOST_PIGMENTS;
use super::sight::{Metric, Sight};
use crate::library::{AmountKind, PigmentLibrary};

/// The limits of the recipes to be searched.
#[derive(Debug, Clone, PartialEq)]
pub struct MatchRequest {
    /// The lights; at least one.
    pub sights: Vec<Sight>,
    /// How colours are compared.
    pub metric: Metric,
    /// How the mixture will be laid.
    pub film: FilmKind,
    /// The pigments that may take part, by index in the library.
    pub allowed: Vec<usize>,
    /// Those of them that must take part, with their share (0..1) where it is
    /// told.
    pub required: Vec<(usize, Option<f64>)>,
    /// The most pigments of one recipe, 1 to 8.
    pub at_most: usize,
    /// The least share of a pigment that takes part, 0..1: what can be weighed or
    /// cut off with a knife.
    pub least_share: f64,
    /// Recipes in whole parts, this many together at most.
    pub whole_parts: Option<u32>,
    /// Cost of one unit of amount, by pigment of the library; empty if unknown.
    pub costs: Vec<f64>,
    /// Recipes whose distance exceeds the nearest one's by no more than this count
    /// as equally near.
    pub tolerance: f64,
    /// How many recipes are wanted.
    pub count: usize,
}

impl MatchRequest {
    /// All identified pigments of `library`, up to four in a recipe, none below
    /// 1/50, five recipes.
    #[must_use]
    pub fn new(library: &PigmentLibrary, sights: Vec<Sight>, film: FilmKind) -> Self {
        let identified = |index: &usize| library.pigments[*index].identified;
        Self {
            sights,
            metric: Metric::default(),
            film,
            allowed: (0..library.pigments.len()).filter(identified).collect(),
            required: Vec::new(),
            at_most: 4,
            least_share: 0.02,
            whole_parts: None,
            costs: Vec::new(),
            tolerance: 0.05,
            count: 5,
        }
    }

    /// The least and the greatest thickness; 1 for a film that hides.
    pub(super) fn thickness(&self) -> (f64, f64) {
        match &self.film {
            FilmKind::Hiding => (1.0, 1.0),
            FilmKind::Over { thickness, .. } => thickness.bounds(),
        }
    }

    /// The least and the greatest share of a pigment that takes part.
    pub(super) fn share_bounds(&self, pigment: usize) -> (f64, f64) {
        match self.required.iter().find(|(required, _)| *required == pigment) {
            Some((_, Some(share))) => (*share, *share),
            _ => (self.least_share, 1.0),
        }
    }

    /// # Errors
    /// [`MatchError`] if the request cannot be met by any recipe.
    pub(super) fn check(&self, library: &PigmentLibrary) -> Result<(), MatchError> {
        let invalid = |what: &'static str, value: f64, hint: &'static str| {
            Err(MatchError::Number { what, value, hint })
        };
        if self.allowed.is_empty() {
            return Err(MatchError::NoPigments);
        }
        if self.sights.is_empty() {
            return Err(MatchError::NoLight);
        }
        if let Some(sight) = self.sights.iter().find(|s| !(s.weight > 0.0 && s.weight < 1e9)) {
            return invalid(
                "a light's weight must be above 0",
                sight.weight,
                "give the weight behind the light: --illuminant D65 --illuminant A=0.5",
            );
        }
        if !(1..=MOST_PIGMENTS).contains(&self.at_most) {
            return invalid("a recipe has 1 to 8 pigments", self.at_most as f64, "try --at-most 4");
        }
        if self.required.len() > self.at_most {
            return Err(MatchError::TooManyRequired {
                required: self.required.len(),
                at_most: self.at_most,
            });
        }
        if !(0.0..1.0).contains(&self.least_share) {
            return invalid(
                "the least share is 0 or more and below 1",
                self.least_share,
                "try --least 1/50",
            );
        }
        if !(0.0..1e3).contains(&self.tolerance) {
            return invalid("the tolerance is 0 or more", self.tolerance, "try --tolerance 0.05");
        }
        if let Some(cost) = self.costs.iter().find(|c| !(c.is_finite() && **c >= 0.0)) {
            return invalid("a cost is 0 or more", *cost, "try --cost \"Cobalt Blue=0.9\"");
        }
        let told: f64 = self.required.iter().filter_map(|(_, share)| *share).sum();
        let all_told = !self.required.is_empty() && self.required.iter().all(|r| r.1.is_some());
        let whole = told > 1.0 + 1e-9 || (told > 1.0 - 1e-9 && !all_told);
        let wrong = self.required.iter().filter_map(|(_, s)| *s).find(|s| !(*s > 0.0 && *s <= 1.0));
        if wrong.is_some() || whole {
            return Err(MatchError::Shares { total: told });
        }
        if self.whole_parts.is_some() && told > 0.0 {
            return Err(MatchError::SharesInParts);
        }
        if self.whole_parts.is_some_and(|parts| !(1..=1000).contains(&parts)) {
            return invalid(
                "whole parts are 1 to 1000",
                f64::from(self.whole_parts.unwrap_or(0)),
                "try --parts 12",
            );
        }
        let (thinnest, thickest) = self.thickness();
        if !(thinnest > 0.0 && thinnest <= thickest && thickest <= 1e9) {
            return invalid("a thickness is above 0", thinnest, "try --thickness 1");
        }
        let absolute = library.amounts == AmountKind::Absolute;
        if absolute && self.film == FilmKind::Hiding {
            return Err(MatchError::AbsoluteHiding);
        }
        Ok(())
    }

    /// The film of `library` where nothing is told: one that hides; for absolute
    /// amounts a wash over `ground`, from nearly clear to nearly hiding (the mean
    /// of K + S over pigments and wavelengths, times the thickness, from 0.01 to
    /// 10).
    #[must_use]
    pub fn usual_film(library: &PigmentLibrary, ground: Vec<f64>) -> FilmKind {
        if library.amounts == AmountKind::Relative {
            return FilmKind::Hiding;
        }
        let curves = library.pigments.iter().flat_map(|p| p.absorption.iter().zip(&p.scattering));
        let count = (library.pigments.len() * library.grid.count()) as f64;
        let mean = (curves.map(|(k, s)| k + s).sum::<f64>() / count).max(1e-9);
        FilmKind::Over { ground, thickness: Thickness::Between(0.01 / mean, 10.0 / mean) }
    }
}

/// Why there are no recipes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MatchError {
    /// No pigment may take part.
    #[error("no pigment is left to mix with")]
    NoPigments,
    /// No light.
    #[error("a recipe is judged under at least one light")]
    NoLight,
    /// A number out of its range.
    #[error("{what}, found `{value}`")]
    Number {
        /// The range.
        what: &'static str,
        /// The number.
        value: f64,
        /// What to try.
        hint: &'static str,
    },
    /// More pigments must take part than may.
    #[error("{required} pigments must take part, but a recipe has `{at_most}` at most")]
    TooManyRequired {
        /// How many must.
        required: usize,
        /// How many may.
        at_most: usize,
    },
    /// Shares that leave nothing for the others, or more than everything.
    #[error(
        "fixed shares are above 0 and leave room for the other pigments, found a sum of `{total}`"
    )]
    Shares {
        /// Their sum.
        total: f64,
    },
    /// A fixed share of whole parts.
    #[error("recipes in whole parts take no fixed shares")]
    SharesInParts,
    /// Absolute amounts have no film that hides.
    #[error("a library of absolute amounts makes films over a ground")]
    AbsoluteHiding,
}

impl MatchError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::NoPigments => Some("allow more of the library's pigments"),
            Self::TooManyRequired { .. } => Some("raise --at-most, or require fewer pigments"),
            Self::Shares { .. } => Some("let fixed shares sum to less than 1"),
            Self::SharesInParts => Some("leave out --parts, or the share behind the pigment"),
            Self::AbsoluteHiding => Some("give a --thickness"),
            Self::Number { hint, .. } => Some(hint),
            Self::NoLight => None,
        }
    }
}
