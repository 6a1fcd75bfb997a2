//! Measured swatches as recipes of a palette.

use super::paints::{Palette, Recipe};
use crate::comparison::Comparison;
use crate::library::AmountKind;

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

/// The films of `comparison` whose pigments the palette can mix, without those
/// that the fit excluded. None for absolute amounts, whose films do not hide.
#[must_use]
pub fn measured_samples(palette: &Palette<'_>, comparison: &Comparison) -> Vec<MeasuredSample> {
    if palette.library().amounts == AmountKind::Absolute {
        return Vec::new();
    }
    let known = |recipe: &Recipe| recipe.iter().all(|(p, _)| palette.paints().contains(p));
    let films = comparison.films.iter().filter(|film| !film.excluded && known(&film.recipe));
    let sample = |film: &crate::comparison::ComparedFilm| MeasuredSample {
        sample: film.sample.clone(),
        recipe: film.recipe.clone(),
        reflectance: film.measured.clone(),
    };
    films.map(sample).collect()
}
