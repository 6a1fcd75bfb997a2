//! Trials with the Van Gogh oils, whose readings ship with impasto.

#![expect(clippy::result_large_err, reason = "the error of calibrate, as its own calls return it")]

use std::ops::ControlFlow;

use calibrate::fit::Watch;
use calibrate::observation::BelowSurface;
use calibrate::{FitOptions, FittingError, PreparedFit, Readings};
use pigment::library::PigmentLibrary;

use crate::accuracy::scores::Trial;
use crate::accuracy::simulated::{BesideTruth, Painting, PaintingPlan};
use crate::films::settings::{MapSettings, PigmentGroup};
use crate::map_error::MapError;
use crate::mapping::mapper::Mapper;

/// Groups of the Van Gogh oils that look alike from 400 to 700 nm, for which figures are told.
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

/// Eight of the Van Gogh oils that a painter sets out, without black and Prussian blue, in whose mixtures
/// other pigments hardly show.
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

/// Readings of the Van Gogh oils with the options by which their library is fitted.
///
/// # Errors
/// [`FittingError`] if `readings` are others.
pub fn prepared_oils(readings: &Readings) -> Result<PreparedFit, FittingError> {
    let below_surface = Some(BelowSurface::Floor);
    PreparedFit::new(
        readings,
        &FitOptions { below_surface, ..FitOptions::default() },
        Watch::default(),
    )
}

/// Trials of simulated paintings of several seeds.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PaintingTrials {
    /// Trials of pixels that were searched whole.
    pub searched: Vec<Trial>,
    /// Trials of pixels that were mapped with a survey.
    pub mapped: Vec<Trial>,
    /// Best set of each searched pixel beside its true pigments.
    pub beside: Vec<BesideTruth>,
    /// Tone of each pixel: 0 dark, 1 middle, 2 light.
    pub tones: Vec<usize>,
}

impl PaintingTrials {
    /// Part of the pixels in which the search ended at a worse score than the true pigments have.
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

/// Ends of dark and of middle paint, in mean reflectance.
const TONES: [f32; 2] = [0.1, 0.3];

/// Tone of a mean reflectance: 0 dark, below 0.1; 1 middle; 2 light, 0.3 or more.
#[must_use]
pub fn tone(mean_reflectance: f32) -> usize {
    TONES.iter().filter(|end| mean_reflectance >= **end).count()
}

/// Knowledge of the pigments that a painting holds, beside the library.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Told {
    /// No pigment of it is named.
    Nothing,
    /// All its pigments are named, and no others.
    Palette,
}

/// Paints one painting of `plan` for each of `seeds` with the pigments of `real`, and maps it with the library
/// `known`, `settings`, and the palette of the painting if it is told.
///
/// # Errors
/// [`MapError`] if library and settings cannot be used.
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
        let book = mapper.survey(&painting.spectra, &|| ControlFlow::Continue(()))?;
        let maps = mapper.map_block(&book, &painting.spectra)?;
        trials.mapped.extend(painting.trials(&mapper, &maps));
        trials.beside.extend(painting.beside_truth(&mapper)?);
        let tones = (0..painting.truth.len()).map(|index| tone(painting.mean_reflectance(index)));
        trials.tones.extend(tones);
    }
    Ok(trials)
}

/// Trials of pixels with one pigment that the library lacks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Missing {
    /// Median chi-square per degree of freedom of pixels without the pigment, and of those with it.
    pub chi2: [f64; 2],
    /// Part of the pixels with it whose chi-square exceeds that of nineteen of twenty without it.
    pub noticed: f64,
    /// Mean number of pigments that are told to be present but are not, in pixels without the missing one,
    /// and with it.
    pub false_presences: [f64; 2],
}

/// Maps paintings as [`painting_trials`] does, with a library that lacks one pigment of each: the first that is
/// in no group of `settings`, because another of its group would take its place.
///
/// # Errors
/// [`MapError`] if library and settings cannot be used.
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
        let alike = |name: &String| settings.groups.iter().any(|g| g.pigments.contains(name));
        let Some(lacking) = painting.pigments.iter().position(|name| !alike(name)) else {
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
    let at = |values: &[f64], part: f64| {
        let place = (part * values.len() as f64) as usize;
        values.get(place.min(values.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
    };
    let usual = at(&chi2[0], 0.95);
    let count = |with: usize| chi2[with].len().max(1) as f64;
    Ok(Missing {
        chi2: [at(&chi2[0], 0.5), at(&chi2[1], 0.5)],
        noticed: chi2[1].iter().filter(|value| **value > usual).count() as f64 / count(1),
        false_presences: [wrong[0] / count(0), wrong[1] / count(1)],
    })
}
