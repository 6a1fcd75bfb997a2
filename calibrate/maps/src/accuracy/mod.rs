//! How far you can believe maps. We test them on measured mixtures and simulated paintings, because
//! we know their pigments.
//!
//! We have no scan of a painting with known pigments. These trials use measured swatches as pixels,
//! each with a library that was fitted without it, and simulated pixels with K and S that differ
//! from the library. They also run common linear methods for comparison. The readings are the Van
//! Gogh oils that ship with impasto.

#![expect(clippy::result_large_err, reason = "the error of calibrate, as its own calls return it")]
mod trials;

use calibrate::observation::BelowSurface;
use calibrate::{FitRequest, FittingError, LeftOut, PreparedFit, Readings, Residuals};
use documents::Task;
use pigment::library::PigmentLibrary;

use crate::films::settings::{MapSettings, ModelError, PigmentGroup};
use crate::mapping::Mapper;
use crate::pixel_maps::MapError;

pub use trials::{
    Baseline, BesideTruth, Coverage, Painting, PaintingPlan, Reliability, ScoreSums, Scores, Trial,
    Unmixed, coverage, covered, reliability,
};

/// Pigments and their groups in the trials. A pigment outside the named groups is a group by
/// itself.
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
        let group_of = pigments
            .iter()
            .map(|name: &String| {
                let named = groups.iter().position(|group| group.pigments.contains(name));
                named.unwrap_or_else(|| {
                    count += 1;
                    count - 1
                })
            })
            .collect();
        Self { pigments, group_of, count }
    }

    /// Makes a list with a value for each pigment from pairs of name and value. Values of one name
    /// are summed.
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
    /// Trials in which each pigment counts by itself.
    pub pigments: Vec<Trial>,
    /// Trials in which each group counts as one pigment.
    pub groups: Vec<Trial>,
}

impl SwatchTrials {
    /// Trials by the linear method `baseline`. A pigment counts as found if its share is above
    /// `least`.
    #[must_use]
    pub fn baseline(
        samples: &[LeftOut],
        named: &NamedGroups,
        baseline: Baseline,
        least: f64,
    ) -> Self {
        let pigments: Vec<Trial> = samples
            .iter()
            .filter_map(|sample: &LeftOut| -> Option<Trial> {
                let library = &sample.library;
                let nm: Vec<f64> = library.grid.wavelengths_nm().collect();
                let bands = crate::films::bands::Bands::new(&nm, library.grid).ok()?;
                let paints = crate::films::film::Paints::new(library, &[], &bands).ok()?;
                let shares = baseline.unmix(&paints, &sample.mixture.measured).shares;
                let told = named.list(paints.names.iter().map(String::as_str).zip(shares));
                let truth = named.list(true_shares(sample));
                let present = told.iter().map(|share| *share > least).collect();
                let probability = Vec::new();
                let sd = Vec::new();
                Some(Trial { truth, told, present, probability, sd, chi2: f64::NAN, least: 0.0 })
            })
            .collect();
        let groups = pigments.iter().map(|t| t.joined(&named.group_of, named.count)).collect();
        Self { pigments, groups }
    }
}

/// Pigments of a sample with their shares.
fn true_shares(sample: &LeftOut) -> impl Iterator<Item = (&str, f64)> {
    sample.mixture.shares.iter().map(|(name, share)| (name.as_str(), *share))
}

/// Errors of the predictions for `samples`, or `None` if you pass no samples.
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

/// Maps each of `samples` with its own library and the residuals of all others, once by single
/// pigment and once by `groups`.
pub fn swatch_trials(
    samples: &[LeftOut],
    settings: &MapSettings,
    groups: &[PigmentGroup],
) -> Result<SwatchTrials, MapError> {
    use rayon::prelude::*;
    let named = NamedGroups::of(samples, groups);
    let found: Vec<(Trial, Trial)> = (0..samples.len())
        .into_par_iter()
        .map(|index: usize| -> Result<(Trial, Trial), MapError> {
            let sample = &samples[index];
            let others = samples.iter().enumerate().filter(|(other, _)| *other != index);
            let residuals = residuals_of(others.map(|(_, sample)| sample));
            let library = &sample.library;
            let nm: Vec<f64> = library.grid.wavelengths_nm().collect();
            let spectrum: Vec<f32> = sample.mixture.measured.iter().map(|r| *r as f32).collect();
            let alone = MapSettings {
                groups: Vec::new(),
                group_alike: false,
                model_error: settings.model_error.clone().or(residuals.map(ModelError::Residuals)),
                ..settings.clone()
            };
            let truth = named.list(true_shares(sample));
            let single = Mapper::new(library, &nm, &alone)?;
            let maps = single.search(&spectrum)?;
            let plain = Trial::of_map(&maps, 0, &vec![0.0; maps.pigments]);
            let list = |values: &[f64]| {
                let names = single.columns().iter().map(|column| column.name.as_str());
                named.list(names.zip(values.iter().copied()))
            };
            let pigments = Trial {
                truth: truth.clone(),
                told: list(&plain.told),
                present: list(&plain.probability).iter().map(|p| *p >= 0.5).collect(),
                probability: list(&plain.probability),
                sd: list(&plain.sd),
                chi2: plain.chi2,
                least: 0.0,
            };
            let joined = MapSettings { groups: groups.to_vec(), ..alone };
            let joined = Mapper::new(library, &nm, &joined)?;
            let maps = joined.search(&spectrum)?;
            let plain = Trial::of_map(&maps, 0, &vec![0.0; maps.pigments]);
            let mut sums = vec![0.0; named.count];
            truth.iter().zip(&named.group_of).for_each(|(share, &group)| sums[group] += share);
            let by_group = |values: &[f64]| {
                let mut list = vec![0.0; named.count];
                for (column, value) in joined.columns().iter().zip(values) {
                    let place =
                        named.pigments.iter().position(|known| *known == column.pigments[0]);
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
        })
        .collect::<Result<_, _>>()?;
    let (pigments, groups) = found.into_iter().unzip();
    Ok(SwatchTrials { pigments, groups })
}

/// Trials after we chose the penalty of each fold on the other folds.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Trials, each with the penalty that suits the other folds best.
    pub trials: SwatchTrials,
    /// Penalty of each fold.
    pub penalties: Vec<f64>,
}

/// Puts together trials of several penalties, so that no swatch takes part in the choice of its own
/// penalty. Swatch `i` is in fold `i` modulo `folds`. It takes the penalty with the best harmonic
/// mean of precision and recall, of pigments and groups alike, in the other folds.
#[must_use]
pub fn choose_penalty(of_penalty: &[(f64, SwatchTrials)], folds: usize) -> Choice {
    let count = of_penalty.first().map_or(0, |(_, trials)| trials.groups.len());
    let mut trials = SwatchTrials { pigments: Vec::new(), groups: Vec::new() };
    let chosen: Vec<usize> = (0..folds)
        .map(|fold: usize| {
            (0..of_penalty.len())
                .reduce(|a: usize, b: usize| {
                    let [of_a, of_b] = [a, b].map(|at| f1_without(&of_penalty[at].1, folds, fold));
                    if of_b > of_a { b } else { a }
                })
                .unwrap_or(0)
        })
        .collect();
    for index in 0..count {
        let (_, own) = &of_penalty[chosen[index % folds]];
        trials.pigments.push(own.pigments[index].clone());
        trials.groups.push(own.groups[index].clone());
    }
    Choice { trials, penalties: chosen.iter().map(|&index| of_penalty[index].0).collect() }
}

fn f1_without(trials: &SwatchTrials, folds: usize, fold: usize) -> f64 {
    let [groups, pigments] = [&trials.groups, &trials.pigments].map(|list| {
        let kept = list.iter().enumerate().filter(|(index, _)| index % folds != fold);
        Scores::of(kept.map(|(_, trial)| trial)).f1()
    });
    groups + pigments
}

/// Groups of Van Gogh oils that look alike from 400 to 700 nm. Trials by group count each as one
/// pigment.
#[must_use]
pub fn oil_groups() -> Vec<PigmentGroup> {
    let whites = ["Zinc White", "Lead White", "Barium Sulphate", "Calcium Carbonate"];
    let lakes = ["Eosin Lake (wax)", "Eosin Lake", "Eosin Lake (lead, wax)", "Cochineal Lake"];
    let chromes = ["Chrome Yellow", "Chrome Yellow (Otero)"];
    let named = [("whites", &whites[..]), ("red lakes", &lakes), ("chrome yellows", &chromes)];
    named
        .into_iter()
        .map(|(name, pigments): (&str, &[&str])| PigmentGroup {
            name: name.to_owned(),
            pigments: pigments.iter().map(|&name| name.to_owned()).collect(),
        })
        .collect()
}

/// Eight of the Van Gogh oils that a painter would set out. We leave out black and Prussian blue,
/// because other pigments hardly show in mixtures with them.
#[must_use]
pub fn light_palette() -> Vec<String> {
    let names = [
        "Zinc White",
        "Chrome Yellow",
        "Minium",
        "Vermilion",
        "Viridian",
        "Emerald Green",
        "Cobalt Blue",
        "Ultramarine",
    ];
    names.map(str::to_owned).to_vec()
}

/// Prepares the readings of the Van Gogh oils with the options that we fit their library with.
///
/// # Errors
/// [`FittingError`] if `readings` are of other paints.
pub fn prepared_oils(readings: &Readings) -> Result<PreparedFit, FittingError> {
    let below_surface = Some(BelowSurface::Floor);
    PreparedFit::new(
        readings,
        &FitRequest { below_surface, ..FitRequest::default() },
        &Task::default(),
    )
}

/// Trials of simulated paintings of several seeds.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PaintingTrials {
    /// Trials of a full search of each pixel.
    pub searched: Vec<Trial>,
    /// Trials of maps that we made with a survey.
    pub mapped: Vec<Trial>,
    /// For each searched pixel, its best set compared with its true pigments.
    pub beside: Vec<BesideTruth>,
    /// Tone of each pixel: 0 dark, 1 middle, 2 light.
    pub tones: Vec<usize>,
}

impl PaintingTrials {
    /// Share of the pixels where the search missed a better set: its best score is worse than the
    /// score of the true pigments.
    #[must_use]
    pub fn worse(&self) -> f64 {
        let worse = self.beside.iter().filter(|beside| beside.is_worse).count();
        worse as f64 / self.beside.len().max(1) as f64
    }

    /// Mapped trials of one tone.
    pub fn of_tone(&self, tone: usize) -> impl Iterator<Item = &Trial> + Clone {
        let pairs = self.mapped.iter().zip(&self.tones);
        pairs.filter(move |(_, own)| **own == tone).map(|(trial, _)| trial)
    }
}

/// Mean reflectance where dark paint ends, and where middle paint ends.
const TONES: [f32; 2] = [0.1, 0.3];

/// Tone of a mean reflectance: 0 dark, below 0.1; 1 middle; 2 light, 0.3 or more.
#[must_use]
pub fn tone(mean_reflectance: f32) -> usize {
    TONES.iter().filter(|end| mean_reflectance >= **end).count()
}

/// How much we know of the pigments in a painting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Told {
    /// We know no pigment of it.
    Nothing,
    /// We know all its pigments.
    Palette,
}

/// Simulates a painting of `plan` for each of `seeds` with the pigments of `real`, and maps it with
/// the library `known` and `settings`. With [`Told::Palette`] the map also knows the palette of the
/// painting.
pub fn painting_trials(
    (real, known): (&PigmentLibrary, &PigmentLibrary),
    plan: &PaintingPlan,
    seeds: std::ops::Range<u64>,
    (settings, told): (&MapSettings, Told),
) -> Result<PaintingTrials, MapError> {
    let nm: Vec<f64> = real.grid.wavelengths_nm().collect();
    let mut trials = PaintingTrials::default();
    for seed in seeds {
        let painting = Painting::simulate(real, known, &PaintingPlan { seed, ..plan.clone() });
        let palette = match told {
            Told::Nothing => settings.palette.clone(),
            Told::Palette => painting.pigments.clone(),
        };
        let mapper = Mapper::new(known, &nm, &MapSettings { palette, ..settings.clone() })?;
        trials.searched.extend(painting.trials(&mapper, &mapper.search(&painting.spectra)?));
        let book = mapper.survey(&painting.spectra, &Task::default())?;
        let maps = mapper.map_block(&book, &painting.spectra)?;
        trials.mapped.extend(painting.trials(&mapper, &maps));
        trials.beside.extend(painting.beside_truth(&mapper)?);
        let tones = (0..painting.truth.len()).map(|index| tone(painting.mean_reflectance(index)));
        trials.tones.extend(tones);
    }
    Ok(trials)
}

/// Trials of pixels with a pigment that the library lacks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Missing {
    /// Median chi-square per degree of freedom, first of pixels without the pigment, then of pixels
    /// with it.
    pub chi2: [f64; 2],
    /// Share of the pixels containing the pigment that have a chi-square above the 95th percentile of
    /// pixels without it.
    pub noticed: f64,
    /// Mean number of pigments that the map wrongly finds in a pixel, first in pixels without the
    /// missing one, then with it.
    pub false_presences: [f64; 2],
}

/// Maps paintings as [`painting_trials`] does, but with a library that lacks one pigment of each
/// painting. We leave out the first pigment that is in no group of `settings`, because another
/// pigment of its group would take its place.
pub fn missing_pigment(
    library: &PigmentLibrary,
    plan: &PaintingPlan,
    seeds: std::ops::Range<u64>,
    settings: &MapSettings,
) -> Result<Missing, MapError> {
    let nm: Vec<f64> = library.grid.wavelengths_nm().collect();
    let mut chi2 = [Vec::new(), Vec::new()];
    let mut wrong = [0.0, 0.0];
    for seed in seeds {
        let painting = Painting::simulate(library, library, &PaintingPlan { seed, ..plan.clone() });
        let Some(lacking) = painting.pigments.iter().position(|name: &String| {
            !settings.groups.iter().any(|group| group.pigments.contains(name))
        }) else {
            continue;
        };
        let missing = &painting.pigments[lacking];
        let known = library.pigments.iter().filter(|p| p.identified && p.name != *missing);
        let palette = known.map(|pigment| pigment.name.clone()).collect();
        let mapper = Mapper::new(library, &nm, &MapSettings { palette, ..settings.clone() })?;
        let maps = mapper.search(&painting.spectra)?;
        for (trial, truth) in painting.trials(&mapper, &maps).iter().zip(&painting.truth) {
            let with = usize::from(truth.iter().any(|(place, _)| *place == lacking));
            chi2[with].push(trial.chi2);
            let pairs = trial.present.iter().zip(&trial.truth);
            wrong[with] +=
                pairs.filter(|(present, truth)| **present && **truth == 0.0).count() as f64;
        }
    }
    chi2.iter_mut().for_each(|values| values.sort_by(f64::total_cmp));
    let usual = at_share(&chi2[0], 0.95);
    let counts = [&chi2[0], &chi2[1]].map(|values| values.len().max(1) as f64);
    Ok(Missing {
        chi2: [at_share(&chi2[0], 0.5), at_share(&chi2[1], 0.5)],
        noticed: chi2[1].iter().filter(|value| **value > usual).count() as f64 / counts[1],
        false_presences: [wrong[0] / counts[0], wrong[1] / counts[1]],
    })
}

fn at_share(values: &[f64], part: f64) -> f64 {
    let place = (part * values.len() as f64) as usize;
    values.get(place.min(values.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
}
