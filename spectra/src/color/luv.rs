//! CIE 1976 L*u*v*.

use super::lab::{KAPPA, TOE};
use super::xyz::Xyz;

/// A colour in CIE 1976 L*u*v* (ISO/CIE 11664-5).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Luv {
    /// Lightness, 0 for black to 100 for the white.
    pub lightness: f64,
    /// Green (negative) to red (positive).
    pub u: f64,
    /// Blue (negative) to yellow (positive).
    pub v: f64,
}

impl Luv {
    /// The CIELUV colour of `xyz` under the white point `white` (ISO/CIE 11664-5, equations 1
    /// to 5). Black has u* = v* = 0.
    #[must_use]
    pub fn from_xyz(xyz: Xyz, white: Xyz) -> Self {
        let relative = xyz.y / white.y;
        let lightness =
            if relative > TOE { 116.0 * relative.cbrt() - 16.0 } else { KAPPA * relative };
        let [u, v] = uniform_chromaticity(xyz);
        let [white_u, white_v] = uniform_chromaticity(white);
        let scale = 13.0 * lightness;
        Self { lightness, u: scale * (u - white_u), v: scale * (v - white_v) }
    }

    /// L*, u* and v* in this order.
    #[must_use]
    pub fn to_array(self) -> [f64; 3] {
        [self.lightness, self.u, self.v]
    }
}

/// CIE 1976 chromaticity u', v'; 0 for black.
fn uniform_chromaticity(xyz: Xyz) -> [f64; 2] {
    let sum = xyz.x + 15.0 * xyz.y + 3.0 * xyz.z;
    if sum > 0.0 { [4.0 * xyz.x / sum, 9.0 * xyz.y / sum] } else { [0.0; 2] }
}
