//! A texture of smooth noise that repeats without a seam.
//!
//! Cubic B-splines interpolate independent lattice values. The result is smooth, has about
//! one wavelength and repeats with the lattice. Interpolation lowers the spread between the
//! nodes, so the texture as a whole is scaled to a standard deviation of [`SPREAD`].

use rayon::prelude::*;

use super::octaves::SPREAD;
use super::random::Seed;
use crate::field::Field;

/// Width and height of the texture in texels.
const SIDE: usize = 512;

/// Noise of 512 x 512 texels that repeats, with mean 0.5 and standard deviation
/// [`SPREAD`]. Its waves are about `wave_texels` long, a power of two from 8 to 128.
///
/// # Panics
/// If `wave_texels` is not such a number.
#[must_use]
pub fn repeating_noise(wave_texels: usize, seed: u64) -> Field<f32> {
    let fits = wave_texels.is_power_of_two() && (8..=128).contains(&wave_texels);
    assert!(fits, "waves of 8 to 128 texels, a power of two, found {wave_texels}");
    // The shortest waves are two lattice steps long, the mean wave four.
    let step = wave_texels / 4;
    let nodes = SIDE / step;
    let value = |i: usize, j: usize| {
        let number = ((j % nodes) * nodes + i % nodes) as u64;
        Seed(seed).child(number).unit(0) - 0.5
    };
    let splines: Vec<[f32; 4]> = (0..step).map(|i| spline(i as f32 / step as f32)).collect();
    let rows = (0..SIDE).into_par_iter().flat_map_iter(|y| {
        let j = y / step;
        let down = &splines[y % step];
        let column = |i: usize| -> f32 { (0..4).map(|k| down[k] * value(i, j + k)).sum() };
        let columns: Vec<f32> = (0..nodes + 3).map(column).collect();
        let splines = &splines;
        (0..SIDE).map(move |x| {
            let i = x / step;
            let right = &splines[x % step];
            (0..4).map(|k| right[k] * columns[i + k]).sum::<f32>()
        })
    });
    let mut texture = Field::from_values(SIDE, SIDE, rows.collect());
    let count = (SIDE * SIDE) as f64;
    let mean = texture.values().iter().map(|&value| f64::from(value)).sum::<f64>() / count;
    let spread = (texture
        .values()
        .iter()
        .map(|&value: &f32| (f64::from(value) - mean).powi(2))
        .sum::<f64>()
        / count)
        .sqrt();
    let gain = f64::from(SPREAD) / spread;
    for value in texture.values_mut() {
        *value = (0.5 + (f64::from(*value) - mean) * gain) as f32;
    }
    texture
}

/// The weights of the four cubic B-splines at `t` (0..1) between two nodes.
fn spline(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    let inner = |t: f32| (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0;
    [s * s * s / 6.0, inner(t), inner(s), t * t * t / 6.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_texture_repeats_without_a_seam() {
        let texture = repeating_noise(32, 5);
        let step = |a: (usize, usize), b: (usize, usize)| (texture[a] - texture[b]).abs();
        let most = |inside: &dyn Fn(usize, usize) -> f32, at: usize| {
            (0..SIDE).map(|i| inside(at, i)).fold(0.0, f32::max)
        };
        let across = |x: usize, y: usize| step((x, y), ((x + 1) % SIDE, y));
        let down = |y: usize, x: usize| step((x, y), (x, (y + 1) % SIDE));
        for steps in [&across as &dyn Fn(usize, usize) -> f32, &down] {
            let usual = (0..SIDE - 1).map(|at| most(steps, at)).fold(0.0, f32::max);
            assert!(most(steps, SIDE - 1) <= usual, "{} {usual}", most(steps, SIDE - 1));
        }
        let mean = texture.values().iter().sum::<f32>() / (SIDE * SIDE) as f32;
        assert!((mean - 0.5).abs() < 1e-4, "{mean}");
        assert_ne!(texture, repeating_noise(32, 6));
    }
}
