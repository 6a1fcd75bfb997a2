//! Measured swatches as recipes of a palette.

use super::paints::Recipe;

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
