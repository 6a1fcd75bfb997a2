//! Measured mixtures as pixels, each with a library that was fitted without it.

use calibrate::{LeftOut, Residuals};

use crate::accuracy::baselines::Baseline;
use crate::accuracy::scores::{Scores, Trial};
use crate::films::noise::ModelError;
use crate::films::settings::{MapSettings, PigmentGroup};
use crate::map_error::MapError;
use crate::mapping::mapper::Mapper;

/// Groups by name; every other pigment is by itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedGroups {
    /// Names of all pigments of the trials.
    pub pigments: Vec<String>,
    /// Group of each pigment.
    pub group_of: Vec<usize>,
    /// Number of groups.
    pub count: usize,
}

impl NamedGroups {
    /// Groups of all pigments of `samples`.
    #[must_use]
    pub fn of(samples: &[LeftOut], groups: &[PigmentGroup]) -> Self {
        let mut pigments: Vec<String> = Vec::new();
        for pigment in samples.iter().flat_map(|sample| &sample.library.pigments) {
            if pigment.identified && !pigments.contains(&pigment.name) {
                pigments.push(pigment.name.clone());
            }
        }
        let mut count = groups.len();
        let mut group = |name: &String| {
            let named = groups.iter().position(|group| group.pigments.contains(name));
            named.unwrap_or_else(|| {
                count += 1;
                count - 1
            })
        };
        let group_of = pigments.iter().map(&mut group).collect();
        Self { pigments, group_of, count }
    }

    /// Values by name as a list by pigment.
    fn list<'a>(&self, values: impl IntoIterator<Item = (&'a str, f64)>) -> Vec<f64> {
        let mut list = vec![0.0; self.pigments.len()];
        for (name, value) in values {
            if let Some(place) = self.pigments.iter().position(|known| known == name) {
                list[place] += value;
            }
        }
        list
    }
}

/// Trials of all swatches by one method.
#[derive(Debug, Clone, PartialEq)]
pub struct SwatchTrials {
    /// Trials by single pigment.
    pub pigments: Vec<Trial>,
    /// Trials by group.
    pub groups: Vec<Trial>,
}

impl SwatchTrials {
    /// Trials by a baseline, which tells each pigment of a share above `least` as present.
    #[must_use]
    pub fn baseline(
        samples: &[LeftOut],
        named: &NamedGroups,
        baseline: Baseline,
        least: f64,
    ) -> Self {
        let trial = |sample: &LeftOut| -> Option<Trial> {
            let library = &sample.library;
            let nm: Vec<f64> = library.grid.wavelengths_nm().collect();
            let bands = crate::films::bands::Bands::new(&nm, library.grid).ok()?;
            let paints = crate::films::paints::Paints::new(library, &[], &bands).ok()?;
            let shares = baseline.unmix(&paints, &sample.mixture.measured).shares;
            let told = named.list(paints.names.iter().map(String::as_str).zip(shares));
            let truth = named.list(true_shares(sample));
            let present = told.iter().map(|share| *share > least).collect();
            let probability = Vec::new();
            let sd = Vec::new();
            Some(Trial { truth, told, present, probability, sd, chi2: f64::NAN, least: 0.0 })
        };
        let pigments: Vec<Trial> = samples.iter().filter_map(trial).collect();
        let groups = pigments.iter().map(|t| t.joined(&named.group_of, named.count)).collect();
        Self { pigments, groups }
    }
}

/// Pigments of a sample with their shares.
fn true_shares(sample: &LeftOut) -> impl Iterator<Item = (&str, f64)> {
    sample.mixture.shares.iter().map(|(name, share)| (name.as_str(), *share))
}

/// Errors of the predictions for `samples`; `None` if there are none.
#[must_use]
pub fn residuals_of<'a>(samples: impl IntoIterator<Item = &'a LeftOut>) -> Option<Residuals> {
    let mut samples = samples.into_iter().peekable();
    let library = &samples.peek()?.library;
    Some(Residuals {
        grid: library.grid,
        saunderson: library.saunderson,
        settings: library.settings.clone().unwrap_or_default(),
        folds: None,
        inputs: Vec::new(),
        mixtures: samples.map(|sample| sample.mixture.clone()).collect(),
    })
}

/// Maps each of `samples` with its own library and the residuals of all others: by single pigment, and by the
/// groups `groups`.
///
/// # Errors
/// [`MapError`] if a library cannot be used.
pub fn swatch_trials(
    samples: &[LeftOut],
    settings: &MapSettings,
    groups: &[PigmentGroup],
) -> Result<SwatchTrials, MapError> {
    use rayon::prelude::*;
    let named = NamedGroups::of(samples, groups);
    let trial = |index: usize| -> Result<(Trial, Trial), MapError> {
        let sample = &samples[index];
        let others = samples.iter().enumerate().filter(|(other, _)| *other != index);
        let residuals = residuals_of(others.map(|(_, sample)| sample));
        let library = &sample.library;
        let nm: Vec<f64> = library.grid.wavelengths_nm().collect();
        let spectrum: Vec<f32> = sample.mixture.measured.iter().map(|r| *r as f32).collect();
        let own = |groups: &[PigmentGroup]| MapSettings {
            groups: groups.to_vec(),
            group_alike: false,
            model_error: settings
                .model_error
                .clone()
                .or(residuals.clone().map(ModelError::Residuals)),
            ..settings.clone()
        };
        let truth = named.list(true_shares(sample));
        let single = Mapper::new(library, &nm, &own(&[]))?;
        let maps = single.search(&spectrum)?;
        let names = || single.columns().iter().map(|column| column.name.as_str());
        let plain = Trial::of_map(&maps, 0, &vec![0.0; maps.pigments]);
        let list = |values: &[f64]| named.list(names().zip(values.iter().copied()));
        let pigments = Trial {
            truth: truth.clone(),
            told: list(&plain.told),
            present: list(&plain.probability).iter().map(|p| *p >= 0.5).collect(),
            probability: list(&plain.probability),
            sd: list(&plain.sd),
            chi2: plain.chi2,
            least: 0.0,
        };
        let joined = Mapper::new(library, &nm, &own(groups))?;
        let maps = joined.search(&spectrum)?;
        let plain = Trial::of_map(&maps, 0, &vec![0.0; maps.pigments]);
        let mut sums = vec![0.0; named.count];
        truth.iter().zip(&named.group_of).for_each(|(share, &group)| sums[group] += share);
        let by_group = |values: &[f64]| {
            let mut list = vec![0.0; named.count];
            for (column, value) in joined.columns().iter().zip(values) {
                let place = named.pigments.iter().position(|known| *known == column.pigments[0]);
                list[place.map_or(0, |place| named.group_of[place])] = *value;
            }
            list
        };
        let groups = Trial {
            truth: sums,
            told: by_group(&plain.told),
            present: by_group(&plain.probability).iter().map(|p| *p >= 0.5).collect(),
            probability: by_group(&plain.probability),
            sd: by_group(&plain.sd),
            chi2: plain.chi2,
            least: 0.0,
        };
        Ok((pigments, groups))
    };
    let found: Vec<(Trial, Trial)> =
        (0..samples.len()).into_par_iter().map(trial).collect::<Result<_, _>>()?;
    let (pigments, groups) = found.into_iter().unzip();
    Ok(SwatchTrials { pigments, groups })
}

/// Trials with the penalty of each fold chosen on the other folds.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Trials, each with the penalty that suits the other folds best.
    pub trials: SwatchTrials,
    /// Penalty of each fold.
    pub penalties: Vec<f64>,
}

/// Puts together trials of several penalties, so that no swatch takes part in the choice of its own: swatch
/// `i` is in fold `i` modulo `folds`, and takes the penalty whose mean of precision and recall (harmonic), of
/// pigments and groups alike, is greatest in the other folds.
#[must_use]
pub fn choose_penalty(of_penalty: &[(f64, SwatchTrials)], folds: usize) -> Choice {
    let count = of_penalty.first().map_or(0, |(_, trials)| trials.groups.len());
    let mut trials = SwatchTrials { pigments: Vec::new(), groups: Vec::new() };
    let value = |trials: &SwatchTrials, fold: usize| {
        let others = |list: &[Trial]| {
            let kept = list.iter().enumerate().filter(|(index, _)| index % folds != fold);
            Scores::of(kept.map(|(_, trial)| trial)).f1()
        };
        others(&trials.groups) + others(&trials.pigments)
    };
    let best = |fold: usize| {
        (0..of_penalty.len())
            .reduce(|a: usize, b: usize| {
                if value(&of_penalty[b].1, fold) > value(&of_penalty[a].1, fold) { b } else { a }
            })
            .unwrap_or(0)
    };
    let chosen: Vec<usize> = (0..folds).map(best).collect();
    for index in 0..count {
        let (_, own) = &of_penalty[chosen[index % folds]];
        trials.pigments.push(own.pigments[index].clone());
        trials.groups.push(own.groups[index].clone());
    }
    Choice { trials, penalties: chosen.iter().map(|&index| of_penalty[index].0).collect() }
}
