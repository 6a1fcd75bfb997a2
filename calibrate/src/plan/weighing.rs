//! From parts to grams that a balance can show.

use super::palette::PlanError;
use super::recipe::Recipe;

/// How much paint goes into a swatch, and what weighs it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weighing {
    /// Grams of paint a swatch.
    grams: f64,
    /// The step of the balance in grams.
    resolution: f64,
}

/// Steps of the balance in the smallest part: half a step is then 1 % of it.
const STEPS: f64 = 50.0;
/// The weakest tint without which nothing can be planned: 1 part in 5.
const NEEDED_SHARE: f64 = 0.2;

impl Weighing {
    /// `grams` a swatch on a balance that shows steps of `resolution` grams.
    ///
    /// # Errors
    /// [`PlanError::Grams`] if 1 part in 5 could not be weighed to 1 %,
    /// [`PlanError::NotPositive`] unless both are above 0.
    pub fn new(grams: f64, resolution: f64) -> Result<Self, PlanError> {
        for (what, value) in [("grams a swatch", grams), ("the step of the balance", resolution)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(PlanError::NotPositive { what, value });
            }
        }
        let needed = STEPS * resolution / NEEDED_SHARE;
        if grams < needed * (1.0 - 1e-9) {
            return Err(PlanError::Grams { needed, resolution, grams });
        }
        Ok(Self { grams, resolution })
    }

    /// The smallest share that can be weighed to 1 %: fifty steps of the
    /// balance.
    #[must_use]
    pub fn least_share(&self) -> f64 {
        STEPS * self.resolution / self.grams
    }

    /// Grams of each paint of `recipe`, to the balance's step.
    #[must_use]
    pub fn grams(&self, recipe: &Recipe) -> Vec<(usize, f64)> {
        let steps = |share: f64| (share * self.grams / self.resolution).round();
        // Dividing by the steps of a gram gives the nearest decimal.
        let per_gram = (1.0 / self.resolution).round();
        let exact = (per_gram * self.resolution - 1.0).abs() < 1e-9;
        let weighed = |steps: f64| if exact { steps / per_gram } else { steps * self.resolution };
        recipe.shares().into_iter().map(|(paint, share)| (paint, weighed(steps(share)))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::recipe::Purpose;
    use super::*;

    #[test]
    fn grams_are_steps_of_the_balance() {
        let weighing = Weighing::new(10.0, 0.01).unwrap();
        let recipe = Recipe { purpose: Purpose::Cross, parts: vec![(1, 1), (2, 2)] };
        assert_eq!(weighing.grams(&recipe), [(1, 3.33), (2, 6.67)]);
        assert!((weighing.least_share() - 0.05).abs() < 1e-12, "0.5 g of 10 g");
    }

    #[test]
    fn a_balance_too_coarse_is_refused_with_what_would_do() {
        let error = Weighing::new(10.0, 0.1).unwrap_err();
        assert!(matches!(error, PlanError::Grams { needed, .. } if needed == 25.0), "{error}");
        assert!(Weighing::new(f64::NAN, 0.1).is_err());
    }
}
