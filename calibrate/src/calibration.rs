//! The main job: from swatches to a pigment library with its evidence.

use spectra::optics::Surface;

use crate::findings;
use crate::fit::{
    Condition, FitError, FitSettings, Method, Problem, RefinedState, Refinement, Unidentified,
    Unknown, condition, fit_qp, fit_refined, fit_weighted, linear_deviations, unidentified,
};
use crate::measurement::MeasurementError;
use crate::observation::{Observation, observations};
use crate::scores::Scores;
use crate::swatch::SwatchSet;
use pigment::digits::rounded;
use pigment::evaluate::Viewing;
use pigment::library::{AmountKind, Evidence, Pigment, PigmentLibrary};

/// A library, and what its making showed.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// The library; its title, licence, source and inputs are left to the
    /// caller.
    pub library: PigmentLibrary,
    /// The swatches as the fit saw them, in order of the file.
    pub observations: Vec<Observation>,
    /// Rank and condition of the equations; none for absolute amounts.
    pub condition: Option<Condition>,
    /// What a leave-one-out fit may reuse.
    pub state: Option<RefinedState>,
}

/// Fits K and S of every pigment of `set`, S relative to the pigment number
/// `reference`.
///
/// Colour errors in the evidence are CIEDE2000 under `viewing`, between each
/// swatch's K/S in a film that hides and the fitted mixture. Samples of a
/// pigment that the data do not identify take no part in fit and errors: a
/// pigment known only from a masstone gets its K/S with S = 1, marked so; one
/// without even that is left out.
///
/// # Errors
/// [`CalibrationError`].
pub fn calibrate(
    set: &SwatchSet,
    reference: usize,
    surface: Surface,
    settings: &FitSettings,
    viewing: &Viewing,
) -> Result<Calibration, CalibrationError> {
    let observations = observations(set, surface, settings.below_surface)?;
    let shares: Vec<Vec<f64>> = observations.iter().map(|o| o.shares.clone()).collect();
    let unknown = unidentified(&shares, reference);
    let (solvable, identified) = without(&observations, &unknown);
    let reference_among =
        identified.iter().position(|&p| p == reference).ok_or(FitError::Reference)?;
    let problem = Problem::new(set.grid, surface, &solvable, reference_among)?;
    let solution = solve(&problem, settings.method, Refinement::whole(settings.smoothness))?;
    let condition = condition(&problem, &solution.absorption, &solution.scattering);

    let mut pigments: Vec<(usize, Pigment)> = identified
        .iter()
        .enumerate()
        .map(|(place, &index)| (index, solution.pigment(place, &set.pigments[index])))
        .collect();
    for lone in unknown.iter().filter(|u| u.unknown == Unknown::Scattering) {
        pigments.push((lone.pigment, masstone(set, &observations, lone)));
    }
    pigments.sort_by_key(|(index, _)| *index);
    let mut library = PigmentLibrary {
        title: String::new(),
        licence: String::new(),
        source: String::new(),
        grid: set.grid,
        amounts: AmountKind::Relative,
        reference: Some(set.pigments[reference].clone()),
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
            findings::warnings(set, &observations, &unknown, &condition, &evidence.per_sample);
    }
    Ok(Calibration { library, observations, condition: Some(condition), state: solution.state })
}

/// K and S by any method, with their standard deviations.
pub(crate) struct Solution {
    pub(crate) absorption: Vec<Vec<f64>>,
    pub(crate) scattering: Vec<Vec<f64>>,
    deviations: [Vec<Vec<f64>>; 2],
    state: Option<RefinedState>,
}

impl Solution {
    fn pigment(&self, place: usize, name: &str) -> Pigment {
        let rounded = |curve: &[f64]| -> Vec<f64> { curve.iter().map(|&v| rounded(v)).collect() };
        Pigment {
            name: name.to_owned(),
            color_index: None,
            absorption: rounded(&self.absorption[place]),
            scattering: rounded(&self.scattering[place]),
            absorption_sd: rounded(&self.deviations[0][place]),
            scattering_sd: rounded(&self.deviations[1][place]),
            identified: true,
            guessed: false,
            notes: Vec::new(),
        }
    }
}

pub(crate) fn solve(
    problem: &Problem,
    method: Method,
    how: Refinement,
) -> Result<Solution, FitError> {
    let plain = |[absorption, scattering]: [Vec<Vec<f64>>; 2]| Solution {
        deviations: if how.deviations {
            linear_deviations(problem, &absorption, &scattering)
        } else {
            [Vec::new(), Vec::new()]
        },
        absorption,
        scattering,
        state: None,
    };
    Ok(match method {
        Method::Qp => plain(fit_qp(problem)?),
        Method::Weighted => plain(fit_weighted(problem)?),
        Method::Refined => {
            // K and S must not depend on the light of the day's comparison.
            let weights =
                Viewing::default().weights(problem.grid).expect("the method fits the grid");
            let refined = fit_refined(problem, &weights, how)?;
            Solution {
                absorption: refined.absorption,
                scattering: refined.scattering,
                deviations: [refined.absorption_sd, refined.scattering_sd],
                state: Some(refined.state),
            }
        }
    })
}

/// The observations of identified pigments alone, their shares cut down to
/// those, and the pigments' indices.
pub(crate) fn without(
    observations: &[Observation],
    unknown: &[Unidentified],
) -> (Vec<Observation>, Vec<usize>) {
    let count = observations.first().map_or(0, |o| o.shares.len());
    let identified: Vec<usize> =
        (0..count).filter(|p| unknown.iter().all(|u| u.pigment != *p)).collect();
    let kept = observations
        .iter()
        .filter(|o| unknown.iter().all(|u| o.shares[u.pigment] == 0.0))
        .map(|o| Observation {
            shares: identified.iter().map(|&p| o.shares[p]).collect(),
            ..o.clone()
        })
        .collect();
    (kept, identified)
}

/// A pigment of which only K/S is known.
fn masstone(set: &SwatchSet, observations: &[Observation], lone: &Unidentified) -> Pigment {
    let alone = lone.samples.iter().find(|&&s| observations[s].shares[lone.pigment] == 1.0);
    let sample = &observations[*alone.expect("its masstone was found before")];
    Pigment {
        name: set.pigments[lone.pigment].clone(),
        color_index: None,
        absorption: sample.ratio.iter().map(|&v| rounded(v)).collect(),
        scattering: vec![1.0; sample.ratio.len()],
        absorption_sd: Vec::new(),
        scattering_sd: Vec::new(),
        identified: false,
        guessed: false,
        notes: vec![format!(
            "only K/S is known, from the masstone {}; S = 1 stands for an unknown scattering, so that mixtures with this pigment are a guess",
            sample.sample
        )],
    }
}

fn evidence(
    library: &PigmentLibrary,
    set: &SwatchSet,
    solvable: &[Observation],
    identified: &[usize],
    viewing: &Viewing,
) -> Evidence {
    let weights = viewing.weights(library.grid).expect("the method fits the grid");
    let in_library: Vec<usize> = identified
        .iter()
        .map(|&p| library.find(&set.pigments[p]).expect("every identified pigment is in it"))
        .collect();
    let films = solvable.iter().map(|observation| {
        let shares = observation.shares.iter().copied();
        let recipe: Vec<(usize, f64)> = in_library.iter().copied().zip(shares).collect();
        let mixture = library.mix(&recipe).expect("shares sum to 1");
        let predicted = mixture.hiding(library.saunderson);
        (observation.sample.clone(), observation.reflectance.as_slice(), predicted)
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

/// Why there is no calibration.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CalibrationError {
    /// The readings cannot be used.
    #[error(transparent)]
    Measurement(#[from] MeasurementError),
    /// The fit failed.
    #[error(transparent)]
    Fit(#[from] FitError),
}
