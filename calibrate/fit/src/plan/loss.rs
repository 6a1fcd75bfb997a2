//! Loss of a plan that has fewer swatches than the default plan.

use documents::{counted, counted_as};
use pigment::evaluate::percentile;

use super::exchange::RelativeDeviation;
use super::paints::{PaintSet, Purpose, SwatchRecipe};

/// Loss of a plan against the default number of swatches.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanLoss {
    /// Number of swatches of the default plan.
    pub full: usize,
    /// Number of swatches of this plan.
    pub swatches: usize,
    /// Number of swatches beyond the unknowns of a wavelength. With 0 a fit reproduces every error exactly.
    pub spare: usize,
    /// Kinds of swatches of which the default plan has more, and how many more.
    pub left_out: Vec<(Purpose, usize)>,
    /// Relative standard deviations that the default number of swatches would give, by paint. `None`
    /// without a prior library.
    pub full_deviations: Option<Vec<RelativeDeviation>>,
}

/// Purposes in the order of a plan.
const PURPOSES: [Purpose; 5] =
    [Purpose::Masstone, Purpose::Tint, Purpose::Shade, Purpose::Cross, Purpose::CrossTint];

impl PlanLoss {
    /// Compares the recipes of a plan with the recipes of the default plan.
    pub(super) fn of<'a>(
        paints: &PaintSet,
        recipes: &[SwatchRecipe],
        full: impl Iterator<Item = &'a SwatchRecipe> + Clone,
    ) -> Self {
        let left_out = PURPOSES.into_iter().filter_map(|purpose| {
            let is_one = |recipe: &&SwatchRecipe| recipe.purpose == purpose;
            let less = full.clone().filter(is_one).count();
            let less = less.saturating_sub(recipes.iter().filter(is_one).count());
            (less > 0).then_some((purpose, less))
        });
        Self {
            full: full.clone().count(),
            swatches: recipes.len(),
            spare: recipes.len().saturating_sub(paints.unknowns()),
            left_out: left_out.collect(),
            full_deviations: None,
        }
    }

    /// A sentence for the user on what the shorter plan loses. `deviations` are the expected deviations of K
    /// and S of each paint under this plan, in the order of `paints`.
    #[must_use]
    pub fn text(&self, paints: &PaintSet, deviations: Option<&[RelativeDeviation]>) -> String {
        let left_out: Vec<String> = self
            .left_out
            .iter()
            .map(|(purpose, count)| {
                let word = purpose.word();
                let many =
                    if word.ends_with('s') { format!("{word}es") } else { format!("{word}s") };
                counted_as(*count, word, &many)
            })
            .collect();
        let mut text =
            format!("{} instead of {}", counted_as(self.swatches, "swatch", "swatches"), self.full);
        if !left_out.is_empty() {
            text += &format!(", without {}", left_out.join(", "));
        }
        text += &match self.spare {
            0 => "; no swatch checks the fit, so that its errors and deviations tell nothing"
                .to_owned(),
            spare => format!("; {} the fit", counted_as(spare, "swatch checks", "swatches check")),
        };
        if let (Some(few), Some(full)) = (deviations, &self.full_deviations) {
            text += &growth(paints, few, full);
        }
        text
    }
}

/// Deviations of both plans, as medians over the paints, and the quantity that loses most.
fn growth(paints: &PaintSet, few: &[RelativeDeviation], full: &[RelativeDeviation]) -> String {
    let median = |of: &[RelativeDeviation], get: fn(&RelativeDeviation) -> Option<f64>| {
        percentile(&of.iter().filter_map(get).collect::<Vec<_>>(), 50.0)
    };
    let [k, full_k] = [few, full].map(|of| percent(median(of, |of| Some(of.absorption))));
    let [s, full_s] = [few, full].map(|of| percent(median(of, |of| of.scattering)));
    let mut text = format!(
        "; expected deviations: K {k} and S {s} instead of {full_k} and {full_s} (median of {})",
        counted(paints.names.len(), "paint")
    );
    let each = paints.names.iter().zip(few.iter().zip(full)).flat_map(|(name, (few, full))| {
        [("K", Some(few.absorption), Some(full.absorption)), ("S", few.scattering, full.scattering)]
            .into_iter()
            .filter_map(move |(letter, few, full)| Some((name, letter, few?, full?)))
    });
    let most = each.max_by(|a, b| (a.2 / a.3).total_cmp(&(b.2 / b.3)));
    if let Some((name, letter, few, full)) = most {
        text += &format!(
            "; {letter} of {name} loses most: {} instead of {}",
            percent(few),
            percent(full)
        );
    }
    text
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}
