//! The refinement: from the weighted program to the K and S a user gets.

use spectra::TristimulusWeights;

use super::color_term::ColorTerm;
use super::curves::Curves;
use super::deviations::{deviations, share_of_scattering_known};
use super::forward::{Data, Forward};
use super::noise::Noise;
use super::objective::{ColorPart, Objective, RIDGE};
use super::problem::{FitError, Problem};
use super::weighted::weighted;
use pigment::fit_settings::Smoothness;

/// Knee of the spectral loss, in standard deviations.
const KNEE: f64 = 3.0;
/// One over the variance granted to each sample's colour: a standard deviation
/// of 0.32 CIEDE2000, the repeatability of a good instrument.
const COLOR_STRENGTH: f64 = 10.0;

/// Pull of log S towards a pigment's start where amounts are absolute: a
/// standard deviation of 0.32.
const SCATTERING_RIDGE: f64 = 10.0;

/// The fit's answer, with what it found out about the noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Refined {
    /// K by pigment and wavelength.
    pub absorption: Vec<Vec<f64>>,
    /// S by pigment and wavelength.
    pub scattering: Vec<Vec<f64>>,
    /// Standard deviation of K; empty if not asked for.
    pub absorption_sd: Vec<Vec<f64>>,
    /// Standard deviation of S, 0 for the reference; empty if not asked for.
    pub scattering_sd: Vec<Vec<f64>>,
    /// By pigment, the share of what is known of S that comes from the data
    /// rather than from the prior, 0 to 1; empty if not asked for.
    pub scattering_known: Vec<f64>,
    /// What was estimated beside K and S.
    pub state: RefinedState,
}

/// Two numbers estimated from the data, which a leave-one-out fit may reuse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RefinedState {
    /// How much of the noise is constant in reflectance rather than even to the
    /// eye, 0 to 200.
    pub noise_ratio: f64,
    /// Weight of roughness, in units of the residual's variance.
    pub smoothness: f64,
}

/// What a refinement should do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refinement {
    /// How smooth K and S are over wavelength.
    pub smoothness: Smoothness,
    /// What another fit of nearly the same data found out, to be reused.
    pub state: Option<RefinedState>,
    /// Whether standard deviations are wanted; a prediction does without.
    pub deviations: bool,
}

impl Refinement {
    /// The whole answer.
    #[must_use]
    pub fn whole(smoothness: Smoothness) -> Self {
        Self { smoothness, state: None, deviations: true }
    }

    /// K and S alone, for a prediction.
    #[must_use]
    pub fn prediction(smoothness: Smoothness, state: Option<RefinedState>) -> Self {
        Self { smoothness, state, deviations: false }
    }
}

/// K and S by `refined`.
///
/// Minimised is a robust loss of the residuals in measured reflectance, on a
/// scale even to the eye (cube root, weighted by how far CIEDE2000 moves with
/// reflectance at that wavelength), plus roughness of log K and log S over
/// wavelength, then, from there, the same plus the robust colour difference of
/// each sample under D65 (whose weights `weights` are). K and S stay within
/// 1e-5 to 1e4.
///
/// The residual's variance is a sum of two: one even to the eye, one constant
/// in reflectance; their ratio is the one under which the residuals are most
/// likely (Laplace's law). The smoothness is the one under which the data are
/// most likely (MacKay 1992, eq. 2.18). Both are taken from `how.state` instead,
/// where given.
///
/// # Errors
/// As [`super::fit_weighted`], which it starts from.
pub fn fit_refined(
    problem: &Problem,
    weights: &TristimulusWeights,
    how: Refinement,
) -> Result<Refined, FitError> {
    let mut start = weighted(problem)?;
    // A weighted fit may put a pigment at 0, where its logarithm has no slope.
    let off_zero = |curves: &mut Vec<Vec<f64>>, least: f64| {
        curves.iter_mut().flatten().for_each(|v| *v = v.max(least));
    };
    off_zero(&mut start.absorption, 1e-4);
    off_zero(&mut start.scattering, 1e-3);
    let data = Data::hiding(problem);
    Ok(refine(&data, &start, weights, problem.grid.step_nm(), how))
}

/// The refinement of `start` under any optical model.
pub(super) fn refine<F: Forward>(
    data: &Data<'_, F>,
    start: &Curves,
    weights: &TristimulusWeights,
    step_nm: f64,
    how: Refinement,
) -> Refined {
    let smoothness = how.smoothness;
    let layout = data.layout;
    let term = ColorTerm::new(weights, data.target);
    let noise = Noise::new(&term, data.target, data.reading_sd);
    let origin = layout.unknowns(start);
    let fixed = |lambda: f64| lambda * (10.0 / step_nm).powi(3);
    let estimate = how.state.is_none();
    let mut state = how.state.unwrap_or(RefinedState {
        noise_ratio: 0.0,
        smoothness: match smoothness {
            Smoothness::None => 0.0,
            Smoothness::Auto => fixed(10.0),
            Smoothness::Fixed(lambda) => fixed(lambda),
        },
    });
    let mut unknowns = origin.clone();
    let mut objective = Objective {
        data,
        weights: Vec::new(),
        knee: KNEE,
        smoothness: state.smoothness,
        start: &origin,
        // One backing tells little of S, which then keeps the pigment's mean.
        scattering_ridge: if layout.reference.is_some() { RIDGE } else { SCATTERING_RIDGE },
        color: None,
    };
    settle(&mut objective, &noise, state.noise_ratio, &mut unknowns);
    let rounds = if !estimate {
        0
    } else if smoothness == Smoothness::Auto && layout.wavelengths > 2 {
        5
    } else {
        1
    };
    for round in 0..rounds {
        state.noise_ratio = noise.likeliest_ratio(&data.values(&layout.curves(&unknowns)));
        settle(&mut objective, &noise, state.noise_ratio, &mut unknowns);
        if round + 1 == rounds {
            break;
        }
        let next = likeliest_smoothness(&objective, &unknowns);
        if (next / state.smoothness).ln().abs() < 0.15 {
            break;
        }
        state.smoothness = next;
        objective.smoothness = next;
    }

    let differences: Vec<f64> = data
        .values(&layout.curves(&unknowns))
        .iter()
        .enumerate()
        .map(|(index, values)| term.difference(index, values))
        .collect();
    let knee = 5.0 * pigment::evaluate::percentile(&differences, 50.0).max(0.3);
    objective.color = Some(ColorPart { term: &term, strength: COLOR_STRENGTH, knee });
    objective.descend(&mut unknowns, 12, 1e-5);
    objective.color = None;

    let curves = layout.curves(&unknowns);
    let mut scattering_known = Vec::new();
    let [mut absorption_sd, mut scattering_sd] = [Vec::new(), Vec::new()];
    if how.deviations {
        [absorption_sd, scattering_sd] = deviations(&objective, &unknowns, &curves);
        objective.smoothness = 0.0;
        scattering_known = share_of_scattering_known(&objective, &unknowns);
    }
    Refined {
        absorption: curves.absorption,
        scattering: curves.scattering,
        absorption_sd,
        scattering_sd,
        scattering_known,
        state,
    }
}

/// Descends while the residuals' scale is set anew from their median, until
/// that settles: a scale that fell at once would lock early errors in as
/// outliers.
fn settle<F: Forward>(
    objective: &mut Objective<'_, F>,
    noise: &Noise<'_>,
    ratio: f64,
    unknowns: &mut Vec<f64>,
) {
    let mut before = f64::INFINITY;
    for round in 0..20 {
        let values = objective.data.values(&objective.data.layout.curves(unknowns));
        let (weights, sd) = noise.weights(ratio, &values, before / 3.0);
        objective.weights = weights;
        let settled = round >= 3 && (sd / before - 1.0).abs() < 0.1;
        before = sd;
        objective.descend(unknowns, if settled { 60 } else { 5 }, 1e-6);
        if settled {
            break;
        }
    }
}

/// MacKay's update: the number of well-determined second differences over
/// their sum of squares.
fn likeliest_smoothness<F: Forward>(objective: &Objective<'_, F>, unknowns: &[f64]) -> f64 {
    let layout = objective.data.layout;
    let per = layout.per_wavelength();
    let count = (unknowns.len() - 2 * per) as f64;
    let Some(factor) = objective.local(unknowns).matrix.cholesky() else {
        return objective.smoothness;
    };
    let inverse = factor.inverse_band();
    // The trace of inverse x D'D, from the three diagonals of D'D.
    let mut trace = 0.0;
    for i in 0..unknowns.len() - 2 * per {
        let (a, b, c) = (i, i + per, i + 2 * per);
        trace += inverse.at(a, a) + 4.0 * inverse.at(b, b) + inverse.at(c, c)
            - 4.0 * inverse.at(b, a)
            - 4.0 * inverse.at(c, b)
            + 2.0 * inverse.at(c, a);
    }
    let determined = (count - objective.smoothness * trace).max(1.0);
    determined / objective.roughness(unknowns).max(f64::MIN_POSITIVE)
}
