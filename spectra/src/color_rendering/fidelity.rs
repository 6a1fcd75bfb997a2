//! Colour fidelity and gamut of ANSI/IES TM-30-18.

use super::appearance::{Appearance, UniformColor};
use super::reference_light;
use super::samples;
use crate::illuminant::{Illuminant, IlluminantError};
use crate::integrate::TristimulusWeights;
use crate::interpolate::{Extrapolation, Interpolation};
use crate::observer::Observer;

/// Fall of the fidelity for one unit of CAM02-UCS (CIE 224:2017, equation 16).
const FALL: f64 = 6.73;
/// Number of hue bins of the gamut.
const BINS: usize = 16;
/// Band in nm over which TM-30 sums.
const BAND_NM: [f64; 2] = [380.0, 780.0];

/// Fidelity and gamut of a light by 99 samples (ANSI/IES TM-30-18).
#[derive(Debug, Clone, PartialEq)]
pub struct ColorFidelity {
    /// Fidelity index Rf, 0 to 100; that of CIE 224:2017.
    pub fidelity: f64,
    /// Gamut index Rg: 100 where the light shows as much chroma as its reference, more where it shows more.
    pub gamut: f64,
    /// Fidelity of each of the 99 samples, 0 to 100.
    pub samples: Vec<f64>,
    /// Fidelity of the samples in each of 16 bins of hue, from red at 0 degrees on; `None` for an empty bin.
    pub hue_bins: Vec<Option<f64>>,
}

impl ColorFidelity {
    /// Indices of `light`, whose correlated colour temperature is `kelvin`.
    pub(super) fn of(light: &Illuminant, kelvin: f64) -> Result<Self, IlluminantError> {
        let reference = reference_light::of_fidelity(kelvin)?;
        let colors = [colors(light)?, colors(&reference)?];
        let [own, wanted] = &colors;
        let away = |(own, wanted): (&UniformColor, &UniformColor)| {
            let squares = [own.lightness - wanted.lightness, own.a - wanted.a, own.b - wanted.b];
            squares.iter().map(|d| d * d).sum::<f64>().sqrt()
        };
        let differences: Vec<f64> = own.iter().zip(wanted).map(away).collect();
        let mut bins: [Vec<usize>; BINS] = std::array::from_fn(|_| Vec::new());
        for (sample, color) in wanted.iter().enumerate() {
            let bin = (color.hue_deg * BINS as f64 / 360.0) as usize;
            bins[bin.min(BINS - 1)].push(sample);
        }
        let mean_of = |bin: &Vec<usize>| {
            (!bin.is_empty()).then(|| fidelity(mean(bin.iter().map(|&at| differences[at]))))
        };
        let area = |colors: &[UniformColor]| {
            let filled = bins.iter().filter(|bin| !bin.is_empty());
            polygon_area(
                &filled
                    .map(|bin: &Vec<usize>| {
                        [
                            mean(bin.iter().map(|&at| colors[at].a)),
                            mean(bin.iter().map(|&at| colors[at].b)),
                        ]
                    })
                    .collect::<Vec<[f64; 2]>>(),
            )
        };
        Ok(Self {
            fidelity: fidelity(mean(differences.iter().copied())),
            gamut: 100.0 * area(own) / area(wanted),
            samples: differences.iter().copied().map(fidelity).collect(),
            hue_bins: bins.iter().map(mean_of).collect(),
        })
    }
}

/// The 99 samples under a light of which only 380 to 780 nm count.
fn colors(light: &Illuminant) -> Result<Vec<UniformColor>, IlluminantError> {
    let [first, last] = BAND_NM;
    let power = |nm: f64| {
        let inside = (first..=last).contains(&nm);
        let at = || light.power().at(nm, Interpolation::Linear, Extrapolation::Hold);
        if inside { at().unwrap_or(0.0) } else { 0.0 }
    };
    let light = Illuminant::from_function(light.name(), power)?;
    let samples = samples::of_fidelity();
    let observer = Observer::Cie1964Deg10;
    let weights = TristimulusWeights::new(samples.grid, &light, observer, Interpolation::Sprague)
        .expect("the samples have many wavelengths");
    let adapted = Appearance::under(weights.white());
    Ok(samples.reflectances.iter().map(|sample| adapted.of(weights.xyz(sample))).collect())
}

/// Fidelity of a colour difference in CAM02-UCS (CIE 224:2017, equation 17).
fn fidelity(difference: f64) -> f64 {
    10.0 * ((100.0 - FALL * difference) / 10.0).exp().ln_1p()
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// Area of a polygon by its corners in order.
fn polygon_area(corners: &[[f64; 2]]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let crosses = corners.iter().zip(next).map(|([a, b], [c, d])| a * d - b * c);
    crosses.sum::<f64>() / 2.0
}
