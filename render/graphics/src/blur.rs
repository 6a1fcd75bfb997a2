//! Gaussian blur by three passes of a box filter (Gwosdek, Grewenig, Bruhn and Weickert
//! 2011). The end cells of a box have a fractional weight, so that its width is continuous.

use rayon::prelude::*;

use crate::field::Field;

/// Blurs `field` by a Gaussian of standard deviation `sigma`, in cells; 0 or less gives a
/// copy. Cells outside the field have the value of the nearest cell inside it.
pub fn blurred<const N: usize>(field: &Field<[f32; N]>, sigma: f64) -> Field<[f32; N]> {
    if sigma <= 0.0 {
        return field.clone();
    }
    let sideways = along_rows(field, sigma);
    transposed(&along_rows(&transposed(&sideways), sigma))
}

fn along_rows<const N: usize>(field: &Field<[f32; N]>, sigma: f64) -> Field<[f32; N]> {
    let width = field.width();
    let kernel = RunningMean::of(sigma);
    let mut blurred = field.clone();
    blurred.values_mut().par_chunks_mut(width).for_each(|row| {
        let mut other = row.to_vec();
        for _ in 0..PASSES {
            kernel.run(row, &mut other);
            row.copy_from_slice(&other);
        }
    });
    blurred
}

fn transposed<const N: usize>(field: &Field<[f32; N]>) -> Field<[f32; N]> {
    let width = field.width();
    let height = field.height();
    let mut values = vec![[0.0; N]; width * height];
    values.par_chunks_mut(height).enumerate().for_each(|(x, column)| {
        for (y, value) in column.iter_mut().enumerate() {
            *value = field[(x, y)];
        }
    });
    Field::from_values(height, width, values)
}

const PASSES: usize = 3;

/// A box filter: the mean of `2 radius + 1` cells of weight 1 and of one more cell of weight
/// `part` at each end.
struct RunningMean {
    radius: usize,
    part: f64,
}

impl RunningMean {
    fn of(sigma: f64) -> Self {
        let variance = sigma * sigma / PASSES as f64;
        let radius = (((12.0 * variance + 1.0).sqrt() - 1.0) / 2.0).floor();
        let part = (2.0 * radius + 1.0) * (radius * (radius + 1.0) - 3.0 * variance)
            / (6.0 * (variance - (radius + 1.0).powi(2)));
        Self { radius: radius as usize, part }
    }

    fn run<const N: usize>(&self, row: &[[f32; N]], out: &mut [[f32; N]]) {
        let last = row.len() as isize - 1;
        let at = |place: isize| row[place.clamp(0, last) as usize].map(f64::from);
        let radius = self.radius as isize;
        let scale = 1.0 / (2.0 * radius as f64 + 1.0 + 2.0 * self.part);
        let mut sum = [0.0; N];
        for place in -radius..=radius {
            let value = at(place);
            (0..N).for_each(|i| sum[i] += value[i]);
        }
        for (place, out) in out.iter_mut().enumerate() {
            let place = place as isize;
            let before = at(place - radius - 1);
            let after = at(place + radius + 1);
            let first = at(place - radius);
            for i in 0..N {
                out[i] = (scale * (sum[i] + self.part * (before[i] + after[i]))) as f32;
                sum[i] += after[i] - first[i];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_spreads_with_the_wanted_variance() {
        for sigma in [0.4, 1.0, 3.3, 8.0] {
            let mut field = Field::filled(101, 101, [0.0_f32]);
            field[(50, 50)] = [1.0];
            let spread = blurred(&field, sigma);
            let mut moments = [0.0; 3];
            for y in 0..101 {
                for x in 0..101 {
                    let value = f64::from(spread[(x, y)][0]);
                    let dx = x as f64 - 50.0;
                    let dy = y as f64 - 50.0;
                    moments[0] += value;
                    moments[1] += value * dx * dx;
                    moments[2] += value * dy * dy;
                }
            }
            assert!((moments[0] - 1.0).abs() < 1e-5, "{sigma}: sum {}", moments[0]);
            for variance in &moments[1..] {
                assert!((variance / sigma.powi(2) - 1.0).abs() < 1e-4, "{sigma}: {variance}");
            }
        }
    }

    #[test]
    fn an_even_field_stays() {
        let field = Field::filled(7, 3, [0.25_f32, 3.0]);
        for sigma in [0.0, 0.7, 40.0] {
            for value in blurred(&field, sigma).values() {
                assert!((value[0] - 0.25).abs() < 1e-6 && (value[1] - 3.0).abs() < 1e-5);
            }
        }
    }
}
