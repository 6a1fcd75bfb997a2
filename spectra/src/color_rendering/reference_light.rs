//! The light with which a lamp is compared: black body or daylight of its colour temperature.

use crate::black_body::black_body;
use crate::color::Xyz;
use crate::daylight::daylight;
use crate::illuminant::{Illuminant, IlluminantError};
use crate::integrate::TristimulusWeights;
use crate::interpolate::{Extrapolation, Interpolation};
use crate::observer::Observer;

/// Colour temperatures in K between which the reference of TM-30 goes from black body to daylight. The
/// reference of CIE 13.3 changes at the upper one.
const BLEND: [f64; 2] = [4000.0, 5000.0];

/// Reference of CIE 13.3: a black body below 5000 K, daylight from there on.
pub(super) fn of_rendering(kelvin: f64) -> Result<Illuminant, IlluminantError> {
    if kelvin < BLEND[1] { black_body(kelvin) } else { daylight(kelvin) }
}

/// Reference of TM-30: a black body up to 4000 K, daylight from 5000 K, and a mixture of both, of equal
/// luminance, between.
pub(super) fn of_fidelity(kelvin: f64) -> Result<Illuminant, IlluminantError> {
    let [first, last] = BLEND;
    if kelvin <= first {
        return black_body(kelvin);
    }
    if kelvin >= last {
        return daylight(kelvin);
    }
    let share = (kelvin - first) / (last - first);
    let [body, day] = [black_body(kelvin)?, daylight(kelvin)?];
    let [of_body, of_day] = [luminance(&body), luminance(&day)];
    let at = |light: &Illuminant, nm: f64| {
        light.power().at(nm, Interpolation::Linear, Extrapolation::Hold).unwrap_or(0.0)
    };
    Illuminant::from_function(&format!("reference of {kelvin} K"), |nm| {
        (1.0 - share) * at(&body, nm) / of_body + share * at(&day, nm) / of_day
    })
}

/// Luminance of a light in its own unit of power, for the observer of 1931.
fn luminance(light: &Illuminant) -> f64 {
    let response = Observer::Cie1931Deg2.functions()[1].values();
    light.power().values().iter().zip(response).map(|(power, y)| power * y).sum()
}

/// CIE 1960 (u, v) of a colour.
pub(super) fn uv(Xyz { x, y, z }: Xyz) -> [f64; 2] {
    let sum = x + 15.0 * y + 3.0 * z;
    [4.0 * x / sum, 6.0 * y / sum]
}

/// White point of `weights` in CIE 1960 (u, v).
pub(super) fn white_uv(weights: &TristimulusWeights) -> [f64; 2] {
    uv(weights.white())
}
