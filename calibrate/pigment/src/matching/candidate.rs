//! One set of pigments with its shares.

use crate::recipe::PigmentId;

/// A recipe during the search.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Candidate {
    /// Pigments of the library, in rising order.
    pub(super) pigments: Vec<PigmentId>,
    /// Share of each pigment, sum 1.
    pub(super) shares: Vec<f64>,
    /// Thickness of the film in the library's unit.
    pub(super) thickness: f64,
    /// Weighted root mean square of the differences in the request's metric.
    pub(super) distance: f64,
}

impl Candidate {
    /// Share of `pigment`, 0 if it is not in the recipe.
    pub(super) fn share(&self, pigment: PigmentId) -> f64 {
        self.pigments.iter().position(|&p| p == pigment).map_or(0.0, |at| self.shares[at])
    }
}
