//! One set of pigments with its shares.

/// A recipe under way.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Candidate {
    /// Pigments of the library, rising.
    pub(super) pigments: Vec<usize>,
    /// A share for each, sum 1.
    pub(super) shares: Vec<f64>,
    /// The film's thickness.
    pub(super) thickness: f64,
    /// Weighted root mean square of the differences over the lights.
    pub(super) distance: f64,
}

impl Candidate {
    /// The share of `pigment`, 0 if it is not in the recipe.
    pub(super) fn share(&self, pigment: usize) -> f64 {
        self.pigments.iter().position(|&p| p == pigment).map_or(0.0, |at| self.shares[at])
    }
}
