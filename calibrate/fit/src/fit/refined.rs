//! The refinement: from the weighted program to the final K and S.

use spectra::{Grid, TristimulusWeights};

use super::banded::Spare;
use super::color_term::ColorTerm;
use super::curves::{CurveTable, OFF_ZERO};
use super::deviations::{share_of_scattering_known, standard_deviations};
use super::forward::{Data, Forward};
use super::noise::Noise;
use super::objective::{ColorPart, Objective, RIDGE};
use super::problem::{FitError, Problem};
use super::stage::{FitStage, Watch};
use super::weighted::weighted;
use pigment::Curves;
use pigment::fit_settings::Smoothness;

/// Knee of the spectral loss, in standard deviations; chosen by eye.
const KNEE: f64 = 3.0;
/// One over the variance of each sample's colour difference: a standard deviation of 0.32 CIEDE2000, the
/// repeatability of a good instrument.
const COLOR_STRENGTH: f64 = 10.0;
/// Knee of the colour loss, in medians of all colour differences; chosen by eye.
const COLOR_KNEE: f64 = 5.0;
/// Least median of the colour differences for that knee, in CIEDE2000: about the repeatability of a good
/// instrument.
const LEAST_MEDIAN_COLOR: f64 = 0.3;
/// Most steps of the colour stage, which starts near its minimum; chosen by eye.
const COLOR_STEPS: usize = 12;
/// Relative decrease of the cost at which the colour stage ends; chosen by eye.
const COLOR_DECREASE: f64 = 1e-5;
/// Strength of the pull of log S towards a pigment's start where amounts are absolute: a standard
/// deviation of 0.32. Chosen by eye.
const SCATTERING_RIDGE: f64 = 10.0;
/// Smoothness with which its estimation starts, for a wavelength step of 10 nm; chosen by eye.
const FIRST_SMOOTHNESS: f64 = 10.0;
/// Most rounds in which noise and smoothness are estimated alternately; chosen by eye.
const ESTIMATION_ROUNDS: usize = 5;
/// Change of log smoothness below which its estimate has settled; chosen by eye.
const SETTLED_SMOOTHNESS: f64 = 0.15;
/// Most rounds in which the residuals' scale is set anew; chosen by eye.
const SCALE_ROUNDS: usize = 20;
/// Rounds after which the scale may count as settled; chosen by eye.
const LEAST_SCALE_ROUNDS: usize = 3;
/// Relative change of the scale below which it has settled; chosen by eye.
const SETTLED_SCALE: f64 = 0.1;
/// Largest factor by which the scale may fall in one round. If it fell faster, samples that are still fitted
/// badly in early rounds would be treated as outliers for good. Chosen by eye.
const SCALE_FALL: f64 = 3.0;
/// Steps of a round before and after the scale has settled; chosen by eye.
const SCALE_STEPS: [usize; 2] = [5, 60];
/// Relative decrease of the cost at which the descent of a round ends; chosen by eye.
const SCALE_DECREASE: f64 = 1e-6;

/// Result of a refinement, with what it estimated about the noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Refined {
    /// K and S by pigment.
    pub curves: Vec<Curves>,
    /// Standard deviations of K and S by pigment, 0 for the S of the reference; `None` if they were not
    /// requested.
    pub deviations: Option<Vec<Curves>>,
    /// By pigment, the fraction (0 to 1) of the information on S that comes from the data rather than
    /// from the prior; empty if standard deviations were not requested.
    pub scattering_known: Vec<f64>,
    /// Estimates of noise and smoothness.
    pub state: RefinedState,
}

/// Two numbers estimated from the data, which leave-one-out fits may reuse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RefinedState {
    /// Ratio of the noise that is constant in reflectance to the perceptually uniform noise, 0 to 200.
    pub noise_ratio: f64,
    /// Weight of the roughness, in units of the residual's variance.
    pub smoothness: f64,
}

/// Settings of one refinement.
#[derive(Debug, Clone, Copy)]
pub struct Refinement<'a> {
    /// Smoothing of K and S over wavelength.
    pub smoothness: Smoothness,
    /// Estimates of another fit of nearly the same data, to be reused; `None` to estimate them.
    pub state: Option<RefinedState>,
    /// Whether standard deviations are computed; predictions do without them.
    pub deviations: bool,
    /// Who is told the stages of the fit, and may end it.
    pub watch: Watch<'a>,
}

impl Refinement<'_> {
    /// Refinement with standard deviations, all estimates made from the data.
    #[must_use]
    pub fn whole(smoothness: Smoothness) -> Self {
        Self { smoothness, state: None, deviations: true, watch: Watch::default() }
    }

    /// Refinement without standard deviations, for a prediction.
    #[must_use]
    pub fn prediction(smoothness: Smoothness, state: Option<RefinedState>) -> Self {
        Self { smoothness, state, deviations: false, watch: Watch::default() }
    }
}

/// Fits K and S by the method `refined`.
///
/// The cost is a robust loss of the residuals in measured reflectance, on a perceptually uniform scale
/// (cube root, weighted by the movement of CIEDE2000 with reflectance at that wavelength), plus the
/// roughness of log K and log S over wavelength. From its minimum the robust colour difference of each
/// sample under D65 (for which `weights` are computed) is added. K and S stay within 1e-5 to 1e4.
///
/// The variance of a residual is a sum of two: one perceptually uniform, one constant in reflectance.
/// Their ratio is the one under which the residuals are most likely (Laplace's law). The smoothness is
/// the one under which the data are most likely (MacKay 1992, eq. 2.18). Both are taken from
/// `how.state` instead, if given.
///
/// # Errors
/// [`FitError`] from [`super::fit_weighted`], from which the refinement starts, and
/// [`FitError::Cancelled`] if `how.watch` ends it.
pub fn fit_refined(
    problem: &Problem,
    weights: &TristimulusWeights,
    how: Refinement<'_>,
) -> Result<Refined, FitError> {
    // A weighted fit may set a pigment to 0, where its logarithm has no slope.
    let start = weighted(problem, how.watch)?.into_curves(problem.grid);
    let start = CurveTable::off_zero(&start, OFF_ZERO);
    let data = Data::hiding(problem);
    refine(&data, &start, weights, problem.grid, how)
}

/// Refines `start` under any optical model.
///
/// # Errors
/// [`FitError::Cancelled`] if the watch ends the fit: the loops below then end early, and the last check
/// refuses what they leave.
pub(super) fn refine<F: Forward>(
    data: &Data<'_, F>,
    start: &CurveTable,
    weights: &TristimulusWeights,
    grid: Grid,
    how: Refinement<'_>,
) -> Result<Refined, FitError> {
    let smoothness = how.smoothness;
    let layout = data.layout;
    let term = ColorTerm::new(weights, data.target);
    let noise = Noise::new(&term, data.target, data.reading_sd);
    let origin = layout.unknowns(start);
    let fixed = |lambda: f64| lambda * (10.0 / grid.step_nm()).powi(3);
    let estimate = how.state.is_none();
    let mut state = how.state.unwrap_or(RefinedState {
        noise_ratio: 0.0,
        smoothness: match smoothness {
            Smoothness::None => 0.0,
            Smoothness::Auto => fixed(FIRST_SMOOTHNESS),
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
        // Films over a single backing contain little information on S, so S is kept near its start.
        scattering_ridge: if layout.reference.is_some() { RIDGE } else { SCATTERING_RIDGE },
        color: None,
        spare: Spare::default(),
        watch: how.watch,
    };
    let watched =
        |estimate: usize| move |round: usize| how.watch.tell(FitStage::Spectra { estimate, round });
    settle(&mut objective, &noise, state.noise_ratio, &mut unknowns, watched(1));
    let rounds = if !estimate {
        0
    } else if smoothness == Smoothness::Auto && layout.wavelengths > 2 {
        ESTIMATION_ROUNDS
    } else {
        1
    };
    for round in 0..rounds {
        how.watch.check()?;
        state.noise_ratio = noise.likeliest_ratio(&data.values(&layout.curves(&unknowns)));
        settle(&mut objective, &noise, state.noise_ratio, &mut unknowns, watched(round + 2));
        if round + 1 == rounds {
            break;
        }
        let next = likeliest_smoothness(&objective, &unknowns);
        if (next / state.smoothness).ln().abs() < SETTLED_SMOOTHNESS {
            break;
        }
        state.smoothness = next;
        objective.smoothness = next;
    }

    how.watch.check()?;
    how.watch.tell(FitStage::Colors);
    let differences: Vec<f64> = data
        .values(&layout.curves(&unknowns))
        .iter()
        .enumerate()
        .map(|(index, values)| term.difference(index, values))
        .collect();
    let median = pigment::evaluate::percentile(&differences, 50.0);
    let knee = COLOR_KNEE * median.max(LEAST_MEDIAN_COLOR);
    objective.color = Some(ColorPart { term: &term, strength: COLOR_STRENGTH, knee });
    objective.descend(&mut unknowns, COLOR_STEPS, COLOR_DECREASE);
    objective.color = None;

    let curves = layout.curves(&unknowns);
    let mut deviations = None;
    let mut scattering_known = Vec::new();
    how.watch.check()?;
    if how.deviations {
        let table = standard_deviations(&objective, &unknowns, &curves, how.watch);
        deviations = Some(table.into_curves(grid));
        objective.smoothness = 0.0;
        scattering_known = share_of_scattering_known(&objective, &unknowns);
    }
    how.watch.check()?;
    Ok(Refined { curves: curves.into_curves(grid), deviations, scattering_known, state })
}

/// Descends while the residuals' scale is set anew from their median in each round, until it settles.
fn settle<F: Forward>(
    objective: &mut Objective<'_, F>,
    noise: &Noise,
    ratio: f64,
    unknowns: &mut Vec<f64>,
    watch: impl Fn(usize),
) {
    let mut before = f64::INFINITY;
    for round in 0..SCALE_ROUNDS {
        watch(round + 1);
        let values = objective.data.values(&objective.data.layout.curves(unknowns));
        let (weights, sd) = noise.weights(ratio, &values, before / SCALE_FALL);
        objective.weights = weights;
        let settled = round >= LEAST_SCALE_ROUNDS && (sd / before - 1.0).abs() < SETTLED_SCALE;
        before = sd;
        objective.descend(unknowns, SCALE_STEPS[usize::from(settled)], SCALE_DECREASE);
        if settled || objective.watch.is_cancelled() {
            break;
        }
    }
}

/// MacKay's update of the smoothness: the number of well-determined second differences divided by their
/// sum of squares.
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
        let a = i;
        let b = i + per;
        let c = i + 2 * per;
        trace += inverse.at(a, a) + 4.0 * inverse.at(b, b) + inverse.at(c, c)
            - 4.0 * inverse.at(b, a)
            - 4.0 * inverse.at(c, b)
            + 2.0 * inverse.at(c, a);
    }
    let determined = (count - objective.smoothness * trace).max(1.0);
    determined / objective.roughness(unknowns).max(f64::MIN_POSITIVE)
}
