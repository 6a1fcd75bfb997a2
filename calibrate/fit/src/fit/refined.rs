//! The refinement: from the weighted program to the final K and S and their standard deviations.
//!
//! Plans use the same equations to forecast the information that you will get from planned mixtures.

use documents::Task;
use pigment::evaluate::{Viewing, percentile};
use pigment::fit_settings::Smoothness;
use pigment::{Curves, PigmentId};
use rayon::prelude::*;
use spectra::optics::Surface;
use spectra::{Grid, TristimulusWeights};

use super::banded::{BandedCholesky, Spare, TOGETHER};
use super::forward::{ColorTerm, Data, Forward};
use super::objective::{ColorPart, ExpectedNoise, Noise, Objective, RIDGE};
use super::problem::{CurveTable, FitError, Layout, OFF_ZERO, Problem};
use super::program::weighted;
use super::scattering::{self, Levels};

/// The spectral loss turns linear at this many standard deviations (chosen by eye).
const KNEE: f64 = 3.0;
/// One over the variance of each sample's colour difference. We assume a standard deviation of 0.32
/// CIEDE2000, which is the repeatability of a good instrument.
const COLOR_STRENGTH: f64 = 10.0;
/// The colour loss turns linear at this many medians of all colour differences (chosen by eye).
const COLOR_KNEE: f64 = 5.0;
/// For the knee of the colour loss we assume at least this median of the colour differences, in CIEDE2000.
/// It is about the repeatability of a good instrument.
const LEAST_MEDIAN_COLOR: f64 = 0.3;
/// We make at most this many steps in the colour stage, which starts near its minimum (chosen by eye).
const COLOR_STEPS: usize = 12;
/// The colour stage ends when the cost falls by less than this fraction (chosen by eye).
const COLOR_DECREASE: f64 = 1e-5;
/// How strongly log S is pulled towards a pigment's start where amounts are absolute. This is a standard
/// deviation of 0.32. We chose it by eye.
const SCATTERING_RIDGE: f64 = 10.0;
/// We begin to estimate the smoothness with this value, for a wavelength step of 10 nm (chosen by eye).
const FIRST_SMOOTHNESS: f64 = 10.0;
/// We estimate noise and smoothness in turn in at most this many rounds (chosen by eye).
const ESTIMATION_ROUNDS: usize = 5;
/// The smoothness has settled if its logarithm changes by less than this (chosen by eye).
const SETTLED_SMOOTHNESS: f64 = 0.15;
/// We set the residuals' scale anew in at most this many rounds (chosen by eye).
const SCALE_ROUNDS: usize = 20;
/// The scale may count as settled after this many rounds (chosen by eye).
const LEAST_SCALE_ROUNDS: usize = 3;
/// The scale has settled if it changes by less than this fraction (chosen by eye).
const SETTLED_SCALE: f64 = 0.1;
/// We let the scale fall at most by this factor in one round. If it fell faster, we would treat samples
/// that early rounds still fit badly as outliers for good. We chose it by eye.
const SCALE_FALL: f64 = 3.0;
/// Steps of a round before and after the scale has settled (chosen by eye).
const SCALE_STEPS: [usize; 2] = [5, 60];
/// The descent of a round ends when the cost falls by less than this fraction (chosen by eye).
const SCALE_DECREASE: f64 = 1e-6;

/// Result of a refinement, and what we learn from it about the noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Refined {
    /// K and S by pigment.
    pub curves: Vec<Curves>,
    /// Standard deviations of K and S by pigment, 0 for the S of the reference, or `None` if they were
    /// not requested.
    pub deviations: Option<Vec<Curves>>,
    /// By pigment: the fraction (0 to 1) of what we know of S that comes from the data. The rest comes from the
    /// prior. This is empty if you did not request standard deviations.
    pub scattering_known: Vec<f64>,
    /// Estimates of noise and smoothness.
    pub state: RefinedState,
}

/// Two numbers that we estimate from the data. You may reuse them in leave-one-out fits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RefinedState {
    /// Ratio of the noise that is constant in reflectance to the perceptually uniform noise, 0 to 200.
    pub noise_ratio: f64,
    /// Weight of the roughness, in units of the residual's variance.
    pub smoothness: f64,
}

/// Settings of one refinement.
#[derive(Debug, Clone, Copy)]
pub struct Refinement {
    /// Smoothing of K and S over wavelength.
    pub smoothness: Smoothness,
    /// Estimates of another fit of nearly the same data, if you want to reuse them. Pass `None` to estimate
    /// them.
    pub state: Option<RefinedState>,
    /// Whether to compute standard deviations. You do not need them for predictions.
    pub deviations: bool,
}

impl Refinement {
    /// Refinement with standard deviations, all estimates made from the data.
    #[must_use]
    pub fn whole(smoothness: Smoothness) -> Self {
        Self { smoothness, state: None, deviations: true }
    }

    /// Refinement without standard deviations, for a prediction.
    #[must_use]
    pub fn prediction(smoothness: Smoothness, state: Option<RefinedState>) -> Self {
        Self { smoothness, state, deviations: false }
    }
}

/// Fits K and S by the method `refined`.
///
/// We minimise a robust loss of the residuals in measured reflectance, on a perceptually uniform scale
/// (cube root, weighted by the movement of CIEDE2000 with reflectance at this wavelength), plus the
/// roughness of log K and log S over wavelength, plus the distance of log S from the level of its pigment. From this minimum on, we add the robust colour difference
/// of each sample under D65 (for which you compute `weights`). K and S stay within 1e-5 to 1e4.
///
/// The variance of a residual is a sum of two: one is perceptually uniform, one is constant in reflectance.
/// We take the ratio that makes the residuals most likely (Laplace's law), and the smoothness that makes
/// the data most likely (MacKay 1992, eq. 2.18). If you pass `how.state`, we take both from there.
///
/// # Errors
/// [`FitError`] from [`super::fit_weighted`], from which the refinement starts, and
/// [`FitError::Cancelled`] if `task` was cancelled.
pub fn fit_refined(
    problem: &Problem,
    weights: &TristimulusWeights,
    how: Refinement,
    task: &Task,
) -> Result<Refined, FitError> {
    // A weighted fit may set a pigment to 0, where its logarithm has no slope.
    let start = weighted(problem, task)?.into_curves(problem.grid);
    let start = CurveTable::off_zero(&start, OFF_ZERO);
    let data = Data::hiding(problem);
    refine(&data, &start, weights, problem.grid, how, task)
}

/// Refines `start` under any optical model.
///
/// # Errors
/// [`FitError::Cancelled`] if `task` was cancelled. The loops below then end early, and the last check
/// refuses the unfinished result.
pub(super) fn refine<F: Forward>(
    data: &Data<'_, F>,
    start: &CurveTable,
    weights: &TristimulusWeights,
    grid: Grid,
    how: Refinement,
    task: &Task,
) -> Result<Refined, FitError> {
    let smoothness = how.smoothness;
    let layout = data.layout;
    let term = ColorTerm::new(weights, data.target);
    let noise = Noise::new(&term, data.target, data.reading_sd);
    let origin = layout.unknowns(start);
    let per_step = (10.0 / grid.step_nm()).powi(3);
    let estimate = how.state.is_none();
    let mut state = how.state.unwrap_or(RefinedState {
        noise_ratio: 0.0,
        smoothness: match smoothness {
            Smoothness::None => 0.0,
            Smoothness::Auto => FIRST_SMOOTHNESS * per_step,
            Smoothness::Fixed(lambda) => lambda * per_step,
        },
    });
    let mut unknowns = origin.clone();
    let is_relative = layout.reference.is_some();
    let mut center = origin;
    if is_relative {
        let scattering = center.iter_mut().enumerate().filter(|(i, _)| layout.is_scattering(*i));
        scattering.for_each(|(_, level)| *level = 0.0);
    }
    let mut objective = Objective {
        data,
        weights: Vec::new(),
        knee: KNEE,
        smoothness: state.smoothness,
        center,
        // We learn little about S from films over a single backing, so we hold S near its start.
        scattering_ridge: if is_relative { scattering::ridge(grid) } else { SCATTERING_RIDGE },
        color: None,
        spare: Spare::default(),
        task,
    };
    settle(&mut objective, &noise, state.noise_ratio, &mut unknowns, 1);
    settle_levels(&mut objective, &mut unknowns);
    let rounds = if !estimate {
        0
    } else if smoothness == Smoothness::Auto && layout.wavelengths > 2 {
        ESTIMATION_ROUNDS
    } else {
        1
    };
    for round in 0..rounds {
        task.check()?;
        state.noise_ratio = noise.likeliest_ratio(&data.values(&layout.curves(&unknowns)));
        settle(&mut objective, &noise, state.noise_ratio, &mut unknowns, round + 2);
        settle_levels(&mut objective, &mut unknowns);
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

    task.check()?;
    task.stage("refinement by colours");
    let differences: Vec<f64> = data
        .values(&layout.curves(&unknowns))
        .iter()
        .enumerate()
        .map(|(index, values)| term.difference(index, values))
        .collect();
    let median = percentile(&differences, 50.0);
    let knee = COLOR_KNEE * median.max(LEAST_MEDIAN_COLOR);
    objective.color = Some(ColorPart { term: &term, strength: COLOR_STRENGTH, knee });
    objective.descend(&mut unknowns, COLOR_STEPS, COLOR_DECREASE);
    objective.color = None;

    let curves = layout.curves(&unknowns);
    let mut deviations = None;
    let mut scattering_known = Vec::new();
    task.check()?;
    if how.deviations {
        let table = standard_deviations(&objective, &unknowns, &curves);
        scattering_known = if is_relative {
            scattering::known(&curves, &table, grid)
        } else {
            objective.smoothness = 0.0;
            share_of_scattering_known(&objective, &unknowns)
        };
        deviations = Some(table.into_curves(grid));
    }
    task.check()?;
    Ok(Refined { curves: curves.into_curves(grid), deviations, scattering_known, state })
}

/// Moves the levels of log S to where they are likeliest, and the unknowns with them. Absolute amounts have
/// none.
fn settle_levels<F: Forward>(objective: &mut Objective<'_, F>, unknowns: &mut [f64]) {
    if let Some(levels) = levels(objective, unknowns) {
        levels.settle(objective, unknowns);
    }
}

fn levels<F: Forward>(objective: &Objective<'_, F>, unknowns: &[f64]) -> Option<Levels> {
    objective.data.layout.reference?;
    Levels::of(objective, &objective.local(unknowns).matrix.cholesky()?)
}

/// Descends for one estimate of noise and smoothness. In each round we set the residuals' scale anew from
/// their median, until it settles.
fn settle<F: Forward>(
    objective: &mut Objective<'_, F>,
    noise: &Noise,
    ratio: f64,
    unknowns: &mut Vec<f64>,
    estimate: usize,
) {
    let mut before = f64::INFINITY;
    for round in 0..SCALE_ROUNDS {
        objective
            .task
            .stage(format_args!("refinement by spectra, estimate {estimate}, round {}", round + 1));
        let values = objective.data.values(&objective.data.layout.curves(unknowns));
        let (weights, sd) = noise.weights(ratio, &values, before / SCALE_FALL);
        objective.weights = weights;
        let settled = round >= LEAST_SCALE_ROUNDS && (sd / before - 1.0).abs() < SETTLED_SCALE;
        before = sd;
        objective.descend(unknowns, SCALE_STEPS[usize::from(settled)], SCALE_DECREASE);
        if settled || objective.task.is_cancelled() {
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

const LEAST: f64 = 1e-4;

/// Standard deviations of K and S at the minimum of `objective`.
///
/// We return the larger of two estimates. The first is the inverse of the normal matrix H with its priors,
/// as if all residuals were independent. The second is the spread of the gradients of the samples, H^-1
/// (sum of g g') H^-1 with g the gradient of one sample over all wavelengths (Liang and Zeger 1986). The
/// second one takes into account that a sample which you painted wrongly is wrong at every wavelength. But
/// it is 0 where the few samples of a pigment are fitted exactly.
pub(super) fn standard_deviations<F: Forward>(
    objective: &Objective<'_, F>,
    unknowns: &[f64],
    curves: &CurveTable,
) -> CurveTable {
    let layout = objective.data.layout;
    let per = layout.per_wavelength();
    // Without data only the ridge remains.
    let mut variances = vec![RIDGE.recip(); layout.len()];
    if let Some(factor) = objective.local(unknowns).matrix.cholesky() {
        let inverse = factor.inverse_band();
        let spread = spread_of_gradients(objective, unknowns, &factor);
        let of_levels = levels(objective, unknowns)
            .map_or_else(|| vec![0.0; layout.len()], |l| l.variances(objective, unknowns));
        for (i, variance) in variances.iter_mut().enumerate() {
            *variance = f64::max(inverse.at(i, i) + of_levels[i], spread[i]);
        }
    }
    let of_logs = |place: usize, curve: &[f64]| -> Vec<f64> {
        let values = curve.iter().enumerate();
        values.map(|(at, value)| value * variances[at * per + place].sqrt()).collect()
    };
    let absorption =
        curves.absorption.iter().enumerate().map(|(p, curve)| of_logs(p, curve)).collect();
    let scattering = curves
        .scattering
        .iter()
        .enumerate()
        .map(|(p, curve)| match layout.scattering(p) {
            Some(place) => of_logs(place, curve),
            None => vec![0.0; curve.len()],
        })
        .collect();
    CurveTable { absorption, scattering }
}

/// By unknown: sum over samples of the squared step that the gradient of this sample alone would cause. We
/// add samples in their order, on any number of threads. The sum is incomplete if you cancel the fit.
fn spread_of_gradients<F: Forward>(
    objective: &Objective<'_, F>,
    unknowns: &[f64],
    factor: &BandedCholesky,
) -> Vec<f64> {
    let layout = objective.data.layout;
    let linear = objective.data.linear(&layout.curves(unknowns));
    let samples: Vec<usize> = (0..objective.data.recipes.len()).collect();
    let mut spread = vec![0.0; layout.len()];
    for several in samples.chunks(TOGETHER * rayon::current_num_threads()) {
        if objective.task.is_cancelled() {
            break;
        }
        let of = samples.len();
        let done = several[0];
        objective.task.stage(format_args!("standard deviations, sample {done} of {of}"));
        let steps = several.par_chunks(TOGETHER).map(|group| {
            let mut right = vec![[0.0; TOGETHER]; layout.len()];
            for (place, &index) in group.iter().enumerate() {
                for (unknown, value) in objective.gradient_of_sample(&linear, index) {
                    right[unknown][place] += value;
                }
            }
            factor.solve_together(&mut right);
            right
        });
        let steps: Vec<Vec<[f64; TOGETHER]>> = steps.collect();
        spread.par_iter_mut().enumerate().for_each(|(unknown, total)| {
            for group in &steps {
                group[unknown].iter().for_each(|pull| *total += pull * pull);
            }
        });
    }
    spread
}

/// By pigment: the fraction (0 to 1) of our information on its log S that comes from the data and not from
/// the prior (median over wavelength).
///
/// We compare the ridge with the information of the data on log S, where K of the pigment is unknown too.
/// Pass an `objective` without smoothness. Otherwise we would count the prior of one wavelength as data of
/// its neighbours.
pub(super) fn share_of_scattering_known<F: Forward>(
    objective: &Objective<'_, F>,
    unknowns: &[f64],
) -> Vec<f64> {
    let layout = objective.data.layout;
    let matrix = objective.local(unknowns).matrix;
    let medians = (0..layout.pigments).map(|pigment| {
        let shares = (0..layout.wavelengths).map(|at| {
            let Some(place) = layout.scattering(pigment) else { return 1.0 };
            let k = at * layout.per_wavelength() + pigment;
            let s = at * layout.per_wavelength() + place;
            let of_k = (matrix.diagonal(k) - objective.ridge(k)).max(f64::MIN_POSITIVE);
            let of_s = matrix.diagonal(s) - objective.ridge(s);
            let information = (of_s - matrix.at(s, k).powi(2) / of_k).max(0.0);
            information / (information + objective.ridge(s))
        });
        percentile(&shares.collect::<Vec<f64>>(), 50.0)
    });
    medians.collect()
}

/// Standard deviations of K and S for a fit that has none of its own, by pigment and wavelength.
///
/// We treat each wavelength by itself. The result is the variance of its residuals of measured reflectance
/// times the inverse of the normal matrix of their derivatives with respect to K and S. A value that no
/// mixture determines gets a deviation of its own size or more. The S of the reference gets 0.
#[must_use]
pub fn linear_deviations(problem: &Problem, curves: &[Curves]) -> Vec<Curves> {
    // The program may set a pigment to 0, where the slopes are not finite.
    let curves = CurveTable::off_zero(curves, [LEAST, LEAST]);
    let data = Data::hiding(problem);
    let layout = data.layout;
    let linear = data.linear(&curves);
    let unknowns = layout.per_wavelength();
    let freedom = problem.recipes.len().saturating_sub(unknowns).max(1) as f64;
    let zeros = vec![vec![0.0; layout.wavelengths]; layout.pigments];
    let mut deviations = CurveTable { absorption: zeros.clone(), scattering: zeros };
    for at in 0..layout.wavelengths {
        let mut normal = data.normal(&linear, at);
        let pairs = linear.values.iter().zip(&problem.reflectance);
        let squares: f64 = pairs.map(|(value, read)| (value[at] - read[at]).powi(2)).sum();
        let variance = squares / freedom;
        // The unknowns are logarithms. This term limits their deviations to 1, the deviation of a value that
        // no mixture determines.
        for i in 0..unknowns {
            normal[(i, i)] += variance.max(f64::MIN_POSITIVE);
        }
        let Some(inverse) = normal.cholesky().map(|factor| factor.inverse()) else { continue };
        let sds: Vec<f64> =
            (0..unknowns).map(|place| (variance * inverse[(place, place)]).sqrt()).collect();
        for (pigment, curve) in deviations.absorption.iter_mut().enumerate() {
            curve[at] = curves.absorption[pigment][at] * sds[pigment];
        }
        for (pigment, curve) in deviations.scattering.iter_mut().enumerate() {
            if let Some(place) = layout.scattering(pigment) {
                curve[at] = curves.scattering[pigment][at] * sds[place];
            }
        }
    }
    deviations.into_curves(problem.grid)
}

/// Assumed K and S of the paints.
#[derive(Debug, Clone)]
pub(crate) struct AssumedPaints {
    pub(crate) surface: Surface,
    pub(crate) reference: PigmentId,
    /// K and S by paint; at least one.
    pub(crate) curves: Vec<Curves>,
}

/// Derivatives of the reflectances of mixtures with respect to the unknowns of a fit (log K of every paint
/// and log S of all except the reference), divided by the standard deviation of a reading.
#[derive(Debug, Clone)]
pub(crate) struct Slopes {
    layout: Layout,
    /// For each mixture: indices of its unknowns among the unknowns of one wavelength.
    pub(crate) places: Vec<Vec<usize>>,
    /// By mixture: for each wavelength in turn, one derivative for each of its unknowns.
    pub(crate) slopes: Vec<Vec<f64>>,
}

impl Slopes {
    /// Derivatives for `recipes` as films that hide, under the noise model of the refinement. Recipes are
    /// lists of paints with their shares.
    pub(crate) fn of(
        paints: &AssumedPaints,
        recipes: Vec<Vec<(usize, f64)>>,
        noise: ExpectedNoise,
    ) -> Self {
        let curves = CurveTable::off_zero(&paints.curves, OFF_ZERO);
        let grid = paints.curves[0].grid;
        let mut problem = Problem {
            grid,
            surface: paints.surface,
            pigments: paints.curves.len(),
            reference: paints.reference,
            reading_sd: 0.0,
            recipes,
            ratio: Vec::new(),
            reflectance: Vec::new(),
        };
        problem.reflectance = problem.predicted(&curves);
        let weights = Viewing::default().weights(grid).expect("the method fits the grid");
        let term = ColorTerm::new(&weights, &problem.reflectance);
        let precision = Noise::new(&term, &problem.reflectance, 0.0).precision(noise);
        let data = Data::hiding(&problem);
        let mut slopes = data.linear(&curves).slopes;
        let places: Vec<Vec<usize>> =
            (0..problem.recipes.len()).map(|index| data.places(index).to_vec()).collect();
        for ((slopes, places), precision) in slopes.iter_mut().zip(&places).zip(&precision) {
            for (chunk, precision) in slopes.chunks_exact_mut(places.len()).zip(precision) {
                chunk.iter_mut().for_each(|slope| *slope *= precision);
            }
        }
        Self { layout: data.layout, places, slopes }
    }

    pub(crate) fn unknowns(&self) -> usize {
        self.layout.per_wavelength()
    }

    pub(crate) fn wavelengths(&self) -> usize {
        self.layout.wavelengths
    }

    /// Index of log S of `paint` among the unknowns of one wavelength, or `None` for the reference. The
    /// index of log K is the index of the paint.
    pub(crate) fn scattering(&self, paint: usize) -> Option<usize> {
        self.layout.scattering(paint)
    }

    pub(crate) fn at(&self, index: usize, at: usize) -> &[f64] {
        let count = self.places[index].len();
        &self.slopes[index][at * count..(at + 1) * count]
    }
}

/// Before any data, a fit knows this much about each log K and log S from its prior.
pub(crate) const PRIOR_INFORMATION: f64 = RIDGE;
