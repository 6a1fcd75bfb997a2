//! Measured swatches as recipes of a palette.

use crate::recipe::Recipe;

/// A measured swatch whose pigments are all in the palette.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSample {
    /// Name of the sample.
    pub sample: String,
    /// Pigments of the library with their shares, sum 1.
    pub recipe: Recipe,
    /// Measured reflectance of a film that hides, surface included, on the library's grid.
    pub reflectance: Vec<f64>,
}
