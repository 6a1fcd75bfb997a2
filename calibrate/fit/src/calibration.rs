//! From swatches to a pigment library with the evidence of its fit. Use this if you have a [`SwatchSet`],
//! and [`crate::fit()`] if you have readings.

use documents::{Task, hint::Explain};
use spectra::optics::Surface;

use crate::fit::{
    Condition, FitError, FitSettings, Method, Problem, Refined, RefinedState, Refinement,
    Unidentified, Unknown, condition, fit_qp, fit_refined, fit_weighted, linear_deviations,
    unidentified,
};
use crate::measurement::MeasurementError;
use crate::observation::{Observation, observations};
use crate::report;
use crate::report::Scores;
use crate::swatch::SwatchSet;
use pigment::digits::rounded;
use pigment::evaluate::Viewing;
use pigment::library::{AmountKind, Evidence, Pigment, PigmentLibrary};
use pigment::{Curves, PigmentId, Recipe};

/// A fitted library, with intermediate results of the fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// Fitted library. Title, licence, source and inputs are empty.
    pub library: PigmentLibrary,
    /// Swatches as the fit used them, in order of the file. Empty for absolute amounts.
    pub observations: Vec<Observation>,
    /// Rank and condition of the equations, or `None` for absolute amounts.
    pub condition: Option<Condition>,
    /// Estimates of noise and smoothness. You may reuse them in a leave-one-out fit.
    pub state: Option<RefinedState>,
    /// Fraction (0 to 1) of what we know of each fitted pigment's S that comes from the data. The rest comes
    /// from the prior on S. Empty for methods without a prior, and for absolute amounts.
    pub scattering_known: Vec<(PigmentId, f64)>,
}

/// Fits K and S of every pigment of `set`, with S relative to the S of `reference`.
///
/// The evidence states colour errors in CIEDE2000 under `viewing`. We compare the colour of each swatch's
/// K/S in a film that hides with the colour of the fitted mixture. If the data do not identify a pigment,
/// we use its samples neither for the fit nor for its errors. If you have only a masstone of this pigment,
/// it gets its K/S with an S assumed from the lightness of the masstone, and a mark that it is not
/// identified. Without a masstone we leave it out.
///
/// # Errors
/// [`CalibrationError`] if readings cannot be used, the fit fails or `task` was cancelled.
pub fn calibrate(
    set: &SwatchSet,
    reference: PigmentId,
    surface: Surface,
    settings: &FitSettings,
    viewing: &Viewing,
    task: &Task,
) -> Result<Calibration, CalibrationError> {
    let observations = observations(set, surface, settings.below_surface)?;
    let unknown = unidentified(observations.iter().map(|o| o.shares.as_slice()), reference);
    let (solvable, identified) = without(&observations, &unknown);
    let reference_among =
        identified.iter().position(|&p| p == reference).ok_or(FitError::Reference)?;
    let problem = Problem::new(set.grid, surface, &solvable, PigmentId(reference_among))?;
    let how = Refinement::whole(settings.smoothness);
    let solution = solve(&problem, settings.method, how, task)?;
    let condition = condition(&problem, &solution.curves);

    let white = PigmentId(reference_among);
    let known = solution.scattering_known.iter().enumerate();
    let scattering_known: Vec<(PigmentId, f64)> = known
        .filter(|(place, _)| PigmentId(*place) != white)
        .map(|(place, share)| (identified[place], *share))
        .collect();
    let mut pigments: Vec<(PigmentId, Pigment)> = identified
        .iter()
        .enumerate()
        .map(|(place, &id)| (id, solution.pigment(place, &set.pigments[id.index()])))
        .collect();
    for lone in unknown.iter().filter(|u| u.unknown == Unknown::Scattering) {
        pigments.push((lone.pigment, masstone(set, &observations, lone)));
    }
    pigments.sort_by_key(|(id, _)| *id);
    let mut library = PigmentLibrary {
        title: String::new(),
        licence: String::new(),
        source: String::new(),
        grid: set.grid,
        amounts: AmountKind::Relative,
        reference: Some(set.pigments[reference.index()].clone()),
        saunderson: surface,
        unevenness: 0.0,
        inputs: Vec::new(),
        settings: Some(settings.clone()),
        pigments: pigments.into_iter().map(|(_, pigment)| pigment).collect(),
        evidence: None,
    };
    library.evidence = Some(evidence(&library, set, &solvable, &identified, viewing));
    if let Some(evidence) = &mut library.evidence {
        evidence.warnings =
            report::warnings(set, &observations, &unknown, &condition, &evidence.per_sample);
    }
    Ok(Calibration {
        library,
        observations,
        condition: Some(condition),
        state: solution.state,
        scattering_known,
    })
}

/// K and S by any method, with their standard deviations.
pub(crate) struct Solution {
    pub(crate) curves: Vec<Curves>,
    /// Standard deviations of K and S by pigment. `None` if you did not request them.
    deviations: Option<Vec<Curves>>,
    state: Option<RefinedState>,
    /// By pigment. Empty without standard deviations, or without a prior on S.
    scattering_known: Vec<f64>,
}

/// If less than this fraction of what we know of S comes from the data, the pigment gets a note.
pub(crate) const HALF_KNOWN: f64 = 0.5;

impl Solution {
    fn pigment(&self, place: usize, name: &str) -> Pigment {
        let deviations = self.deviations.as_ref().map(|all| &all[place]);
        let known = self.scattering_known.get(place).filter(|share| **share < HALF_KNOWN);
        let notes = known.map(|share| {
            format!(
                "S comes to {:.0} % from the data, the rest is the assumption that paints scatter like the white",
                100.0 * share
            )
        });
        Pigment {
            notes: notes.into_iter().collect(),
            ..pigment(name, &self.curves[place], deviations)
        }
    }
}

/// A fitted pigment with its values rounded for a file.
pub(crate) fn pigment(name: &str, curves: &Curves, deviations: Option<&Curves>) -> Pigment {
    Pigment {
        name: name.to_owned(),
        color_index: None,
        absorption: rounded_values(&curves.absorption),
        scattering: rounded_values(&curves.scattering),
        absorption_sd: deviations.map_or_else(Vec::new, |sd| rounded_values(&sd.absorption)),
        scattering_sd: deviations.map_or_else(Vec::new, |sd| rounded_values(&sd.scattering)),
        identified: true,
        guessed: false,
        measured_amounts: None,
        notes: Vec::new(),
    }
}

fn rounded_values(curve: &[f64]) -> Vec<f64> {
    multiple(curve, 1.0)
}

fn multiple(curve: &[f64], factor: f64) -> Vec<f64> {
    curve.iter().map(|&value| rounded(factor * value)).collect()
}

pub(crate) fn solve(
    problem: &Problem,
    method: Method,
    how: Refinement,
    task: &Task,
) -> Result<Solution, FitError> {
    let curves = match method {
        Method::Qp => fit_qp(problem, task)?,
        Method::Weighted => fit_weighted(problem, task)?,
        Method::Refined => {
            // K and S must not depend on the light under which you compute errors.
            let weights =
                Viewing::default().weights(problem.grid).expect("the method fits the grid");
            let Refined { curves, deviations, state, scattering_known } =
                fit_refined(problem, &weights, how, task)?;
            return Ok(Solution { curves, deviations, state: Some(state), scattering_known });
        }
    };
    let deviations = how.deviations.then(|| linear_deviations(problem, &curves));
    Ok(Solution { curves, deviations, state: None, scattering_known: Vec::new() })
}

/// Observations that contain identified pigments only, with the shares of these pigments. We also return
/// the indices of the identified pigments.
pub(crate) fn without(
    observations: &[Observation],
    unknown: &[Unidentified],
) -> (Vec<Observation>, Vec<PigmentId>) {
    let count = observations.first().map_or(0, |o| o.shares.len());
    let all = (0..count).map(PigmentId);
    let identified: Vec<PigmentId> =
        all.filter(|p| unknown.iter().all(|u| u.pigment != *p)).collect();
    let kept = observations
        .iter()
        .filter(|o| unknown.iter().all(|u| o.shares[u.pigment.index()] == 0.0))
        .map(|o| Observation {
            shares: identified.iter().map(|p| o.shares[p.index()]).collect(),
            ..o.clone()
        })
        .collect();
    (kept, identified)
}

/// Standard deviation of log S of a pigment of which we know only the masstone (chosen by eye).
const MASSTONE_DEVIATION: f64 = 1.5;
/// We assume at least this luminance of a masstone, 0 to 1 (chosen by eye).
const LEAST_LUMINANCE: f64 = 0.01;

/// A pigment of which we know only the masstone. Light paints scatter more: we take the square root of the
/// luminance Y of the masstone (0 to 1) as its S.
fn masstone(set: &SwatchSet, observations: &[Observation], lone: &Unidentified) -> Pigment {
    let alone = lone.samples.iter().find(|&&s| observations[s].shares[lone.pigment.index()] == 1.0);
    let sample = &observations[*alone.expect("the pigment has a masstone")];
    let weights = Viewing::default().weights(set.grid).expect("the method fits the grid");
    let luminance = weights.xyz(&sample.as_read).y / weights.white().y;
    let scattering = luminance.clamp(LEAST_LUMINANCE, 1.0).sqrt();
    let ones = vec![1.0; sample.ratio.len()];
    Pigment {
        name: set.pigments[lone.pigment.index()].clone(),
        color_index: None,
        absorption: multiple(&sample.ratio, scattering),
        scattering: multiple(&ones, scattering),
        absorption_sd: multiple(&sample.ratio, scattering * MASSTONE_DEVIATION),
        scattering_sd: multiple(&ones, scattering * MASSTONE_DEVIATION),
        identified: false,
        guessed: false,
        measured_amounts: None,
        notes: vec![format!(
            "only K/S is known, from the masstone {}; S is assumed from its lightness, within a factor of 4, so that mixtures with this pigment are a guess",
            sample.sample
        )],
    }
}

fn evidence(
    library: &PigmentLibrary,
    set: &SwatchSet,
    solvable: &[Observation],
    identified: &[PigmentId],
    viewing: &Viewing,
) -> Evidence {
    let weights = viewing.weights(library.grid).expect("the method fits the grid");
    let in_library: Vec<PigmentId> = identified
        .iter()
        .map(|&p| {
            library.find(&set.pigments[p.index()]).expect("every identified pigment is in it")
        })
        .collect();
    let films = solvable.iter().map(|observation| {
        let shares = observation.shares.iter().copied();
        let recipe: Recipe = in_library.iter().copied().zip(shares).collect();
        let mixture = library.mix(recipe).expect("shares sum to 1");
        let predicted = mixture.hiding(library.saunderson);
        (observation.sample.clone(), observation.as_read.as_slice(), predicted)
    });
    let Scores { rms, delta_e, per_sample } = Scores::of(&weights, films).rounded();
    Evidence {
        illuminant: viewing.illuminant.name().to_owned(),
        observer: viewing.observer.name().to_owned(),
        rms,
        delta_e,
        per_sample,
        warnings: Vec::new(),
    }
}

/// A calibration that cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum CalibrationError {
    /// Readings cannot be used.
    #[error(transparent)]
    Measurement(#[from] MeasurementError),
    /// The fit failed.
    #[error(transparent)]
    Fit(#[from] FitError),
}
