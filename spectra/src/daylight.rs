//! Daylight of any correlated colour temperature.

use std::sync::OnceLock;

use crate::illuminant::{Illuminant, IlluminantError};
use crate::interpolate::Extrapolation;
use crate::irregular::IrregularSpectrum;
use crate::table;

/// CIE daylight of the correlated colour temperature `kelvin`, 4000 to 25000.
///
/// CIE 15:2018, section 4.1.2: the chromaticity gives the weights M1 and M2 of the three
/// tabulated components. They are not rounded to three places here, as the CIE does for the
/// tabulated D50 to D75 (see [`Illuminant::named`]). The temperature is on the present scale,
/// on which D65 has 6503.616 K (6500 x 1.4388 / 1.4380), about 6504 K.
///
/// # Errors
/// [`IlluminantError::Temperature`] outside 4000 to 25000 K, where the CIE does not define
/// daylight.
pub fn daylight(kelvin: f64) -> Result<Illuminant, IlluminantError> {
    let name = format!("daylight {kelvin} K");
    if !(4000.0..=25000.0).contains(&kelvin) {
        return Err(IlluminantError::Temperature { kelvin });
    }
    let (x, y) = daylight_chromaticity(kelvin);
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    let m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
    let m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
    let [s0, s1, s2] = components();
    Illuminant::from_function(&name, |nm| {
        let [s0, s1, s2] =
            [s0, s1, s2].map(|s| s.at_linear(nm, Extrapolation::Hold).unwrap_or(0.0));
        (s0 + m1 * s1 + m2 * s2).max(0.0)
    })
}

/// CIE 1931 chromaticity (x, y) of daylight of temperature `kelvin` (CIE 15:2018, equations 4.1
/// to 4.3). Valid from 4000 to 25000 K.
#[must_use]
pub fn daylight_chromaticity(kelvin: f64) -> (f64, f64) {
    let t = 1000.0 / kelvin;
    let x = if kelvin <= 7000.0 {
        ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
    } else {
        ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040
    };
    (x, -3.0 * x * x + 2.87 * x - 0.275)
}

fn components() -> &'static [IrregularSpectrum; 3] {
    static TABLE: OnceLock<[IrregularSpectrum; 3]> = OnceLock::new();
    TABLE.get_or_init(|| {
        let columns = table::columns(include_str!("../data/daylight-components.csv"));
        ["S0", "S1", "S2"].map(|name| {
            let (nm, values) = table::filled(&columns, name).expect("a shipped component");
            IrregularSpectrum::new(nm, values).expect("shipped wavelengths rise")
        })
    })
}
