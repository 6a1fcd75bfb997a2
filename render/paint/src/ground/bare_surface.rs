//! A ground ready to be painted on.

use crate::optics::Gloss;
use graphics::field::Field;

/// Surface of a canvas or palette before any paint.
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// Human-readable description, for example `linen, seed 1`.
    pub name: String,
    /// Height of each cell above the plane of the canvas, in quanta.
    pub height: Field<i32>,
    /// Measured reflectance, one value per wavelength of the library's grid, 0..1.
    pub reflectance: Vec<f64>,
    /// Gloss of the bare ground.
    pub gloss: Gloss,
}
