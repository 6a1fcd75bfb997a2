//! The paints of a plan.

use super::error::PlanError;
use crate::measurement::names_a_pigment;
use pigment::PigmentId;

/// The paints to be measured: the white, the colours, the black.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PaintSet {
    /// Names of all paints: the white, the colours in their given order, the black.
    pub names: Vec<String>,
    /// Place of the black, if there is one.
    pub black: Option<PigmentId>,
}

impl PaintSet {
    /// Place of the white, whose S is 1.
    pub const WHITE: PigmentId = PigmentId(0);

    /// Collects the paints. White and black may be named among the colours too.
    ///
    /// # Errors
    /// [`PlanError::Name`] for a name that a column of a measurement file cannot have,
    /// [`PlanError::Twice`] for one given twice, [`PlanError::NoColor`] for a white alone.
    pub fn new(colors: &[String], white: &str, black: Option<&str>) -> Result<Self, PlanError> {
        let special = |name: &&String| *name == white || Some(name.as_str()) == black;
        let mut names = vec![white.to_owned()];
        names.extend(colors.iter().filter(|name| !special(name)).cloned());
        names.extend(black.map(str::to_owned));
        for (index, name) in names.iter().enumerate() {
            if !names_a_pigment(name) {
                return Err(PlanError::Name { name: name.clone() });
            }
            if names[..index].contains(name) {
                return Err(PlanError::Twice { name: name.clone() });
            }
        }
        if names.len() < 2 {
            return Err(PlanError::NoColor);
        }
        let black = black.map(|_| PigmentId(names.len() - 1));
        Ok(Self { names, black })
    }

    /// Places of all paints.
    pub fn ids(&self) -> impl Iterator<Item = PigmentId> + Clone + use<> {
        (0..self.names.len()).map(PigmentId)
    }

    /// Places of all paints but white and black.
    pub fn colors(&self) -> impl Iterator<Item = PigmentId> + Clone + use<> {
        let end = self.black.map_or(self.names.len(), PigmentId::index);
        (1..end).map(PigmentId)
    }

    /// Name of one paint.
    ///
    /// # Panics
    /// If `paint` belongs to a larger set.
    #[must_use]
    pub fn name(&self, paint: PigmentId) -> &str {
        &self.names[paint.index()]
    }

    /// Number of unknowns per wavelength, which is the least number of swatches: K of every paint, S of
    /// all but the white.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        2 * self.names.len() - 1
    }
}
