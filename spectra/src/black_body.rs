//! Black-body radiators (Planck's law).

use crate::illuminant::{Illuminant, IlluminantError};

/// The second radiation constant c2 in m K, with the value of CIE 15:2018, section 4.1.1
/// (ITS-90). The exact SI value, 0.014387769, differs by 2 parts in a million.
pub const SECOND_RADIATION_CONSTANT: f64 = 1.4388e-2;

/// A black body of temperature `kelvin`, with relative power 100 at 560 nm. The "5600 K bulb"
/// of Baxter, Wendt and Lin 2004 is `black_body(5600.0)`.
///
/// # Errors
/// [`IlluminantError::Temperature`] unless the temperature is finite and at least 500 K (below,
/// the visible power underflows double precision).
pub fn black_body(kelvin: f64) -> Result<Illuminant, IlluminantError> {
    let name = format!("black body {kelvin} K");
    if !(kelvin.is_finite() && kelvin >= 500.0) {
        return Err(IlluminantError::Temperature { kelvin });
    }
    let planck =
        |nm: f64| nm.powi(-5) / (SECOND_RADIATION_CONSTANT / (nm * 1e-9 * kelvin)).exp_m1();
    Illuminant::from_function(&name, |nm| 100.0 * planck(nm) / planck(560.0))
}
