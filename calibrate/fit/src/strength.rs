//! Tinting strength of mixtures that were left out of a fit. It shows a paint that is stronger or
//! weaker than the fit of the other samples says, and a white that was weighed wrongly.
//!
//! Errors of single weighings scatter around a factor of 1. If one factor instead multiplies the
//! amount of a pigment in all mixtures of a file, then that paint came from another batch. If it
//! multiplies the amounts of all pigments beside the white, then the white was weighed wrongly, or
//! is from another batch.

use std::fmt;

use pigment::evaluate::delta_e;
use pigment::{Curves, PigmentId};
use serde::Serialize;
use spectra::optics::Surface;
use spectra::{Grid, TristimulusWeights};

/// We try this many factors of the strength, from 1/4 to 4, evenly spaced in their logarithm.
const STRENGTHS: i32 = 33;
/// We refine the best factor in this many steps. Each step halves the distance at which we try two
/// other factors.
const HALVINGS: usize = 12;
/// We name a factor only if it differs from 1 by at least this. Weighing by hand is hardly better
/// (chosen by eye).
const LEAST_CHANGE: f64 = 0.05;
/// We name a factor only if it lowers the mean error by at least this share (chosen by eye).
const LEAST_GAIN: f64 = 0.1;
/// We name a factor only for at least this many mixtures.
const LEAST_MIXTURES: usize = 3;
/// Student's t that chance exceeds in 1 % of cases, by degrees of freedom from 2 on. Beyond the
/// table we take the last.
const STUDENT: [f64; 9] = [9.92, 5.84, 4.60, 4.03, 3.71, 3.50, 3.36, 3.25, 3.17];
/// Standard deviation of a median of normal values, relative to their median absolute deviation and
/// without the root of their number.
const MEDIAN_SD: f64 = 1.253 * 1.483;
/// Sensitivity of a colour to the strength is its change over this step of the logarithm.
const STEP: f64 = 0.1;

/// A common factor of the strength of a pigment, or of all pigments, in some mixtures.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StrengthChange {
    /// Pigment that is stronger or weaker, or `None` for all pigments beside the white. In mixtures
    /// without the white, these are all beside the pigment with the largest share.
    pub pigment: Option<String>,
    /// File of these mixtures.
    pub file: String,
    /// Number of mixtures.
    pub mixtures: usize,
    /// Least and greatest number of pigments of the mixtures.
    pub sizes: [usize; 2],
    /// The pigment acts as if there were this many times as much of it.
    pub factor: f64,
    /// Relative standard error of `factor`. We estimate it from how far the best factors of the
    /// single mixtures differ.
    pub deviation: f64,
    /// Mean colour error of these mixtures in CIEDE2000: as predicted, and with the factor.
    pub delta_e: [f64; 2],
}

/// A mixture that was left out, with the parts from which its film is predicted.
#[derive(Debug, Clone)]
pub(crate) struct Mixed<'a> {
    /// File of its first reading.
    pub(crate) file: &'a str,
    /// Measured reflectance of the mixture.
    pub(crate) measured: &'a [f64],
    /// White of the mixture, else the pigment with the largest share.
    pub(crate) base: PigmentId,
    /// Each pigment with its share, and its K and S by the fit of the other samples.
    pub(crate) parts: Vec<(PigmentId, f64, Curves)>,
}

/// How films of left-out mixtures are predicted and seen.
#[derive(Clone, Copy)]
pub(crate) struct Strengths<'a> {
    pub(crate) grid: Grid,
    pub(crate) surface: Surface,
    pub(crate) weights: &'a TristimulusWeights,
}

/// A factor of one pigment, or of all pigments but the base of each mixture.
#[derive(Clone, Copy)]
struct Factor {
    of: Option<PigmentId>,
    factor: f64,
}

impl Factor {
    fn is_of(self, mixed: &Mixed<'_>, pigment: PigmentId) -> bool {
        self.of.map_or(pigment != mixed.base, |one| one == pigment)
    }

    fn at(self, mixed: &Mixed<'_>, pigment: PigmentId) -> f64 {
        if self.is_of(mixed, pigment) { self.factor } else { 1.0 }
    }

    /// Whether it changes the shares of some pigments of a mixture, and not of all.
    fn changes(self, mixed: &Mixed<'_>) -> bool {
        let count = mixed.parts.iter().filter(|(id, _, _)| self.is_of(mixed, *id)).count();
        count > 0 && count < mixed.parts.len()
    }
}

impl Strengths<'_> {
    /// Film of a mixture that hides.
    pub(crate) fn film(self, mixed: &Mixed<'_>) -> Vec<f64> {
        self.film_with(mixed, &[])
    }

    /// Film of a mixture that hides, with the shares of its pigments multiplied by `factors`.
    fn film_with(self, mixed: &Mixed<'_>, factors: &[Factor]) -> Vec<f64> {
        let parts = mixed.parts.iter().map(|(pigment, share, curves)| {
            let (absorption, scattering) = curves.as_slices();
            let factor: f64 = factors.iter().map(|factor| factor.at(mixed, *pigment)).product();
            (share * factor, absorption, scattering)
        });
        Curves::weighted_sum(self.grid, parts).hiding(self.surface)
    }

    fn error(self, mixed: &Mixed<'_>, factors: &[Factor]) -> f64 {
        delta_e(self.weights, mixed.measured, &self.film_with(mixed, factors))
    }

    /// Least colour error of any common factor from 1/4 to 4 of all pigments but the base.
    pub(crate) fn least_error(self, mixed: &Mixed<'_>) -> f64 {
        self.best(mixed, &[], None).0
    }

    /// Least colour error of any factor from 1/4 to 4, and the factor's logarithm. `known` factors
    /// apply too.
    fn best(self, mixed: &Mixed<'_>, known: &[Factor], of: Option<PigmentId>) -> (f64, f64) {
        let mut factors = known.to_vec();
        factors.push(Factor { of, factor: 1.0 });
        let mut at = |log: f64| {
            factors.last_mut().expect("one was pushed").factor = log.exp();
            (self.error(mixed, &factors), log)
        };
        let range = 4f64.ln();
        let last = f64::from(STRENGTHS - 1);
        let coarse = (0..STRENGTHS).map(|i| range * (2.0 * f64::from(i) / last - 1.0));
        let mut best = coarse.map(&mut at).reduce(lower_error).expect("there are strengths");
        let mut step = range / last;
        for _ in 0..HALVINGS {
            best = [best.1 - step, best.1 + step].map(&mut at).into_iter().fold(best, lower_error);
            step /= 2.0;
        }
        best
    }

    /// Factors that the mixtures of a group have in common. Each file is a group, or two: its
    /// mixtures of two pigments, and its larger ones. In a group we look first for a factor of all
    /// pigments beside the white, then for single pigments, each time the one with the largest gain. `pigments` are the names, and `white` is the reference white.
    pub(crate) fn changes(
        self,
        mixtures: &[&Mixed<'_>],
        pigments: &[String],
        white: PigmentId,
    ) -> Vec<StrengthChange> {
        let mut groups: Vec<(&str, Vec<&Mixed<'_>>)> = Vec::new();
        for mixed in mixtures.iter().copied() {
            match groups.iter_mut().find(|(file, _)| *file == mixed.file) {
                Some((_, group)) => group.push(mixed),
                None => groups.push((mixed.file, vec![mixed])),
            }
        }
        let mut changes = Vec::new();
        for (file, group) in groups.into_iter().flat_map(|(file, group)| split(file, group)) {
            let all = self.change(&group, &[], None);
            let mut known: Vec<Factor> = all.iter().map(|change| change.factor).collect();
            changes.extend(all.map(|change| change.told(file, pigments)));
            let mut open: Vec<PigmentId> =
                (0..pigments.len()).map(PigmentId).filter(|id| *id != white).collect();
            while let Some(change) = (open.iter())
                .filter_map(|&id| self.change(&group, &known, Some(id)))
                .max_by(|a, b| a.gain().total_cmp(&b.gain()))
            {
                known.push(change.factor);
                open.retain(|id| Some(*id) != change.factor.of);
                changes.push(change.told(file, pigments));
            }
        }
        changes
    }

    fn mean_error(self, mixtures: &[&Mixed<'_>], factors: &[Factor]) -> f64 {
        let sum: f64 = mixtures.iter().map(|mixed| self.error(mixed, factors)).sum();
        sum / mixtures.len() as f64
    }

    /// The factor of some pigments that the mixtures have in common beside the `known` ones. `None`
    /// if chance explains it, or it would change little.
    fn change(
        self,
        mixtures: &[&Mixed<'_>],
        known: &[Factor],
        of: Option<PigmentId>,
    ) -> Option<Change> {
        let changed: Vec<&Mixed<'_>> = mixtures
            .iter()
            .copied()
            .filter(|mixed| Factor { of, factor: 1.0 }.changes(mixed))
            .collect();
        if changed.len() < LEAST_MIXTURES {
            return None;
        }
        // A mixture in which the strength hardly shows tells little of it.
        let [weaker, stronger] = [-STEP, STEP].map(|log| with(known, of, log));
        let weighed: Vec<(f64, f64)> = changed
            .iter()
            .map(|mixed| {
                let [low, high] =
                    [&weaker, &stronger].map(|factors| self.film_with(mixed, factors));
                let slope = delta_e(self.weights, &low, &high) / (2.0 * STEP);
                (slope * slope, self.best(mixed, known, of).1)
            })
            .collect();
        let total: f64 = weighed.iter().map(|(weight, _)| weight).sum();
        let squares: f64 = weighed.iter().map(|(weight, _)| weight * weight).sum();
        // Mixtures of unequal weight count as fewer of equal weight (Kish 1965, section 11.7).
        let effective = total * total / squares;
        // Medians, because another paint of some mixtures may differ too.
        let center = weighted_median(weighed.clone());
        let distances = weighed.iter().map(|(weight, log)| (*weight, (log - center).abs()));
        let deviation = MEDIAN_SD * weighted_median(distances.collect()) / effective.sqrt();
        let freedom = (effective - 1.0).round() as usize;
        let limit = STUDENT[freedom.checked_sub(2)?.min(STUDENT.len() - 1)];
        let factors = with(known, of, center);
        let delta_e = [known, &factors].map(|factors| self.mean_error(&changed, factors));
        let is_clear = center.abs() > limit * deviation && center.abs() > LEAST_CHANGE.ln_1p();
        (is_clear && delta_e[1] < (1.0 - LEAST_GAIN) * delta_e[0]).then_some(Change {
            factor: factors[known.len()],
            mixtures: changed.len(),
            sizes: sizes(&changed),
            deviation,
            delta_e,
        })
    }
}

/// The `known` factors and another one.
fn with(known: &[Factor], of: Option<PigmentId>, log: f64) -> Vec<Factor> {
    [known, &[Factor { of, factor: log.exp() }]].concat()
}

/// A [`StrengthChange`] without names.
#[derive(Clone, Copy)]
struct Change {
    factor: Factor,
    mixtures: usize,
    sizes: [usize; 2],
    deviation: f64,
    delta_e: [f64; 2],
}

impl Change {
    /// By how much it lowers the sum of the errors.
    fn gain(&self) -> f64 {
        self.mixtures as f64 * (self.delta_e[0] - self.delta_e[1])
    }

    fn told(self, file: &str, pigments: &[String]) -> StrengthChange {
        let Self { factor, mixtures, sizes, deviation, delta_e } = self;
        StrengthChange {
            pigment: factor.of.map(|id| pigments[id.index()].clone()),
            file: file.to_owned(),
            mixtures,
            sizes,
            factor: factor.factor,
            deviation,
            delta_e,
        }
    }
}

impl fmt::Display for StrengthChange {
    /// Writes a sentence without a full stop.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { pigment, file, mixtures, sizes, factor, deviation, delta_e } = self;
        let ([least, most], [before, after]) = (sizes, delta_e);
        let sizes = if least == most { least.to_string() } else { format!("{least} to {most}") };
        let (what, advice) = match pigment {
            Some(name) => (name.as_str(), "is this paint from another batch?"),
            None => ("everything beside the white", "was the white weighed wrongly?"),
        };
        write!(
            f,
            "in {mixtures} mixtures of {sizes} pigments ({file}), {what} acts as if there were {factor:.2} times as much (standard error {:.0} %). With this factor their mean error is {after:.2} instead of {before:.2}: {advice}",
            100.0 * deviation
        )
    }
}

/// Splits the mixtures of a file into two groups: mixtures of two pigments, which are mostly tints, and
/// mixtures of three and more. If either group would be too small, all mixtures stay together.
fn split<'a, 'b>(
    file: &'a str,
    mixtures: Vec<&'b Mixed<'a>>,
) -> Vec<(&'a str, Vec<&'b Mixed<'a>>)> {
    let (two, more): (Vec<_>, Vec<_>) = mixtures.iter().partition(|mixed| mixed.parts.len() == 2);
    if two.len() < LEAST_MIXTURES || more.len() < LEAST_MIXTURES {
        return vec![(file, mixtures)];
    }
    vec![(file, two), (file, more)]
}

/// Least and greatest number of pigments.
fn sizes(mixtures: &[&Mixed<'_>]) -> [usize; 2] {
    let counts = mixtures.iter().map(|mixed| mixed.parts.len());
    counts.fold([usize::MAX, 0], |[least, most], count| [least.min(count), most.max(count)])
}

/// The value at half of the weight. Each pair is a weight and a value.
fn weighted_median(mut pairs: Vec<(f64, f64)>) -> f64 {
    pairs.sort_by(|a, b| a.1.total_cmp(&b.1));
    let half = pairs.iter().map(|(weight, _)| weight).sum::<f64>() / 2.0;
    let mut passed = 0.0;
    let upper = pairs.iter().find(|(weight, _)| {
        passed += weight;
        passed >= half
    });
    upper.map_or(0.0, |(_, value)| *value)
}

fn lower_error(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    if b.0 < a.0 { b } else { a }
}
