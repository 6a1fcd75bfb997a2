//! Figures of a trial.

use crate::pixel_maps::{BlockMaps, Mask};

/// A pixel whose pigments are known, with what a method told of it. All lists are by pigment or group.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// True shares, sum 1.
    pub truth: Vec<f64>,
    /// Shares that were told.
    pub told: Vec<f64>,
    /// Whether each is told to be present.
    pub present: Vec<bool>,
    /// Probability that each is present; empty if the method tells none.
    pub probability: Vec<f64>,
    /// Standard deviation of each share; empty if the method tells none.
    pub sd: Vec<f64>,
    /// Chi-square per degree of freedom; NaN if the method tells none.
    pub chi2: f64,
    /// Least true share that counts as present. A trace, smaller than that, is neither right nor wrong to
    /// tell; 0 if there are no traces.
    pub least: f64,
}

impl Trial {
    /// Trial of pixel `index` of a map, whose true shares by column are `truth`. A column counts as
    /// present where its probability is one half or more.
    #[must_use]
    pub fn of_map(maps: &BlockMaps, index: usize, truth: &[f64]) -> Self {
        let columns = index * maps.pigments..(index + 1) * maps.pigments;
        let list = |values: &[f32]| -> Vec<f64> {
            values[columns.clone()].iter().map(|value| f64::from(*value)).collect()
        };
        let mapped = maps.mask[index] == Mask::Mapped;
        let probability = list(&maps.presence);
        Self {
            truth: truth.to_vec(),
            told: list(&maps.share).into_iter().map(|v| if mapped { v } else { 0.0 }).collect(),
            present: probability.iter().map(|p| *p >= 0.5).collect(),
            probability,
            sd: list(&maps.share_sd),
            chi2: f64::from(maps.chi2[index]),
            least: 0.0,
        }
    }

    /// Whether pigment `index` is present; `None` for a trace.
    #[must_use]
    pub fn is_there(&self, index: usize) -> Option<bool> {
        match self.truth[index] {
            share if share > 0.0 && share >= self.least => Some(true),
            share if share > 0.0 => None,
            _ => Some(false),
        }
    }

    /// The trial with that told to be present which has a share in the best set.
    #[must_use]
    pub fn of_best_set(&self) -> Self {
        Self { present: self.told.iter().map(|share| *share > 0.0).collect(), ..self.clone() }
    }

    /// The trial with those columns joined that have one number in `group_of`, of which there are `count`.
    /// Probabilities and deviations cannot be joined and are dropped.
    #[must_use]
    pub fn joined(&self, group_of: &[usize], count: usize) -> Self {
        let sum = |values: &[f64]| {
            let mut sums = vec![0.0; count];
            values.iter().zip(group_of).for_each(|(value, &group)| sums[group] += value);
            sums
        };
        let mut present = vec![false; count];
        self.present.iter().zip(group_of).for_each(|(&is, &group)| present[group] |= is);
        Self {
            truth: sum(&self.truth),
            told: sum(&self.told),
            present,
            probability: Vec::new(),
            sd: Vec::new(),
            chi2: self.chi2,
            least: self.least,
        }
    }
}

/// Figures of many trials.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Scores {
    /// Part of the pigments told to be present that are.
    pub precision: f64,
    /// Part of the present pigments that are told.
    pub recall: f64,
    /// Mean over pixels of half the sum of the absolute errors of the shares.
    pub share_error: f64,
}

impl Scores {
    /// Figures of `trials`.
    #[must_use]
    pub fn of<'a>(trials: impl IntoIterator<Item = &'a Trial>) -> Self {
        let mut sums = ScoreSums::default();
        trials.into_iter().for_each(|trial| sums.add(trial));
        sums.scores()
    }

    /// Harmonic mean of precision and recall.
    #[must_use]
    pub fn f1(&self) -> f64 {
        let sum = self.precision + self.recall;
        if sum > 0.0 { 2.0 * self.precision * self.recall / sum } else { 0.0 }
    }
}

impl std::fmt::Display for Scores {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { precision, recall, share_error } = self;
        write!(f, "{precision:.3} {recall:.3} {share_error:.3}")
    }
}

/// Sums over trials, which may come one after another.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ScoreSums {
    /// Number of trials.
    pub count: f64,
    /// Pigments that are told to be present and are.
    pub right: f64,
    /// Pigments that are told to be present, traces left out.
    pub told: f64,
    /// Pigments that are present.
    pub there: f64,
    /// Sum of half the absolute errors of the shares.
    pub error: f64,
}

impl ScoreSums {
    /// Adds a trial.
    pub fn add(&mut self, trial: &Trial) {
        self.count += 1.0;
        for (index, (&truth, &share)) in trial.truth.iter().zip(&trial.told).enumerate() {
            self.error += 0.5 * (truth - share).abs();
            let Some(is_there) = trial.is_there(index) else { continue };
            let told = trial.present[index];
            self.there += f64::from(u8::from(is_there));
            self.told += f64::from(u8::from(told));
            self.right += f64::from(u8::from(told && is_there));
        }
    }

    /// Figures of all trials so far.
    #[must_use]
    pub fn scores(&self) -> Scores {
        let part = |value: f64, of: f64| if of > 0.0 { value / of } else { 0.0 };
        Scores {
            precision: part(self.right, self.told),
            recall: part(self.right, self.there),
            share_error: part(self.error, self.count),
        }
    }
}

/// Told probabilities of one range, with the part of them that is true.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reliability {
    /// Least probability of the range.
    pub from: f64,
    /// Number of probabilities in it.
    pub count: usize,
    /// Mean of these probabilities.
    pub told: f64,
    /// Part of them where the pigment is present.
    pub true_part: f64,
}

/// Reliability of the probabilities of `trials` in ranges that begin at `ends` and end before the next.
#[must_use]
pub fn reliability<'a>(
    trials: impl IntoIterator<Item = &'a Trial> + Clone,
    ends: &[f64],
) -> Vec<Reliability> {
    let range = |index: usize| {
        let from = ends[index];
        let to = ends.get(index + 1).copied().unwrap_or(f64::INFINITY);
        let mut count = 0;
        let mut told = 0.0;
        let mut is_true = 0.0;
        for trial in trials.clone() {
            for (index, &probability) in trial.probability.iter().enumerate() {
                if let (Some(is_there), true) =
                    (trial.is_there(index), (from..to).contains(&probability))
                {
                    count += 1;
                    told += probability;
                    is_true += f64::from(u8::from(is_there));
                }
            }
        }
        let of = (count as f64).max(1.0);
        Reliability { from, count, told: told / of, true_part: is_true / of }
    };
    (0..ends.len()).map(range).collect()
}

/// How often shares lie within their standard deviation of the truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// Number of shares.
    pub count: usize,
    /// Part of them within one standard deviation.
    pub within: f64,
}

/// Coverage of the shares of all that is told to be present. Films of one column alone are left out,
/// because their share is 1 by definition.
#[must_use]
pub fn coverage<'a>(trials: impl IntoIterator<Item = &'a Trial>) -> Coverage {
    let mut count = 0;
    let mut within = 0;
    for trial in trials {
        let (more, inside) = covered(trial);
        count += more;
        within += inside;
    }
    Coverage { count, within: within as f64 / (count as f64).max(1.0) }
}

/// Number of shares of one trial that [`coverage`] counts, and of those within one standard deviation.
#[must_use]
pub fn covered(trial: &Trial) -> (usize, usize) {
    let alone = trial.present.iter().filter(|is| **is).count() < 2;
    let counted = (0..trial.sd.len()).filter(|&index| trial.present[index] && !alone);
    let is_within =
        |&index: &usize| (trial.truth[index] - trial.told[index]).abs() <= trial.sd[index];
    let counted: Vec<usize> = counted.collect();
    (counted.len(), counted.iter().filter(|index| is_within(index)).count())
}
