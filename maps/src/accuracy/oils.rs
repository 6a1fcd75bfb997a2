//! Trials with the Van Gogh oils, whose readings ship with impasto.

#![expect(clippy::result_large_err, reason = "the error of calibrate, as its own calls return it")]

use std::ops::ControlFlow;

use calibrate::fit::Watch;
use calibrate::observation::BelowSurface;
use calibrate::{FitOptions, FittingError, PreparedFit, Readings};
use pigment::library::PigmentLibrary;

use crate::accuracy::scores::Trial;
use crate::accuracy::simulated::{Painting, PaintingPlan};
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
    let group = |(name, pigments): (&str, &[&str])| PigmentGroup {
        name: name.to_owned(),
        pigments: pigments.iter().map(|&name| name.to_owned()).collect(),
    };
    named.into_iter().map(group).collect()
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
#[derive(Debug, Clone, PartialEq)]
pub struct PaintingTrials {
    /// Trials of pixels that were searched whole.
    pub searched: Vec<Trial>,
    /// Trials of pixels that were mapped with a survey.
    pub mapped: Vec<Trial>,
    /// Part of the pixels in which the search ended at a worse score than the true pigments have.
    pub worse: f64,
}

/// Paints one painting of `plan` for each of `seeds` with the pigments of `real`, and maps it with the library
/// `known` and `settings`.
///
/// # Errors
/// [`MapError`] if library and settings cannot be used.
pub fn painting_trials(
    (real, known): (&PigmentLibrary, &PigmentLibrary),
    plan: &PaintingPlan,
    seeds: std::ops::Range<u64>,
    settings: &MapSettings,
) -> Result<PaintingTrials, MapError> {
    let nm: Vec<f64> = real.grid.wavelengths_nm().collect();
    let mapper = Mapper::new(known, &nm, settings)?;
    let (mut searched, mut mapped, mut worse) = (Vec::new(), Vec::new(), 0.0);
    let count = (seeds.end - seeds.start).max(1) as f64;
    for seed in seeds {
        let painting = Painting::simulate(real, known, &PaintingPlan { seed, ..plan.clone() });
        searched.extend(painting.trials(&mapper, &mapper.search(&painting.spectra)?));
        let book = mapper.survey(&painting.spectra, &|| ControlFlow::Continue(()))?;
        mapped.extend(painting.trials(&mapper, &mapper.map_block(&book, &painting.spectra)?));
        worse += painting.search_worse_than_truth(&mapper)? / count;
    }
    Ok(PaintingTrials { searched, mapped, worse })
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
    let (mut chi2, mut wrong) = ([Vec::new(), Vec::new()], [0.0, 0.0]);
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
