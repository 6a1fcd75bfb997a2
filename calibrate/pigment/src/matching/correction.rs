//! Correcting a batch of paint: you learn what to add to the pot, so that its measured colour becomes the
//! target.
//!
//! A recipe predicts the K and S of the pot, but nobody weighs exactly what the recipe says, and paints differ
//! from the paints of the library. From the readings of the pot we estimate the most probable weights, K and S, and
//! predict what additions of these paints do. We scale K of the estimated pot at each wavelength, so that its
//! predicted colour is the measured one before you add anything (after Allen 1974, correction by the batch's own
//! reflectance).
//!
//! The search returns the smallest addition that brings the colour near enough to the target, with the error to
//! expect.

use documents::Task;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use spectra::color::{Lab, delta_e_ciede2000};
use spectra::optics::absorption_over_scattering;
use spectra::{Extrapolation, InterpolateError, Interpolation, Reflectance, Spectrum};

use super::additions::{Addition, Additions};
use super::forward::{Forward, Scratch};
use super::limits::{FilmKind, MatchError, RecipeLimits};
use super::pot::{LEAST_INTERNAL, PaintErrors, Pot, PotEstimate, PotReading};
use super::recipe_search::spectrum_of;
use super::request::find_all;
use super::target::{ColorTarget, Metric, Target, TargetColor, ViewingCondition};
use crate::evaluate::{Remark, check_visible_band, lab};
use crate::least_squares::MAX_PIGMENTS;
use crate::library::{AmountKind, Pigment, PigmentLibrary};
use crate::recipe::{PigmentId, Recipe};

/// Default difference from the target that is near enough, in CIEDE2000, or in percent of reflectance for a
/// match by spectrum. It is about the smallest difference that you see side by side.
pub const USUAL_CORRECTION: f64 = 0.5;
/// Default relative standard deviation of what was weighed into a pot. We chose it by eye.
const USUAL_WEIGHING: f64 = 0.1;
/// Greatest strength of a paint relative to the library.
const GREATEST_STRENGTH: f64 = 100.0;

/// A pot of paint that you mixed and measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Batch {
    /// Names of the pigments that you mixed at first, with their parts in any unit.
    pub made: Vec<(String, f64)>,
    /// Mass of the paint in the pot in grams, above 0, with all that was added.
    pub grams: f64,
    /// Measured reflectance of a film of this paint that hides.
    pub reflectance: Spectrum<Reflectance>,
    /// Earlier readings of the pot, the first at first. Empty if you correct it for the first time.
    pub rounds: Vec<BatchRound>,
}

/// An earlier reading of a pot, and what was added after it.
#[derive(Debug, Clone, PartialEq)]
pub struct BatchRound {
    /// Measured reflectance before the addition.
    pub reflectance: Spectrum<Reflectance>,
    /// Names of the pigments that you added, with their grams.
    pub added: Vec<(String, f64)>,
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
    /// Relative standard deviation of what was weighed into the pot. Additions count as weighed exactly
    pub weighing: f64,
    /// Strength of a paint of this batch relative to the library, such as 0.9 (may be repeated)
    pub strength: Vec<(String, f64)>,
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
            weighing: USUAL_WEIGHING,
            strength: Vec::new(),
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
    /// Error to expect in the unit of `distance`: its root mean square over the weights, K and S that the readings
    /// and the standard deviations of the library leave open.
    pub expected: f64,
    /// Root mean square of the differences of reflectance from a measured target, in percent.
    pub rms_percent: Option<f64>,
    /// Colour of the corrected paint under each light.
    pub lab: Vec<Lab>,
    /// Measured reflectance of the corrected paint on the library's grid.
    pub reflectance: Vec<f64>,
    /// Pigments of which you add the whole stock.
    pub out_of_stock: Vec<PigmentId>,
}

/// A paint of a pot, as the readings tell it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PotPaint {
    /// Its index in the library.
    pub pigment: PigmentId,
    /// Grams that should be in the pot by its recipe and the additions.
    pub made: f64,
    /// Grams that probably are in it.
    pub grams: f64,
    /// Probable strength of the paint relative to the library.
    pub strength: f64,
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
    /// Content of the pot by its readings.
    pub pot: Vec<PotPaint>,
    /// Whether the batch is within the tolerance, so that you need not correct it.
    pub is_near: bool,
    /// Whether the corrections bring the batch within the tolerance, as they are predicted.
    pub reaches: bool,
    /// Corrections with an error to expect within the tolerance, or within a tenth of the least error that we found,
    /// the least addition first. Empty if you need not correct the batch, or if no addition is likely to help.
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
    ///     rounds: Vec::new(),
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
        let (paints, strengths) = self.paints(library)?;
        let library = &paints;
        let errors: Vec<PaintErrors> = (library.ids().zip(&strengths))
            .map(|(pigment, strength)| PaintErrors::of(library, pigment, strength.is_some()))
            .collect();
        let measured = on_grid(library, &batch.reflectance)?;
        let pot = self.pot(library, batch, &measured, &errors)?;
        let made = pot.stated_grams();
        let parts: Vec<_> = pot.pigments.iter().copied().zip(made.iter().copied()).collect();
        let predicted = library.mix(&parts)?.hiding(library.saunderson);
        let estimate = pot.estimate();
        let with_pot = library_with_pot(library, &estimate, &measured);
        let paints = parts.iter().zip(estimate.grams.iter().zip(&estimate.strengths));
        let paints = paints.map(|(&(pigment, made), (&grams, strength))| PotPaint {
            pigment,
            made,
            grams,
            strength: strength * strengths[pigment.index()].unwrap_or(1.0),
        });
        let conditions = &self.conditions;
        let spectrum = spectrum_of(target, library.grid, (self.metric, conditions), &mut remarks)?;
        let target = Target { spectrum, ..target.under(conditions)? };
        let batch_lab = Target::from_reflectance("batch", &batch.reflectance, conditions)?.lab;
        let weights: Vec<_> = conditions
            .iter()
            .map(|condition| condition.viewing.weights(library.grid))
            .collect::<Result<_, _>>()?;
        let recipe: Vec<Lab> = weights.iter().map(|weights| lab(weights, &predicted)).collect();
        let batch_delta_e = differences(&batch_lab, &target.lab);
        let total: f64 = conditions.iter().map(|condition| condition.weight).sum();
        let squares = batch_delta_e.iter().zip(conditions).map(|(d, c)| d * d * c.weight / total);
        let batch_rms_percent =
            target.spectrum.as_ref().map(|spectrum| spectrum.rms_percent(&measured));
        let by_spectrum = self.metric.spectrum_weights().and(batch_rms_percent);
        let off = by_spectrum.unwrap_or_else(|| squares.sum::<f64>().sqrt());
        let is_near = off <= self.tolerance;
        let mut found = Corrections {
            recipe_delta_e: differences(&batch_lab, &recipe),
            target,
            batch: batch_lab,
            batch_delta_e,
            batch_rms_percent,
            pot: paints.collect(),
            is_near,
            reaches: is_near,
            corrections: Vec::new(),
            remarks,
        };
        if is_near {
            return Ok(found);
        }
        let additions = self.additions((library, &errors), (&with_pot, &estimate), batch.grams)?;
        let limits = RecipeLimits {
            metric: self.metric,
            ..RecipeLimits::new(&with_pot, conditions.clone(), FilmKind::Hiding)
        };
        let forward = Forward::new(&with_pot, &limits)?;
        let best = additions.find(&forward, &found.target, off, task)?;
        found.reaches = best.iter().any(|addition| addition.mixture.distance <= self.tolerance);
        let corrected = best.into_iter().take(self.count);
        found.corrections = corrected
            .map(|addition| correction(&forward, &found.target, &additions, addition, batch.grams))
            .collect();
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
            ("the deviation of weighing is above 0", Some(self.weighing), "try [weighing=0.1]"),
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

    /// The library with the paints of the strengths that are stated, and these by pigment.
    fn paints(
        &self,
        library: &PigmentLibrary,
    ) -> Result<(PigmentLibrary, Vec<Option<f64>>), MatchError> {
        let mut paints = library.clone();
        let mut strengths = vec![None; library.pigments.len()];
        for (name, strength) in &self.strength {
            if !(*strength > 0.0 && *strength <= GREATEST_STRENGTH) {
                let what = "a strength is above 0 and up to 100";
                let hint = "try [strength=\"Cobalt Blue=0.9\"]";
                return Err(MatchError::Number { what, value: *strength, hint });
            }
            let id = library.find(name)?;
            strengths[id.index()] = Some(*strength);
            let known = &library[id];
            let [absorption, scattering, absorption_sd, scattering_sd] =
                [&known.absorption, &known.scattering, &known.absorption_sd, &known.scattering_sd]
                    .map(|curve| curve.iter().map(|value| strength * value).collect());
            paints[id] =
                Pigment { absorption, scattering, absorption_sd, scattering_sd, ..known.clone() };
        }
        Ok((paints, strengths))
    }

    /// The pot with all its readings. `measured` is the last one.
    fn pot<'a>(
        &self,
        library: &'a PigmentLibrary,
        batch: &Batch,
        measured: &[f64],
        errors: &[PaintErrors],
    ) -> Result<Pot<'a>, MatchError> {
        let made = library.recipe(batch.made.iter().map(|(name, part)| (name, *part)))?;
        let parts = library.parts(&made)?;
        let added = batch.rounds.iter().map(|round| &round.added);
        let rounds = added.map(|parts| library.recipe(parts.iter().map(|(n, part)| (n, *part))));
        let rounds: Vec<Recipe> = rounds.collect::<Result<_, _>>()?;
        // Nothing need have been added between two readings.
        for round in rounds.iter().filter(|round| !round.is_empty()) {
            library.parts(round)?;
        }
        let mut pigments: Vec<PigmentId> = parts.iter().map(|(pigment, _)| *pigment).collect();
        for pigment in rounds.iter().flat_map(Recipe::pigments) {
            if !pigments.contains(&pigment) {
                pigments.push(pigment);
            }
        }
        let grams = batch.grams - rounds.iter().map(Recipe::total).sum::<f64>();
        if grams <= 0.0 {
            let what = "a pot holds more than what was added to it";
            let hint = "state all that is in the pot: [grams=500]";
            return Err(MatchError::Number { what, value: batch.grams, hint });
        }
        let mut added = vec![0.0; pigments.len()];
        let mut readings = Vec::new();
        for (round, more) in batch.rounds.iter().zip(&rounds) {
            let reflectance = on_grid(library, &round.reflectance)?;
            readings.push(PotReading { reflectance, added: added.clone() });
            for (sum, pigment) in added.iter_mut().zip(&pigments) {
                *sum += more.parts_of(*pigment);
            }
        }
        readings.push(PotReading { reflectance: measured.to_vec(), added });
        let made: Vec<f64> = (pigments.iter())
            .map(|pigment| grams * made.parts_of(*pigment) / made.total())
            .collect();
        let errors = pigments.iter().map(|pigment| errors[pigment.index()].clone()).collect();
        Ok(Pot { library, pigments, made, grams, weighing: self.weighing, errors, readings })
    }

    fn additions<'a>(
        &'a self,
        (known, errors): (&PigmentLibrary, &'a [PaintErrors]),
        (library, estimate): (&'a PigmentLibrary, &'a PotEstimate),
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
            estimate,
            errors,
            allowed,
            at_most: self.at_most,
            stock,
            least,
            most,
            tolerance: self.tolerance,
        })
    }
}

/// A reading on the library's wavelengths.
fn on_grid(
    library: &PigmentLibrary,
    reflectance: &Spectrum<Reflectance>,
) -> Result<Vec<f64>, InterpolateError> {
    let method = Interpolation::best_for(reflectance.grid());
    let found = reflectance.resampled(library.grid, method, Extrapolation::Hold)?;
    Ok(found.values().to_vec())
}

/// The library with the paints of the pot as they probably are, and the pot itself as a further pigment.
fn library_with_pot(
    library: &PigmentLibrary,
    estimate: &PotEstimate,
    measured: &[f64],
) -> PigmentLibrary {
    let absorption = measured.iter().zip(&estimate.scattering).map(|(&reading, s)| {
        let internal = library.saunderson.internal_from_measured(reading).unwrap_or(0.0);
        s * absorption_over_scattering(internal.clamp(LEAST_INTERNAL, 1.0))
    });
    let pot = Pigment {
        name: "the batch".to_owned(),
        color_index: None,
        absorption: absorption.collect(),
        scattering: estimate.scattering.clone(),
        absorption_sd: Vec::new(),
        scattering_sd: Vec::new(),
        identified: true,
        guessed: false,
        measured_amounts: None,
        notes: Vec::new(),
    };
    let mut with_pot = library.clone();
    for (pigment, [absorption, scattering]) in estimate.pigments.iter().zip(&estimate.paints) {
        with_pot[*pigment].absorption.clone_from(absorption);
        with_pot[*pigment].scattering.clone_from(scattering);
    }
    with_pot.pigments.push(pot);
    with_pot
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
    let Addition { mut amounts, mixture, expected } = addition;
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
        expected,
        rms_percent: target.spectrum.as_ref().map(|wanted| wanted.rms_percent(&reflectance)),
        lab: labs,
        reflectance,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::Viewing;
    use documents::Cancelled;

    #[test]
    fn a_cancelled_task_ends_a_correction() {
        let oils = PigmentLibrary::van_gogh_oils();
        let [standard, painted] = [12.0, 9.0].map(|blue: f64| {
            let parts = [("Zinc White", 100.0), ("Cobalt Blue", blue)];
            oils.color(parts, &Viewing::default()).unwrap().reflectance
        });
        let target = ColorTarget::measured("standard", standard);
        let made = vec![("Zinc White".to_owned(), 100.0), ("Cobalt Blue".to_owned(), 12.0)];
        let batch = Batch { made, grams: 500.0, reflectance: painted, rounds: Vec::new() };
        let request = CorrectRequest { at_most: 1, ..CorrectRequest::default() };
        let task = Task::default();
        let found = request.run(&oils, &target, &batch, &task).unwrap();
        assert!(found.reaches && task.progress().done > 1, "{:?}", task.progress());
        task.cancel();
        let ended = request.run(&oils, &target, &batch, &task);
        assert_eq!(ended, Err(MatchError::Cancelled(Cancelled)));
    }
}
