//! Turbulent flow: clouds of pigment carried by the water of a wet wash.

use rayon::prelude::*;

use crate::settings::FlowSettings;
use graphics::field::Field;
use graphics::noise::{Hills, random};

/// Standard deviation of the texture before clipping to 0..1. Chosen by eye.
const SPREAD: f64 = 0.2;

/// A sum of octaves of gradient noise (Perlin 2002), each with half the wavelength and half
/// the amplitude of the previous one; Bousseau et al. 2006, section 3.2.
///
/// The mean is 0.5, the standard deviation 0.2; values outside 0..1 (about 1 %) are clipped.
/// Nearly all power lies between half a wave per widest cloud and two waves per narrowest
/// one. The value of a pixel does not depend on the size of the field.
#[must_use]
pub fn turbulent_flow(width: usize, height: usize, settings: &FlowSettings) -> Field<f32> {
    let mut random = random(settings.seed, 11);
    let mut variance = 0.0;
    let octaves: Vec<(Hills, f32, f32)> = (0..settings.octaves as i32)
        .map(|octave| {
            let share = 0.5_f64.powi(octave);
            variance += Hills::VARIANCE * share * share;
            let step = 2.0_f64.powi(octave) / f64::from(settings.size_px.max(1.0));
            (Hills::new(&mut random), share as f32, step as f32)
        })
        .collect();
    let scale = (SPREAD / variance.sqrt()) as f32;
    let mut flow = Field::filled(width, height, 0.0);
    flow.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        for (x, out) in row.iter_mut().enumerate() {
            let sum: f32 = octaves
                .iter()
                .map(|(hills, share, step)| share * hills.at(x as f32 * step, y as f32 * step))
                .sum();
            *out = (0.5 + scale * sum).clamp(0.0, 1.0);
        }
    });
    flow
}
