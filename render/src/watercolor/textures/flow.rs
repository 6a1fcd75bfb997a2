//! Turbulent flow: pigment carried along in a wet wash.

use rayon::prelude::*;

use crate::watercolor::settings::FlowSettings;
use graphics::field::Field;
use graphics::noise::{Hills, random};

/// The standard deviation of the texture, before what little leaves 0..1 is cut.
const SPREAD: f64 = 0.2;

/// Sums of gradient noise (Perlin 2002), each octave half as wide and half as high
/// as the one before; Bousseau et al. 2006, section 3.2.
///
/// Of mean 0.5 and standard deviation 0.2; what leaves 0..1 (some 1 %) is cut. Nearly
/// all of its power lies between half a wave and two waves to the widest cloud and
/// to the narrowest. Places hold their values however large the field is.
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
