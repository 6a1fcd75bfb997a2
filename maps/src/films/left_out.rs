//! Measured mixtures with libraries that were fitted without them.

#![expect(clippy::result_large_err, reason = "the error of calibrate, as its own calls return it")]

use calibrate::calibration::{CalibrationError, calibrate};
use calibrate::observation::{Observation, observations};
use calibrate::swatch::{Swatch, SwatchSet};
use calibrate::{FilmModel, FittingError, PreparedFit};
use pigment::library::PigmentLibrary;
use pigment::{PigmentId, Recipe};
use rayon::prelude::*;
use spectra::Grid;
use spectra::optics::Surface;

/// A measured mixture, and a library that was fitted to all other samples.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    /// Name of the sample.
    pub sample: String,
    /// Names of its pigments with their shares, whose sum is 1.
    pub shares: Vec<(String, f64)>,
    /// Reflectance of the paint in a film that hides, 0 to 1, on the library's grid.
    pub reflectance: Vec<f64>,
    /// Reflectance that the library predicts for its recipe.
    pub predicted: Vec<f64>,
    /// Library fitted without the sample.
    pub library: PigmentLibrary,
}

/// Leaves out each mixture of two pigments or more in turn, on all cores. `progress` is called after each,
/// from any thread. Mixtures without which the rest cannot be fitted, or a pigment's K or S would be
/// unknown, are passed over, as are readings of absolute amounts, whose films do not hide.
///
/// # Errors
/// [`FittingError`] if readings cannot be used.
pub fn left_out(
    prepared: &PreparedFit,
    progress: &(dyn Fn() + Sync),
) -> Result<Vec<LeftOut>, FittingError> {
    let FilmModel::Relative { reference, surface } = prepared.model else {
        return Ok(Vec::new());
    };
    let set = &prepared.set;
    let below = prepared.settings.below_surface;
    let all = observations(set, surface, below).map_err(CalibrationError::from)?;
    let candidates: Vec<usize> = (0..all.len())
        .filter(|&index| all[index].shares.iter().filter(|share| **share > 0.0).count() > 1)
        .collect();
    let found = candidates.par_iter().map(|&index| {
        let one = without(prepared, (reference, surface), &all[index], |swatch| {
            swatch.sample != set.swatches[index].sample
        });
        progress();
        one
    });
    let found: Vec<Option<LeftOut>> = found.collect::<Result<_, FittingError>>()?;
    Ok(found.into_iter().flatten().collect())
}

/// Fits the samples that `keep` selects, and predicts `target`; `None` if a pigment of `target` is not known.
fn without(
    prepared: &PreparedFit,
    (reference, surface): (PigmentId, Surface),
    target: &Observation,
    keep: impl Fn(&Swatch) -> bool,
) -> Result<Option<LeftOut>, FittingError> {
    let SwatchSet { pigments, .. } = &prepared.set;
    let white = &pigments[reference.index()];
    let rest = prepared.set.retaining(keep);
    let Some(place) = rest.pigments.iter().position(|name| name == white) else { return Ok(None) };
    let (settings, viewing) = (&prepared.settings, prepared.viewing());
    let library = match calibrate(&rest, PigmentId(place), surface, settings, viewing) {
        Ok(calibration) => calibration.library,
        Err(CalibrationError::Fit(_)) => return Ok(None),
        Err(error) => return Err(error.into()),
    };
    let present = pigments.iter().zip(&target.shares).filter(|(_, share)| **share > 0.0);
    let shares: Vec<(String, f64)> = present.map(|(name, share)| (name.clone(), *share)).collect();
    let ids = shares.iter().map(|(name, share)| Some((library.find(name).ok()?, *share)));
    let Some(parts) = ids.collect::<Option<Vec<_>>>() else { return Ok(None) };
    if parts.iter().any(|&(id, _)| !library[id].identified) {
        return Ok(None);
    }
    let Ok(mixture) = library.mix(Recipe::from_iter(parts)) else { return Ok(None) };
    Ok(Some(LeftOut {
        sample: target.sample.clone(),
        shares,
        reflectance: target.reflectance.clone(),
        predicted: mixture.hiding(surface),
        library,
    }))
}

/// One half of the readings, ready to be fitted: all films of one pigment, and every second mixture, from
/// mixture `half` (0 or 1) on.
#[must_use]
pub fn half_of(prepared: &PreparedFit, half: usize) -> PreparedFit {
    let mixtures: Vec<&str> = (prepared.set.swatches.iter())
        .filter(|swatch| swatch.shares.iter().filter(|share| **share > 0.0).count() > 1)
        .map(|swatch| swatch.sample.as_str())
        .collect();
    let out: Vec<&str> = mixtures.iter().copied().skip(1 - half % 2).step_by(2).collect();
    let mut part = prepared.clone();
    part.set = prepared.set.retaining(|swatch| !out.contains(&swatch.sample.as_str()));
    if let FilmModel::Relative { reference, .. } = &mut part.model {
        let white = &prepared.set.pigments[reference.index()];
        let place = part.set.pigments.iter().position(|name| name == white);
        *reference = PigmentId(place.unwrap_or(reference.index()));
    }
    part
}

/// Errors of a library's predictions for mixtures that it has not seen.
#[derive(Debug, Clone, PartialEq)]
pub struct Residuals {
    /// Wavelengths of all spectra.
    pub grid: Grid,
    /// Measured reflectances of the mixtures, above 0.
    pub reflectance: Vec<Vec<f64>>,
    /// Measured less predicted reflectance of each.
    pub residual: Vec<Vec<f64>>,
}

impl Residuals {
    /// Errors of mixtures that were left out; `None` if there are none.
    #[must_use]
    pub fn of<'a>(samples: impl IntoIterator<Item = &'a LeftOut>) -> Option<Self> {
        let mut grid = None;
        let (mut reflectance, mut residual) = (Vec::new(), Vec::new());
        for sample in samples {
            grid = Some(sample.library.grid);
            reflectance.push(sample.reflectance.clone());
            let pairs = sample.reflectance.iter().zip(&sample.predicted);
            residual.push(pairs.map(|(measured, predicted)| measured - predicted).collect());
        }
        Some(Self { grid: grid?, reflectance, residual })
    }
}
