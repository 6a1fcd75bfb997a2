//! Masses of paint for a swatch, as a balance can show them.

use super::error::PlanError;
use super::swatch_recipe::SwatchRecipe;
use pigment::Recipe;

/// Mass of a swatch, and the balance that weighs it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weighing {
    /// Mass of paint in one swatch, in grams.
    grams: f64,
    /// Step of the balance in grams.
    resolution: f64,
}

/// Least number of balance steps in a part: half a step is then 1 % of it.
const STEPS: f64 = 50.0;
/// Share of the weakest tint that every plan needs: 1 part in 5.
const NEEDED_SHARE: f64 = 0.2;

impl Weighing {
    /// Swatches of `grams` on a balance that shows steps of `resolution` grams.
    ///
    /// # Errors
    /// [`PlanError::Grams`] if 1 part in 5 cannot be weighed to 1 %, [`PlanError::NotPositive`] unless
    /// both are above 0.
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

    /// Smallest share that can be weighed to 1 %: fifty steps of the balance.
    #[must_use]
    pub fn least_share(&self) -> f64 {
        STEPS * self.resolution / self.grams
    }

    /// Paints of `recipe` with their masses in grams, rounded to the balance's step.
    #[must_use]
    pub fn grams(&self, recipe: &SwatchRecipe) -> Recipe {
        let steps = |share: f64| (share * self.grams / self.resolution).round();
        // Dividing by the number of steps in a gram gives the nearest decimal.
        let per_gram = (1.0 / self.resolution).round();
        let exact = (per_gram * self.resolution - 1.0).abs() < 1e-9;
        let weighed = |steps: f64| if exact { steps / per_gram } else { steps * self.resolution };
        recipe.shares().iter().map(|&(paint, share)| (paint, weighed(steps(share)))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::swatch_recipe::Purpose;
    use super::*;
    use pigment::PigmentId;

    #[test]
    fn grams_are_rounded_to_steps_of_the_balance() {
        let weighing = Weighing::new(10.0, 0.01).unwrap();
        let [first, second] = [PigmentId(1), PigmentId(2)];
        let recipe = SwatchRecipe { purpose: Purpose::Cross, parts: vec![(first, 1), (second, 2)] };
        assert_eq!(weighing.grams(&recipe), Recipe::from([(first, 3.33), (second, 6.67)]));
        assert!((weighing.least_share() - 0.05).abs() < 1e-12, "0.5 g of 10 g");
    }

    #[test]
    fn a_balance_too_coarse_is_refused_with_the_grams_needed() {
        let error = Weighing::new(10.0, 0.1).unwrap_err();
        assert!(matches!(error, PlanError::Grams { needed, .. } if needed == 25.0), "{error}");
        assert!(Weighing::new(f64::NAN, 0.1).is_err());
    }
}
