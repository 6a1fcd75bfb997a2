//! Plans of swatches: which mixtures you prepare, so that a fit identifies K and S of every pigment.
//!
//! A design is a list of indices into one pool of recipes, [`candidates`]. You need no knowledge of the
//! paint for the [`usual`] design. We choose the [`optimal`] one for its [`Information`], which we estimate
//! from a library of similar paint (D-optimality: Fedorov 1972, Theory of Optimal Experiments). You give
//! [`plan`] the pigments, and it gives you recipes with grams and an empty measurement file.

mod paints;
mod exchange;
mod request;
mod loss;

use documents::Task;
use pigment::remark::Remark;
use pigment::{PigmentId, PigmentLibrary, Recipe};
use serde_json::{Map, Value, json};

use crate::fit::{ExpectedNoise, unidentified};

pub use exchange::{Information, RelativeDeviation, candidates, optimal, usual, usual_count};
pub use loss::PlanLoss;
pub use paints::{MeasurementForm, PaintSet, PlanError, Purpose, SwatchRecipe};
pub use request::{PlanRequest, SwatchCount};

/// We expect this error of an instrument, as a standard deviation of reflectance.
const INSTRUMENT_ERROR: f64 = 0.002;
/// We expect this error of weighing, mixing and film if a prior has no evidence (chosen by eye).
const MIXING_ERROR: f64 = 0.01;
/// We expect at least this error of weighing, mixing and film, because some priors reproduce their samples
/// almost exactly (chosen by eye).
const LEAST_MIXING_ERROR: f64 = 1e-4;

/// One swatch of a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedSwatch {
    /// Name of the sample, its number first: `07 Cobalt Blue tint 1:4`.
    pub name: String,
    /// Paints in whole parts, and the reason for the swatch.
    pub recipe: SwatchRecipe,
    /// Paints with their masses in grams.
    pub grams: Recipe,
}

/// Predictions of a prior library about a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Forecast {
    /// D-efficiency of the usual design with equally many swatches, relative to the plan, 0 to 1.
    pub usual_efficiency: f64,
    /// Predicted relative standard deviations of K and S, by paint.
    pub deviations: Vec<RelativeDeviation>,
    /// Relative standard deviations for the usual design, by paint.
    pub usual_deviations: Vec<RelativeDeviation>,
    /// Expected noise for which the deviations are predicted.
    pub noise: ExpectedNoise,
}

/// Swatches that you prepare, so that a fit identifies every pigment.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Paints of the plan.
    pub paints: PaintSet,
    /// Swatches in the order in which they are prepared.
    pub swatches: Vec<PlannedSwatch>,
    /// Predictions of the prior library, or `None` without one.
    pub forecast: Option<Forecast>,
    /// Loss against the default plan, or `None` if this plan has at least as many swatches.
    pub loss: Option<PlanLoss>,
    /// Warnings about the prior library, and the loss in words.
    pub remarks: Vec<Remark>,
}

/// Plans the swatches to prepare for `pigments` and a `white`, so that a fit identifies K and S of every
/// pigment.
///
/// ```
/// use calibrate::plan::{MeasurementForm, PlanRequest};
/// use documents::Task;
///
/// let request = PlanRequest::default();
/// let plan = calibrate::plan(&["Cobalt Blue"], "Titanium White", &request, &Task::default())?;
/// assert_eq!(plan.swatches[0].name, "01 Titanium White masstone");
/// let csv = plan.form(&MeasurementForm::default());
/// assert!(csv.starts_with(b"sample,film,backing,replicate,Titanium White,Cobalt Blue,400"));
/// # Ok::<(), calibrate::plan::PlanError>(())
/// ```
///
/// Many swatches of many paints take minutes. You can end the plan before with `task`.
///
/// # Errors
/// [`PlanError`] for impossible names, masses, noise or numbers of swatches, or if `task` was cancelled.
pub fn plan<N: AsRef<str>>(
    pigments: &[N],
    white: &str,
    options: &PlanRequest,
    task: &Task,
) -> Result<Plan, PlanError> {
    if let Some(noise) = options.noise.filter(|noise| !noise.is_possible()) {
        return Err(PlanError::Noise { constant: noise.constant, even: noise.even });
    }
    let paints = paint_set(pigments, white, options)?;
    let weighing = Weighing::new(options.grams, options.balance)?;
    let pool = candidates(&paints, weighing.least_share());
    let full = usual_count(&paints, &pool);
    let count = options.count(&paints, full)?;
    let mut design = usual(&paints, &pool, count)?;
    let mut full = if count < full { Some(usual(&paints, &pool, full)?) } else { None };
    let mut forecast = None;
    let mut full_deviations = None;
    let mut remarks = Vec::new();
    if let Some(prior) = &options.prior {
        let ids =
            paints.names.iter().map(|name| prior.find(name)).collect::<Result<Vec<_>, _>>()?;
        remarks = reservations(prior, &ids);
        let noise = expected_noise(prior, options.noise);
        let information = Information::new(prior, &ids, &pool, noise);
        // The first swatch of the usual design is the white alone, which every plan must contain.
        let best = optimal(&information, &design, 1, task)?;
        forecast = Some(Forecast {
            usual_efficiency: information.efficiency(&design, &best),
            deviations: information.deviations(&best),
            usual_deviations: information.deviations(&design),
            noise,
        });
        if let Some(full) = &mut full {
            *full = optimal(&information, full, 1, task)?;
            full_deviations = Some(information.deviations(full));
        }
        design = best;
    }
    let recipes: Vec<SwatchRecipe> = design.iter().map(|&index| pool[index].clone()).collect();
    check_identified(&paints, &recipes)?;
    let loss = full.map(|full| PlanLoss::of(&paints, &recipes, full.iter().map(|&i| &pool[i])));
    let loss = loss.map(|loss| PlanLoss { full_deviations, ..loss });
    if let Some(loss) = &loss {
        let deviations = forecast.as_ref().map(|forecast| forecast.deviations.as_slice());
        remarks.push(Remark::warning(loss.text(&paints, deviations)));
    }
    let width = recipes.len().to_string().len().max(2);
    let swatches = recipes
        .into_iter()
        .enumerate()
        .map(|(index, recipe): (usize, SwatchRecipe)| PlannedSwatch {
            name: format!("{:0width$} {}", index + 1, recipe.name(&paints)),
            grams: weighing.grams(&recipe),
            recipe,
        })
        .collect();
    Ok(Plan { paints, swatches, forecast, loss, remarks })
}

impl PlanRequest {
    /// Plans as [`plan`] does.
    ///
    /// # Errors
    /// [`PlanError`] as for [`plan`].
    pub fn run<N: AsRef<str>>(
        &self,
        pigments: &[N],
        white: &str,
        task: &Task,
    ) -> Result<Plan, PlanError> {
        plan(pigments, white, self, task)
    }

    /// Number of swatches, where the default plan has `full`.
    fn count(&self, paints: &PaintSet, full: usize) -> Result<usize, PlanError> {
        let least = paints.unknowns();
        let Some(minutes) = self.minutes else {
            return Ok(match self.swatches {
                None => full,
                Some(SwatchCount::Number(count)) => count,
                Some(SwatchCount::Fewest) => least,
            });
        };
        if self.swatches.is_some() {
            return Err(PlanError::CountAndTime);
        }
        let each = self.minutes_each;
        positive("the time for a swatch", each, "try [minutes_each=10]")?;
        positive("the time for all swatches", minutes, "try [minutes=240]")?;
        // Rounding must not cost a swatch.
        let fitting = (minutes / each * (1.0 + 1e-12)).floor();
        if fitting < least as f64 {
            return Err(PlanError::Time { least, needed: least as f64 * each, each, minutes });
        }
        Ok((fitting as usize).min(full))
    }
}

fn positive(what: &'static str, value: f64, example: &'static str) -> Result<(), PlanError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(PlanError::NotPositive { what, example, value })
}

impl Plan {
    /// Mass of each paint that all swatches need together, in grams, in the order of the paints' names.
    #[must_use]
    pub fn totals_g(&self) -> Vec<f64> {
        let mut totals = vec![0.0; self.paints.names.len()];
        let parts = self.swatches.iter().flat_map(|swatch| &swatch.grams);
        parts.for_each(|(paint, grams)| totals[paint.index()] += grams);
        totals
    }

    /// Empty measurement file (CSV) for you to fill in: bare cards and every swatch over a white and a
    /// black card, with the amounts in grams.
    #[must_use]
    pub fn form(&self, form: &MeasurementForm) -> Vec<u8> {
        let swatches = self.swatches.iter().map(|swatch| (swatch.name.as_str(), &swatch.grams));
        form.csv(&self.paints, swatches)
    }

    /// The recipes of the readings of [`Self::form`] (CSV), for an instrument that writes files. You give
    /// each reading the name in the column `reading`, and pass this file to
    /// [`Readings::with_recipes`](crate::Readings::with_recipes).
    ///
    /// ```
    /// use calibrate::plan::{MeasurementForm, PlanRequest};
    ///
    /// let plan = calibrate::plan(&["Viridian"], "White", &PlanRequest::default(), &documents::Task::default())?;
    /// let recipes = String::from_utf8_lossy(&plan.recipes(&MeasurementForm::default())).into_owned();
    /// let mut rows = recipes.lines();
    /// assert_eq!(rows.next(), Some("sample,film,backing,reading,White,Viridian"));
    /// assert_eq!(rows.nth(4), Some("01 White masstone,paint,white,01 white 1,10,"));
    /// # Ok::<(), calibrate::plan::PlanError>(())
    /// ```
    #[must_use]
    pub fn recipes(&self, form: &MeasurementForm) -> Vec<u8> {
        let swatches = self.swatches.iter().map(|swatch| (swatch.name.as_str(), &swatch.grams));
        form.recipes(&self.paints, swatches)
    }
}

/// The paints, by their full names where a prior library knows them.
fn paint_set<N: AsRef<str>>(
    pigments: &[N],
    white: &str,
    options: &PlanRequest,
) -> Result<PaintSet, PlanError> {
    let full = |name: &str| -> Result<String, PlanError> {
        Ok(match &options.prior {
            Some(prior) => prior[prior.find(name)?].name.clone(),
            None => name.trim().to_owned(),
        })
    };
    let colors: Result<Vec<String>, PlanError> =
        pigments.iter().map(|p| full(p.as_ref())).collect();
    let colors = colors?;
    let black = options.black.as_deref().map(full).transpose()?;
    PaintSet::new(&colors, &full(white)?, black.as_deref())
}

fn reservations(prior: &PigmentLibrary, ids: &[PigmentId]) -> Vec<Remark> {
    let unknown = ids.iter().filter(|id| !prior[**id].identified);
    unknown.map(|id: &PigmentId| {
        Remark::warning(format!(
            "{}: the prior does not know its scattering, so that its swatches are chosen by a guess",
            prior[*id].name
        ))
    }).collect()
}

/// The noise that you expect, else the noise that the evidence of `prior` suggests.
fn expected_noise(prior: &PigmentLibrary, noise: Option<ExpectedNoise>) -> ExpectedNoise {
    let left = prior.evidence.as_ref();
    let left = left.map_or(MIXING_ERROR, |evidence| evidence.rms.max(LEAST_MIXING_ERROR));
    noise.unwrap_or(ExpectedNoise { constant: INSTRUMENT_ERROR, even: left })
}

/// Refuses a plan if a fit would not identify every pigment.
fn check_identified(paints: &PaintSet, recipes: &[SwatchRecipe]) -> Result<(), PlanError> {
    let shares = recipes.iter().map(|recipe| {
        let shares = recipe.shares();
        paints.ids().map(|paint| shares.parts_of(paint)).collect()
    });
    let shares: Vec<Vec<f64>> = shares.collect();
    let unknown = unidentified(shares.iter().map(Vec::as_slice), PaintSet::WHITE);
    if unknown.is_empty() {
        return Ok(());
    }
    let names = unknown.iter().map(|u| paints.name(u.pigment).to_owned());
    Err(PlanError::Unidentified(names.collect()))
}

/// Mass of a swatch, and the balance with which you weigh it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weighing {
    grams: f64,
    /// Step of the balance in grams.
    resolution: f64,
}

/// A part has at least this many balance steps. Half a step is then 1 % of it.
const STEPS: f64 = 50.0;
/// Every plan needs a tint this weak: 1 part in 5.
const NEEDED_SHARE: f64 = 0.2;

impl Weighing {
    /// Swatches of `grams` on a balance that shows steps of `resolution` grams.
    ///
    /// # Errors
    /// [`PlanError::Grams`] if 1 part in 5 cannot be weighed to 1 %, [`PlanError::NotPositive`] unless
    /// both are above 0.
    pub fn new(grams: f64, resolution: f64) -> Result<Self, PlanError> {
        let example = "give grams, such as [grams=10] [balance=0.01]";
        positive("grams a swatch", grams, example)?;
        positive("the step of the balance", resolution, example)?;
        let needed = STEPS * resolution / NEEDED_SHARE;
        if grams < needed * (1.0 - 1e-9) {
            return Err(PlanError::Grams { needed, resolution, grams });
        }
        Ok(Self { grams, resolution })
    }

    /// Smallest share that you can weigh to 1 %: fifty steps of the balance.
    #[must_use]
    pub fn least_share(&self) -> f64 {
        STEPS * self.resolution / self.grams
    }

    /// Paints of `recipe` with the masses in grams that you weigh, rounded to the balance's step.
    #[must_use]
    pub fn grams(&self, recipe: &SwatchRecipe) -> Recipe {
        // Dividing by the number of steps in a gram gives the nearest decimal.
        let per_gram = (1.0 / self.resolution).round();
        let exact = (per_gram * self.resolution - 1.0).abs() < 1e-9;
        let shares = recipe.shares();
        let grams = shares.iter().map(|&(paint, share)| {
            let steps = (share * self.grams / self.resolution).round();
            (paint, if exact { steps / per_gram } else { steps * self.resolution })
        });
        grams.collect()
    }
}

impl Plan {
    /// The plan as JSON: `swatches` (sample, purpose, parts, grams, why), `totals_g` by paint, the
    /// `unknowns` of a wavelength, `identified`, the forecast of the `prior` library (null without one), and
    /// the `loss` against the default plan (null if there is none).
    #[must_use]
    pub fn to_json(&self) -> Value {
        let swatches: Vec<Value> = self.swatches.iter().map(|s| self.swatch_json(s)).collect();
        let totals = self.paints.ids().zip(self.totals_g());
        let totals = totals.map(|(paint, total)| (self.name(paint), json!(rounded(total))));
        json!({
            "swatches": swatches,
            "totals_g": totals.collect::<Map<String, Value>>(),
            "unknowns": self.paints.unknowns(),
            "identified": true,
            "prior": self.forecast.as_ref().map(|forecast| self.forecast_json(forecast)),
            "loss": self.loss.as_ref().map(|loss| self.loss_json(loss)),
        })
    }

    fn name(&self, paint: PigmentId) -> String {
        self.paints.name(paint).to_owned()
    }

    fn swatch_json(&self, swatch: &PlannedSwatch) -> Value {
        let parts = swatch.recipe.parts.iter();
        let parts = parts.map(|&(paint, parts)| (self.name(paint), json!(parts)));
        let grams = swatch.grams.iter();
        let grams = grams.map(|&(paint, grams)| (self.name(paint), json!(grams)));
        json!({
            "sample": swatch.name,
            "purpose": swatch.recipe.purpose.word(),
            "parts": parts.collect::<Map<String, Value>>(),
            "grams": grams.collect::<Map<String, Value>>(),
            "why": swatch.recipe.purpose.why(),
        })
    }

    fn forecast_json(&self, forecast: &Forecast) -> Value {
        json!({
            "usual_efficiency": forecast.usual_efficiency,
            "noise": {"constant": forecast.noise.constant, "even": forecast.noise.even},
            "relative_deviations": self.deviations_json(&forecast.deviations),
            "usual_relative_deviations": self.deviations_json(&forecast.usual_deviations),
        })
    }

    fn loss_json(&self, loss: &PlanLoss) -> Value {
        let left_out = loss.left_out.iter();
        let left_out = left_out.map(|(purpose, count)| (purpose.word().to_owned(), json!(count)));
        json!({
            "full_swatches": loss.full,
            "spare_swatches": loss.spare,
            "left_out": left_out.collect::<Map<String, Value>>(),
            "full_relative_deviations":
                loss.full_deviations.as_ref().map(|deviations| self.deviations_json(deviations)),
        })
    }

    /// Deviations of K and S by paint.
    fn deviations_json(&self, deviations: &[RelativeDeviation]) -> Map<String, Value> {
        let pairs = self.paints.ids().zip(deviations).map(|(paint, deviation)| {
            let pair = json!({
                "absorption": deviation.absorption,
                "scattering": deviation.scattering,
            });
            (self.name(paint), pair)
        });
        pairs.collect()
    }
}

/// Removes the floating-point error of a sum of balance steps.
fn rounded(total: f64) -> f64 {
    (1e6 * total).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::paints::Purpose;
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
