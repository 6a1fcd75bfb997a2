//! Measured swatches as recipes of a library.

use super::paints::{Palette, Recipe};
use crate::library::AmountKind;
use crate::observation::Observation;
use crate::swatch::SwatchSet;

/// A measured swatch whose pigments are all in the palette.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSample {
    /// Its name.
    pub sample: String,
    /// Pigments of the library with their shares, sum 1.
    pub recipe: Recipe,
    /// Measured reflectance of a film that hides, surface included.
    pub reflectance: Vec<f64>,
}

/// The swatches of `set`, as `observations` has them in films that hide, whose
/// pigments the palette can mix. None for absolute amounts, where a film hides
/// nothing, or on another grid.
#[must_use]
pub fn measured_samples(
    palette: &Palette<'_>,
    set: &SwatchSet,
    observations: &[Observation],
) -> Vec<MeasuredSample> {
    let library = palette.library();
    if library.amounts == AmountKind::Absolute || set.grid != library.grid {
        return Vec::new();
    }
    let index = |name: &String| {
        let mut paints = palette.paints().iter().copied();
        paints.find(|&p| library.pigments[p].name == *name)
    };
    let paints: Vec<Option<usize>> = set.pigments.iter().map(index).collect();
    let sample = |observation: &Observation| {
        let shares = observation.shares.iter().zip(&paints).filter(|(share, _)| **share > 0.0);
        let recipe: Option<Recipe> =
            shares.map(|(&share, paint)| Some(((*paint)?, share))).collect();
        Some(MeasuredSample {
            sample: observation.sample.clone(),
            recipe: recipe?,
            reflectance: observation.reflectance.clone(),
        })
    };
    observations.iter().filter_map(sample).collect()
}
