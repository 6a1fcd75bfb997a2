//! Division of regions with a colour gradient into steps.
//!
//! A smooth gradient becomes one region, however much the colours of its ends differ. A
//! painter lays such a gradient in a few washes. So the modes of a region are divided by
//! the plane through their mean perpendicular to the axis of greatest variance, until no
//! part has a greater variance than colours spread evenly over one step.

use rayon::prelude::*;

use super::mean_shift::Mode;
use super::regions::{Sets, numbered};
use crate::field::Field;

/// Rounds of the power iteration that finds an axis.
const ROUNDS: usize = 24;

/// Divides the `count` regions of `labels` until the variance of a part along any axis is at
/// most `step`^2 / 12, that of colours spread evenly over `step` in CIELUV; then into
/// connected parts. Returns the new labels and their number.
pub(super) fn cut(
    labels: &Field<u32>,
    count: usize,
    modes: &Field<Mode>,
    step: f32,
) -> (Field<u32>, usize) {
    let most = f64::from(step).powi(2) / 12.0;
    let mut pixels = by_region(labels, count);
    let parts: Vec<Vec<&mut [u32]>> = pixels
        .par_iter_mut()
        .map(|region| {
            let mut parts = Vec::new();
            halve(region, modes.values(), most, &mut parts);
            parts
        })
        .collect();
    let mut part_of = vec![0u32; labels.values().len()];
    for (number, part) in (0u32..).zip(parts.iter().flatten()) {
        part.iter().for_each(|&pixel| part_of[pixel as usize] = number);
    }
    let width = labels.width();
    let height = labels.height();
    let mut sets = Sets::new(part_of.len());
    for pixel in 0..part_of.len() {
        let x = pixel % width;
        let y = pixel / width;
        if x > 0 && part_of[pixel] == part_of[pixel - 1] {
            sets.join(pixel as u32, pixel as u32 - 1);
        }
        if y > 0 && part_of[pixel] == part_of[pixel - width] {
            sets.join(pixel as u32, (pixel - width) as u32);
        }
    }
    let mut own: Vec<u32> = (0..part_of.len() as u32).collect();
    let count = numbered(&mut sets, &mut own, part_of.len());
    (Field::from_values(width, height, own), count)
}

/// The pixels of each region.
fn by_region(labels: &Field<u32>, count: usize) -> Vec<Vec<u32>> {
    let mut sizes = vec![0; count];
    labels.values().iter().for_each(|&label| sizes[label as usize] += 1);
    let mut pixels: Vec<Vec<u32>> = sizes.into_iter().map(Vec::with_capacity).collect();
    for (pixel, &label) in (0..).zip(labels.values()) {
        pixels[label as usize].push(pixel);
    }
    pixels
}

/// Halves `pixels` until no part has a variance above `most` along any axis.
fn halve<'a>(pixels: &'a mut [u32], modes: &[Mode], most: f64, parts: &mut Vec<&'a mut [u32]>) {
    let Some(plane) = Plane::across(pixels, modes).filter(|plane| plane.variance > most) else {
        parts.push(pixels);
        return;
    };
    // A stable sort: pixels below the plane first, each side in its former order.
    pixels.sort_by_key(|&pixel| plane.height(&modes[pixel as usize]) >= 0.0);
    let below = pixels.partition_point(|&pixel| plane.height(&modes[pixel as usize]) < 0.0);
    if below == 0 || below == pixels.len() {
        parts.push(pixels);
        return;
    }
    let (low, high) = pixels.split_at_mut(below);
    halve(low, modes, most, parts);
    halve(high, modes, most, parts);
}

/// The plane through the mean colour, perpendicular to the axis of greatest variance.
struct Plane {
    mean: [f64; 3],
    axis: [f64; 3],
    variance: f64,
}

impl Plane {
    fn across(pixels: &[u32], modes: &[Mode]) -> Option<Self> {
        let count = pixels.len() as f64;
        let mut sums = [0.0; 3];
        let mut squares = [[0.0; 3]; 3];
        for &pixel in pixels {
            let color = modes[pixel as usize].color.map(f64::from);
            for i in 0..3 {
                sums[i] += color[i];
                for j in 0..3 {
                    squares[i][j] += color[i] * color[j];
                }
            }
        }
        let mean = sums.map(|sum| sum / count);
        let covariance: [[f64; 3]; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| squares[i][j] / count - mean[i] * mean[j])
        });
        // Starting from the channel of greatest variance makes a start perpendicular to the
        // axis unlikely.
        let first = (0..3).max_by(|&a, &b| covariance[a][a].total_cmp(&covariance[b][b]))?;
        let mut axis = covariance[first];
        let mut variance = 0.0;
        for _ in 0..ROUNDS {
            let length = axis.iter().map(|v| v * v).sum::<f64>().sqrt();
            if length <= 0.0 {
                return None;
            }
            let unit = axis.map(|v| v / length);
            axis = covariance.map(|row| (0..3).map(|i| row[i] * unit[i]).sum());
            variance = (0..3).map(|i| axis[i] * unit[i]).sum();
        }
        Some(Self { mean, axis, variance })
    }

    /// Signed distance from the plane in arbitrary units, positive above it.
    fn height(&self, mode: &Mode) -> f64 {
        (0..3).map(|i| self.axis[i] * (f64::from(mode.color[i]) - self.mean[i])).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(colors: &[[f32; 3]]) -> Field<Mode> {
        let modes = colors.iter().map(|&color| Mode { color, ..Mode::default() }).collect();
        Field::from_values(colors.len(), 1, modes)
    }

    #[test]
    fn a_ramp_is_cut_into_even_steps() {
        let colors: Vec<[f32; 3]> = (0..80).map(|i| [i as f32, 0.0, i as f32 / 2.0]).collect();
        let labels = Field::filled(80, 1, 0);
        // 80 of L* and 40 of v* are 89.4 in all: four steps of 22.4.
        let (found, count) = cut(&labels, 1, &row(&colors), 23.0);
        assert_eq!(count, 4);
        let wanted: Vec<u32> = (0..80).map(|i| i / 20).collect();
        assert_eq!(found.values(), wanted);
        assert_eq!(
            [60.0, 88.0, 90.0].map(|step| cut(&labels, 1, &row(&colors), step).1),
            [2, 2, 1]
        );
    }

    #[test]
    fn parts_hang_together_and_stay_in_their_region() {
        let colors = [0.0, 0.0, 50.0, 0.0, 0.0, 0.0].map(|l| [l, 0.0, 0.0]);
        let labels = Field::from_values(6, 1, vec![0, 0, 0, 0, 1, 1]);
        let (found, count) = cut(&labels, 2, &row(&colors), 20.0);
        assert_eq!((found.values(), count), (&[0, 0, 1, 2, 3, 3][..], 4));
    }

    #[test]
    fn even_color_is_not_cut() {
        let labels = Field::filled(5, 1, 0);
        assert_eq!(cut(&labels, 1, &row(&[[30.0, 7.0, -3.0]; 5]), 1.0).1, 1);
    }
}
