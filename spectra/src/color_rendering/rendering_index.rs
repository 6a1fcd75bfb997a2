//! The colour rendering index of CIE 13.3-1995.

use super::reference_light::{self, uv, white_uv};
use super::samples;
use crate::color::Xyz;
use crate::illuminant::{Illuminant, IlluminantError};
use crate::integrate::TristimulusWeights;
use crate::interpolate::InterpolateError;
use crate::interpolate::Interpolation;
use crate::observer::Observer;

/// Number of samples whose mean is the general index.
const GENERAL: usize = 8;
/// Fall of an index for one unit of CIE 1964 U*V*W*.
const FALL: f64 = 4.6;
/// Largest distance from the reference in CIE 1960 (u, v) for which the index is meant (CIE 13.3, 5.3).
const FARTHEST: f64 = 5.4e-3;

/// Colour rendering indices of a light (CIE 13.3-1995).
#[derive(Debug, Clone, PartialEq)]
pub struct RenderingIndex {
    /// General colour rendering index Ra, the mean of the first eight special indices; 100 at most.
    pub general: f64,
    /// Special indices R1 to R14: R9 is a strong red, R13 a light skin, R14 a leaf.
    pub special: Vec<f64>,
    /// Distance of the light from its reference in CIE 1960 (u, v).
    pub distance_from_reference: f64,
}

impl RenderingIndex {
    /// Indices of `light`, whose correlated colour temperature is `kelvin`.
    pub(super) fn of(light: &Illuminant, kelvin: f64) -> Result<Self, IlluminantError> {
        let reference = reference_light::of_rendering(kelvin)?;
        let samples = samples::of_rendering();
        let weights = |light: &Illuminant| -> Result<TristimulusWeights, InterpolateError> {
            let observer = Observer::Cie1931Deg2;
            TristimulusWeights::new(samples.grid, light, observer, Interpolation::Sprague)
        };
        let weights = [light, &reference]
            .map(|light| weights(light).expect("the samples have many wavelengths"));
        let whites = [white_uv(&weights[0]), white_uv(&weights[1])];
        let index = |reflectance: &Vec<f64>| {
            let [own, wanted] = [weights[0].xyz(reflectance), weights[1].xyz(reflectance)];
            let own = uvw(own, adapted(uv(own), whites), whites[1]);
            let wanted = uvw(wanted, uv(wanted), whites[1]);
            let squares = own.iter().zip(wanted).map(|(own, wanted)| (own - wanted).powi(2));
            100.0 - FALL * squares.sum::<f64>().sqrt()
        };
        let special: Vec<f64> = samples.reflectances.iter().map(index).collect();
        let [own, wanted] = whites;
        Ok(Self {
            general: special[..GENERAL].iter().sum::<f64>() / GENERAL as f64,
            special,
            distance_from_reference: (own[0] - wanted[0]).hypot(own[1] - wanted[1]),
        })
    }

    /// Whether the light is so near to its reference, within 0.0054, that the index is meant for it.
    #[must_use]
    pub fn is_meant(&self) -> bool {
        self.distance_from_reference <= FARTHEST
    }
}

/// Chromaticity under the first of two whites, adapted to the second by von Kries' law in the form of CIE
/// 13.3, section 5.7.
fn adapted(at: [f64; 2], whites: [[f64; 2]; 2]) -> [f64; 2] {
    let c = |[u, v]: [f64; 2]| (4.0 - u - 10.0 * v) / v;
    let d = |[u, v]: [f64; 2]| (1.708 * v + 0.404 - 1.481 * u) / v;
    let [own, reference] = whites;
    let c = c(reference) / c(own) * c(at);
    let d = d(reference) / d(own) * d(at);
    let below = 16.518 + 1.481 * c - d;
    [(10.872 + 0.404 * c - 4.0 * d) / below, 5.52 / below]
}

/// CIE 1964 U*, V*, W* of a colour with luminance factor and chromaticity.
fn uvw(xyz: Xyz, [u, v]: [f64; 2], white: [f64; 2]) -> [f64; 3] {
    let lightness = 25.0 * xyz.y.cbrt() - 17.0;
    [13.0 * lightness * (u - white[0]), 13.0 * lightness * (v - white[1]), lightness]
}
