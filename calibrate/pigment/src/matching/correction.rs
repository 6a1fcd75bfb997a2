//! Correcting a batch of paint: you learn what to add to the pot, so that its measured colour becomes the
//! target.
//!
//! A recipe predicts the K and S of the pot, but nobody weighs exactly what the recipe says. We therefore
//! scale the predicted K at each wavelength until K / S agrees with the measured film. S stays as
//! predicted. Then we mix the additions into this paint. The measurement already contains the errors of the
//! recipe and of the model at the pot's colour, so only the errors of the additions remain (after Allen
//! 1974, correction by the batch's own reflectance).
//!
//! The search returns the smallest addition that brings the colour near enough to the target.

use documents::{Cancelled, Task};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use spectra::color::{Lab, delta_e_ciede2000};
use spectra::optics::absorption_over_scattering;
use spectra::{Extrapolation, InterpolateError, Interpolation, Reflectance, Spectrum};

use super::forward::{Forward, Scratch};
use super::limits::{FilmKind, MatchError, RecipeLimits, RequiredPigment};
use super::recipe_search::spectrum_of;
use super::request::find_all;
use super::search::{Candidate, descend, expected, search, within_limits};
use super::target::{ColorTarget, Metric, Target, TargetColor, ViewingCondition};
use crate::evaluate::{Remark, check_visible_band, lab};
use crate::least_squares::MAX_PIGMENTS;
use crate::library::{AmountKind, Pigment, PigmentLibrary};
use crate::recipe::PigmentId;

/// We use no internal reflectance below this. Smaller readings say nothing about K / S.
const LEAST_INTERNAL: f64 = 1e-4;
/// Default difference from the target that is near enough, in CIEDE2000, or in percent of reflectance for a
/// match by spectrum. It is about the smallest difference that you see side by side.
pub const USUAL_CORRECTION: f64 = 0.5;

/// A pot of paint that you mixed and measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Batch {
    /// Names of the pigments that you mixed, with their parts in any unit.
    pub made: Vec<(String, f64)>,
    /// Mass of the paint in the pot in grams, above 0.
    pub grams: f64,
    /// Measured reflectance of a film of this paint that hides.
    pub reflectance: Spectrum<Reflectance>,
}

/// Options of a correction, which every program fills in its own way. [`Self::run`] searches corrections. Comments
/// of the fields are the help texts of the command line and the descriptions of the schema.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Options of a correction")]
pub struct CorrectRequest {
    /// Match the color under the lights, or the spectrum of a measured standard
    #[serde(rename = "by")]
    pub metric: Metric,
    /// Grams of a pigment in stock (may be repeated); others have no limit
    pub stock: Vec<(String, f64)>,
    /// Add only these pigments (may be repeated) [default: all whose S is known]
    pub only: Vec<String>,
    /// A pigment that is not added (may be repeated)
    pub without: Vec<String>,
    /// Maximum number of pigments to add, 1 to 7
    pub at_most: usize,
    /// Least grams of a pigment that can be weighed [default: a thousandth of the batch]
    pub least_grams: Option<f64>,
    /// Most grams to add in all [default: as much as the batch]
    pub most_grams: Option<f64>,
    /// Difference from the target that is near enough, in CIEDE2000 or, by spectrum, % of reflectance
    pub tolerance: f64,
    /// Number of corrections to show
    pub count: usize,
    /// Lights under which the paint is judged, with their weights
    pub conditions: Vec<ViewingCondition>,
}

impl Default for CorrectRequest {
    fn default() -> Self {
        Self {
            metric: Metric::default(),
            stock: Vec::new(),
            only: Vec::new(),
            without: Vec::new(),
            at_most: 3,
            least_grams: None,
            most_grams: None,
            tolerance: USUAL_CORRECTION,
            count: 5,
            conditions: vec![ViewingCondition::default()],
        }
    }
}

/// An addition to the pot.
#[derive(Debug, Clone, PartialEq)]
pub struct Correction {
    /// Pigments with the grams to add, the most first.
    pub additions: Vec<(PigmentId, f64)>,
    /// Sum of all additions in grams.
    pub grams: f64,
    /// CIEDE2000 of the corrected paint from the target under each light.
    pub delta_e: Vec<f64>,
    /// Weighted root mean square of `delta_e` over the lights. If you match by spectrum, root mean square
    /// of the differences of reflectance, in percent.
    pub distance: f64,
    /// Root mean square of the differences of reflectance from a measured target, in percent.
    pub rms_percent: Option<f64>,
    /// Colour of the corrected paint under each light.
    pub lab: Vec<Lab>,
    /// Measured reflectance of the corrected paint on the library's grid.
    pub reflectance: Vec<f64>,
    /// Pigments of which you add the whole stock.
    pub out_of_stock: Vec<PigmentId>,
}

/// Corrections of a batch.
#[derive(Debug, Clone, PartialEq)]
pub struct Corrections {
    /// Colours that the paint should have.
    pub target: Target,
    /// Measured colour of the batch under each light.
    pub batch: Vec<Lab>,
    /// CIEDE2000 of the batch from the target under each light.
    pub batch_delta_e: Vec<f64>,
    /// Root mean square of the differences of reflectance of the batch from a measured target, in percent.
    pub batch_rms_percent: Option<f64>,
    /// CIEDE2000 of the batch from what its recipe predicts, under each light.
    pub recipe_delta_e: Vec<f64>,
    /// Whether the batch is within the tolerance, so that you need not correct it.
    pub is_near: bool,
    /// Whether the corrections bring the batch within the tolerance.
    pub reaches: bool,
    /// Corrections within the tolerance, the least addition first. If there are none, you get those that
    /// come nearest, the nearest first. Empty if you need not correct the batch.
    pub corrections: Vec<Correction>,
    /// Warnings about the spectra.
    pub remarks: Vec<Remark>,
}

impl CorrectRequest {
    /// Searches what you add to `batch` so that it gets the colour of `target`. The least addition comes
    /// first. `task` counts the sets of pigments that we tried.
    ///
    /// ```
    /// use documents::Task;
    /// use pigment::matching::{Batch, CorrectRequest};
    /// use pigment::{ColorTarget, PigmentLibrary, Viewing};
    ///
    /// let oils = PigmentLibrary::van_gogh_oils();
    /// let paint = |blue| oils.color([("Zinc White", 100.0), ("Cobalt Blue", blue)], &Viewing::default());
    /// let standard = ColorTarget::measured("standard", paint(12.0)?.reflectance);
    /// // Less blue was weighed than the recipe says.
    /// let batch = Batch {
    ///     made: vec![("Zinc White".into(), 100.0), ("Cobalt Blue".into(), 12.0)],
    ///     grams: 500.0,
    ///     reflectance: paint(9.0)?.reflectance,
    /// };
    /// let found = CorrectRequest::default().run(&oils, &standard, &batch, &Task::default())?;
    /// let least = &found.corrections[0];
    /// assert!(found.reaches && least.distance <= 0.5 && least.grams < 25.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`MatchError`] for an unknown pigment, a number out of range, a library of absolute amounts, or if `task`
    /// was cancelled.
    pub fn run(
        &self,
        library: &PigmentLibrary,
        target: &ColorTarget,
        batch: &Batch,
        task: &Task,
    ) -> Result<Corrections, MatchError> {
        self.check(library, batch)?;
        let mut remarks: Vec<Remark> =
            check_visible_band(batch.reflectance.grid())?.into_iter().collect();
        if let TargetColor::Reflectance(reflectance) = &target.color {
            remarks.extend(check_visible_band(reflectance.grid())?);
        }
        let (with_pot, predicted) = library_with_pot(library, batch)?;
        let conditions = &self.conditions;
        let spectrum = spectrum_of(target, library.grid, (self.metric, conditions), &mut remarks)?;
        let target = Target { spectrum, ..target.under(conditions)? };
        let measured = Target::from_reflectance("batch", &batch.reflectance, conditions)?.lab;
        let weights: Vec<_> = conditions
            .iter()
            .map(|condition| condition.viewing.weights(library.grid))
            .collect::<Result<_, _>>()?;
        let recipe: Vec<Lab> = weights.iter().map(|weights| lab(weights, &predicted)).collect();
        let batch_delta_e = differences(&measured, &target.lab);
        let total: f64 = conditions.iter().map(|condition| condition.weight).sum();
        let squares = batch_delta_e.iter().zip(conditions).map(|(d, c)| d * d * c.weight / total);
        let batch_rms_percent = match &target.spectrum {
            Some(spectrum) => Some(spectrum.rms_percent(on_grid(library, batch)?.values())),
            None => None,
        };
        let by_spectrum = self.metric.spectrum_weights().and(batch_rms_percent);
        let off = by_spectrum.unwrap_or_else(|| squares.sum::<f64>().sqrt());
        let is_near = off <= self.tolerance;
        let mut found = Corrections {
            recipe_delta_e: differences(&measured, &recipe),
            target,
            batch: measured,
            batch_delta_e,
            batch_rms_percent,
            is_near,
            reaches: is_near,
            corrections: Vec::new(),
            remarks,
        };
        if is_near {
            return Ok(found);
        }
        let additions = self.additions(library, &with_pot, batch.grams)?;
        let limits = RecipeLimits {
            metric: self.metric,
            ..RecipeLimits::new(&with_pot, conditions.clone(), FilmKind::Hiding)
        };
        let forward = Forward::new(&with_pot, &limits)?;
        let (best, reaches) = additions.find(&forward, &found.target, task)?;
        found.reaches = reaches;
        let corrected = best.into_iter().take(self.count);
        found.corrections = corrected
            .map(|addition| correction(&forward, &found.target, &additions, addition, batch.grams))
            .collect();
        if found.corrections.is_empty() {
            return Err(MatchError::NoRecipe);
        }
        Ok(found)
    }

    fn check(&self, library: &PigmentLibrary, batch: &Batch) -> Result<(), MatchError> {
        if library.amounts == AmountKind::Absolute {
            return Err(MatchError::AbsoluteBatch);
        }
        if self.conditions.is_empty() {
            return Err(MatchError::NoLight);
        }

        let numbers = [
            ("the mass of a batch is above 0 g", Some(batch.grams), "try [grams=500]"),
            ("the least addition is above 0 g", self.least_grams, "try [least=0.1]"),
            ("the greatest addition is above 0 g", self.most_grams, "try [most=100]"),
            ("the tolerance is above 0", Some(self.tolerance), "try [tolerance=0.5]"),
        ];
        for (what, value, hint) in numbers {
            if let Some(value) = value.filter(|value| !(*value > 0.0 && *value < 1e9)) {
                return Err(MatchError::Number { what, value, hint });
            }
        }
        if !(1..MAX_PIGMENTS).contains(&self.at_most) {
            let what = "a correction adds 1 to 7 pigments";
            let hint = "try [at_most=3]";
            return Err(MatchError::Number { what, value: self.at_most as f64, hint });
        }
        if self.count == 0 {
            let what = "the number of corrections is 1 or more";
            let hint = "leave [count] out for 5 corrections";
            return Err(MatchError::Number { what, value: 0.0, hint });
        }
        let (least, most) = self.range(batch.grams);
        if least > most {
            let what = "the least addition exceeds the greatest";
            let hint = "lower [least]";
            return Err(MatchError::Number { what, value: least, hint });
        }
        Ok(())
    }

    /// Least grams of one pigment and most grams in all.
    fn range(&self, grams: f64) -> (f64, f64) {
        (self.least_grams.unwrap_or(grams / 1000.0), self.most_grams.unwrap_or(grams))
    }

    fn additions<'a>(
        &'a self,
        known: &PigmentLibrary,
        library: &'a PigmentLibrary,
        grams: f64,
    ) -> Result<Additions<'a>, MatchError> {
        let mut allowed = if self.only.is_empty() {
            known.ids().filter(|id| known[*id].identified).collect()
        } else {
            find_all(known, &self.only)?
        };
        let without = find_all(known, &self.without)?;
        let mut stock = vec![f64::INFINITY; known.pigments.len()];
        for (name, limit) in &self.stock {
            if !(*limit >= 0.0 && *limit < 1e9) {
                let what = "a stock is 0 g or more";
                let hint = "try [stock=\"Cobalt Blue=20\"]";
                return Err(MatchError::Number { what, value: *limit, hint });
            }
            stock[known.find(name)?.index()] = limit / grams;
        }
        let (least, most) = self.range(grams);
        let least = least / grams;
        let most = most / grams;
        allowed.retain(|id| !without.contains(id) && stock[id.index()] >= least);
        allowed.sort_unstable();
        allowed.dedup();
        if allowed.is_empty() {
            return Err(MatchError::NoPigments);
        }
        Ok(Additions {
            library,
            conditions: &self.conditions,
            allowed,
            at_most: self.at_most,
            stock,
            least,
            most,
            tolerance: self.tolerance,
        })
    }
}

/// The measured batch on the library's wavelengths.
fn on_grid(
    library: &PigmentLibrary,
    batch: &Batch,
) -> Result<Spectrum<Reflectance>, InterpolateError> {
    let method = Interpolation::best_for(batch.reflectance.grid());
    batch.reflectance.resampled(library.grid, method, Extrapolation::Hold)
}

/// The library with the paint in the pot as a further pigment, and the reflectance that the recipe
/// predicts of it.
fn library_with_pot(
    library: &PigmentLibrary,
    batch: &Batch,
) -> Result<(PigmentLibrary, Vec<f64>), MatchError> {
    let recipe = library.recipe(batch.made.iter().map(|(name, part)| (name, *part)))?;
    let curves = library.mix(&recipe)?;
    let measured = on_grid(library, batch)?;
    let scattering = curves.scattering.clone();
    let absorption = measured.values().iter().zip(&scattering).map(|(&reading, s)| {
        let internal = library.saunderson.internal_from_measured(reading).unwrap_or(0.0);
        s * absorption_over_scattering(internal.clamp(LEAST_INTERNAL, 1.0))
    });
    let pot = Pigment {
        name: "the batch".to_owned(),
        color_index: None,
        absorption: absorption.collect(),
        scattering,
        absorption_sd: Vec::new(),
        scattering_sd: Vec::new(),
        identified: true,
        guessed: false,
        measured_amounts: None,
        notes: Vec::new(),
    };
    let mut with_pot = library.clone();
    with_pot.pigments.push(pot);
    Ok((with_pot, curves.hiding(library.saunderson)))
}

fn differences(found: &[Lab], wanted: &[Lab]) -> Vec<f64> {
    wanted.iter().zip(found).map(|(w, f)| delta_e_ciede2000(*w, *f)).collect()
}

fn correction(
    forward: &Forward<'_>,
    target: &Target,
    additions: &Additions<'_>,
    addition: Addition,
    grams: f64,
) -> Correction {
    /// We count the whole stock as used if an amount differs from it by at most this fraction.
    const AT_LIMIT: f64 = 1e-6;
    let total = addition.total() * grams;
    let Addition { mut amounts, mixture } = addition;
    amounts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut scratch = Scratch::default();
    let reflectance = forward.reflectance(&mixture.pigments, &mixture.shares, 1.0, &mut scratch);
    let labs: Vec<Lab> = forward.weights.iter().map(|w| lab(w, &reflectance)).collect();
    Correction {
        out_of_stock: amounts
            .iter()
            .filter(|(pigment, amount)| {
                *amount >= additions.stock[pigment.index()] * (1.0 - AT_LIMIT)
            })
            .map(|(pigment, _)| *pigment)
            .collect(),
        additions: amounts.iter().map(|(pigment, amount)| (*pigment, amount * grams)).collect(),
        grams: total,
        delta_e: labs.iter().zip(&target.lab).map(|(f, w)| delta_e_ciede2000(*w, *f)).collect(),
        distance: mixture.distance,
        rms_percent: target.spectrum.as_ref().map(|wanted| wanted.rms_percent(&reflectance)),
        lab: labs,
        reflectance,
    }
}

/// We search the least addition for at most this many sets of pigments.
const MOST_SETS: usize = 400;
/// We try this many amounts between the least and the greatest, in equal ratios. We chose it by eye.
const AMOUNTS: usize = 24;
/// We halve the last ratio of amounts this often, down to about 0.1 % of the amount.
const HALVINGS: usize = 9;

/// Limits of an addition to a pot. We give amounts as fractions of the paint in the pot.
pub(super) struct Additions<'a> {
    /// The library, with the paint in the pot as its last pigment.
    pub(super) library: &'a PigmentLibrary,
    pub(super) conditions: &'a [ViewingCondition],
    /// Pigments that you may add.
    pub(super) allowed: Vec<PigmentId>,
    /// Most pigments to add, 1 to 7.
    pub(super) at_most: usize,
    /// Greatest amount of each pigment of the library, infinite without a limit.
    pub(super) stock: Vec<f64>,
    /// Least amount of one pigment that you can weigh, above 0.
    pub(super) least: f64,
    /// Greatest sum of all additions.
    pub(super) most: f64,
    /// Difference from the target that is near enough.
    pub(super) tolerance: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Addition {
    /// Pigments in rising order, each with its amount as a fraction of the paint in the pot.
    pub(super) amounts: Vec<(PigmentId, f64)>,
    /// The mixture of pot and addition.
    pub(super) mixture: Candidate,
}

impl Addition {
    pub(super) fn total(&self) -> f64 {
        self.amounts.iter().map(|(_, amount)| amount).sum()
    }
}

impl Additions<'_> {
    fn pot(&self) -> PigmentId {
        PigmentId(self.library.pigments.len() - 1)
    }

    /// Limits of mixtures of the pot with additions, `share` of which is the pot.
    fn limits(&self, share: Option<f64>) -> RecipeLimits {
        let usual = RecipeLimits::new(self.library, self.conditions.to_vec(), FilmKind::Hiding);
        let pot = self.pot();
        let mut allowed = self.allowed.clone();
        allowed.push(pot);
        // The share of an addition is largest if nothing else is added to the pot.
        let mut amounts: Vec<Option<[f64; 2]>> = self
            .stock
            .iter()
            .map(|stock| {
                let limit = match share {
                    Some(share) => stock * share,
                    None if stock.is_finite() => stock / (1.0 + stock),
                    None => 1.0,
                };
                Some([0.0, limit.min(1.0)])
            })
            .collect();
        amounts.push(None);
        RecipeLimits {
            allowed,
            required: vec![RequiredPigment { pigment: pot, share }],
            at_most: self.at_most + 1,
            least_share: 0.0,
            amounts,
            tolerance: self.tolerance,
            ..usual
        }
    }

    /// The additions of each set of pigments that come within the tolerance, the least first. If none does,
    /// you get those that come nearest, the nearest first.
    pub(super) fn find(
        &self,
        forward: &Forward<'_>,
        target: &Target,
        task: &Task,
    ) -> Result<(Vec<Addition>, bool), Cancelled> {
        let whole = self.limits(None);
        let found = search(forward, &whole, target, &task.steps(expected(&whole)));
        task.check()?;
        let mut sets: Vec<Candidate> = found.into_iter().filter(|c| c.pigments.len() > 1).collect();
        let near = sets.iter().filter(|set| set.distance <= self.tolerance).count();

        if near > 0 {
            sets[..near].sort_by(|a, b| {
                (1.0 - a.share(self.pot())).total_cmp(&(1.0 - b.share(self.pot())))
            });
        }
        sets.truncate(MOST_SETS);
        let mut additions: Vec<Addition> = sets
            .par_iter()
            .map_init(Scratch::default, |scratch, set| match task.is_cancelled() {
                true => None,
                false => self.of_set(forward, target, &set.pigments, scratch),
            })
            .flatten()
            .collect();
        task.check()?;

        let reaches = additions.iter().any(|addition| addition.mixture.distance <= self.tolerance);
        if reaches {
            additions.retain(|addition| addition.mixture.distance <= self.tolerance);
            additions.sort_by(|a, b| a.total().total_cmp(&b.total()));
        } else {
            additions.sort_by(|a, b| a.mixture.distance.total_cmp(&b.mixture.distance));
        }
        Ok((without_needless(additions, reaches), reaches))
    }

    /// The least addition of one set of pigments, the pot among them, or the nearest if none is near enough.
    fn of_set(
        &self,
        forward: &Forward<'_>,
        target: &Target,
        set: &[PigmentId],
        scratch: &mut Scratch,
    ) -> Option<Addition> {
        let mut at = |added: f64, near: Option<&Candidate>| {
            self.of_amount(forward, target, set, added, near, scratch)
        };
        let stock = set.iter().filter_map(|pigment| self.stock.get(pigment.index()));
        let most = self.most.min(stock.sum());
        if most < self.least {
            return None;
        }
        let ratio = (most / self.least).powf(1.0 / AMOUNTS as f64);
        let mut nearest: Option<(f64, Candidate)> = None;
        let mut before = None;
        for step in 0..=AMOUNTS {
            let added = self.least * (most / self.least).powf(step as f64 / AMOUNTS as f64);
            let known = nearest.as_ref().map(|(_, candidate)| candidate);
            let Some(found) = at(added, known) else { continue };
            if found.distance <= self.tolerance {
                let least = least_between(before, (added, found), self.tolerance, &mut at);
                return self.addition(least);
            }
            before = Some(added);
            if nearest.as_ref().is_none_or(|(_, known)| found.distance < known.distance) {
                nearest = Some((added, found));
            }
        }
        let (mut added, mut best) = nearest?;
        let mut step = ratio.sqrt();
        for _ in 0..HALVINGS {
            for tried in [added * step, added / step] {
                let tried = tried.clamp(self.least, most);
                if let Some(found) = at(tried, Some(&best))
                    && found.distance < best.distance
                {
                    (added, best) = (tried, found);
                }
            }
            if best.distance <= self.tolerance {
                break;
            }
            step = step.sqrt();
        }
        self.addition(best)
    }

    /// The mixture nearest to the target in which the sum of all additions is `added`. `None` if the stock
    /// does not suffice.
    fn of_amount(
        &self,
        forward: &Forward<'_>,
        target: &Target,
        set: &[PigmentId],
        added: f64,
        near: Option<&Candidate>,
        scratch: &mut Scratch,
    ) -> Option<Candidate> {
        let share = 1.0 / (1.0 + added);
        let limits = self.limits(Some(share));
        let others = (set.len() - 1) as f64;
        let start = Candidate {
            pigments: set.to_vec(),
            shares: set
                .iter()
                .map(|&pigment| {
                    let known =
                        near.map(|near| near.share(pigment) / (1.0 - near.share(self.pot())));
                    let part = known.unwrap_or(1.0 / others);
                    if pigment == self.pot() { share } else { part * (1.0 - share) }
                })
                .collect(),
            thickness: 1.0,
            distance: f64::INFINITY,
        };
        let start = within_limits(&limits, &start)?;
        descend(forward, &limits, target, &start, scratch)
    }

    /// The addition in a mixture. `None` if it has less of a pigment than you can weigh.
    fn addition(&self, mixture: Candidate) -> Option<Addition> {
        let pot = mixture.share(self.pot());
        let amounts: Vec<(PigmentId, f64)> = mixture
            .pigments
            .iter()
            .zip(&mixture.shares)
            .filter(|(pigment, _)| **pigment != self.pot())
            .map(|(&pigment, share)| (pigment, share / pot))
            .collect();
        // We search a smaller set without this pigment by itself.
        let is_whole = amounts.iter().all(|(_, amount)| *amount >= self.least * (1.0 - 1e-6));
        is_whole.then_some(Addition { amounts, mixture })
    }
}

/// The mixture with the least addition between `before`, which is too little, and `enough`.
fn least_between(
    before: Option<f64>,
    (mut enough, mut mixture): (f64, Candidate),
    tolerance: f64,
    at: &mut impl FnMut(f64, Option<&Candidate>) -> Option<Candidate>,
) -> Candidate {
    let Some(mut little) = before else { return mixture };
    for _ in 0..HALVINGS {
        let middle = (little * enough).sqrt();
        match at(middle, Some(&mixture)) {
            Some(found) if found.distance <= tolerance => (enough, mixture) = (middle, found),
            _ => little = middle,
        }
    }
    mixture
}

/// Drops additions that need further pigments and are hardly better than another one.
fn without_needless(additions: Vec<Addition>, reaches: bool) -> Vec<Addition> {
    /// You do not weigh a further pigment for a gain below this fraction. We chose it by eye.
    const LEAST_GAIN: f64 = 0.02;

    let needed = additions.iter().filter(|addition| {
        !additions.iter().any(|other| {
            other.amounts.len() < addition.amounts.len()
                && other
                    .amounts
                    .iter()
                    .all(|(pigment, _)| addition.amounts.iter().any(|(known, _)| known == pigment))
                && effort(reaches, other) <= effort(reaches, addition) * (1.0 + LEAST_GAIN)
        })
    });
    needed.cloned().collect()
}

fn effort(reaches: bool, addition: &Addition) -> f64 {
    if reaches { addition.total() } else { addition.mixture.distance }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::Viewing;

    #[test]
    fn a_cancelled_task_ends_a_correction() {
        let oils = PigmentLibrary::van_gogh_oils();
        let [standard, painted] = [12.0, 9.0].map(|blue: f64| {
            let parts = [("Zinc White", 100.0), ("Cobalt Blue", blue)];
            oils.color(parts, &Viewing::default()).unwrap().reflectance
        });
        let target = ColorTarget::measured("standard", standard);
        let made = vec![("Zinc White".to_owned(), 100.0), ("Cobalt Blue".to_owned(), 12.0)];
        let batch = Batch { made, grams: 500.0, reflectance: painted };
        let request = CorrectRequest { at_most: 1, ..CorrectRequest::default() };
        let task = Task::default();
        let found = request.run(&oils, &target, &batch, &task).unwrap();
        assert!(found.reaches && task.progress().done > 1, "{:?}", task.progress());
        task.cancel();
        let ended = request.run(&oils, &target, &batch, &task);
        assert_eq!(ended, Err(MatchError::Cancelled(Cancelled)));
    }
}
