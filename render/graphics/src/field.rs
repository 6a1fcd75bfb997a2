//! A value for every cell of a rectangle, row by row, with Gaussian blur and a soft step.
//!
//! The blur makes three passes of a box filter (Gwosdek, Grewenig, Bruhn and Weickert 2011). The
//! end cells of a box have a fractional weight. This makes its width continuous.

use std::ops::{Div, Mul, Sub};

use rayon::prelude::*;

use crate::tile::Rect;

/// Values over `width` x `height` cells. The first row is the topmost.
#[derive(Debug, Clone, PartialEq)]
pub struct Field<T> {
    width: usize,
    height: usize,
    values: Vec<T>,
}

impl<T: Clone> Field<T> {
    /// A field with `value` in every cell.
    #[must_use]
    pub fn filled(width: usize, height: usize, value: T) -> Self {
        Self { width, height, values: vec![value; width * height] }
    }
}

impl<T> Field<T> {
    /// A field of `values`, row by row from the top.
    ///
    /// # Panics
    /// If there are not `width` x `height` values.
    #[must_use]
    pub fn from_values(width: usize, height: usize, values: Vec<T>) -> Self {
        let found = values.len();
        assert_eq!(found, width * height, "{width} x {height} cells, found {found} values");
        Self { width, height, values }
    }

    /// Number of columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// The rectangle of all cells.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        Rect { x: 0, y: 0, width: self.width, height: self.height }
    }

    /// The values, row by row.
    #[must_use]
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// The values row by row. You can change them.
    pub fn values_mut(&mut self) -> &mut [T] {
        &mut self.values
    }

    /// The cells `x..x + width` of row `y`.
    #[must_use]
    pub fn row(&self, y: usize, x: usize, width: usize) -> &[T] {
        &self.values[y * self.width + x..][..width]
    }

    /// The cells `x..x + width` of row `y`. You can change them.
    pub fn row_mut(&mut self, y: usize, x: usize, width: usize) -> &mut [T] {
        &mut self.values[y * self.width + x..][..width]
    }
}

impl<T: Copy> Field<T> {
    /// A copy of the cells in `rect`.
    ///
    /// # Panics
    /// If `rect` reaches beyond the field.
    #[must_use]
    pub fn part(&self, rect: Rect) -> Self {
        assert_eq!(rect.intersection(self.bounds()), rect, "a part of {:?}", self.bounds());
        let rows = rect.y..rect.y + rect.height;
        let mut values = Vec::with_capacity(rect.width * rect.height);
        rows.for_each(|y| values.extend_from_slice(self.row(y, rect.x, rect.width)));
        Self::from_values(rect.width, rect.height, values)
    }

    /// Overwrites the cells of a rectangle with `part`. Its upper left cell is (`x`, `y`).
    ///
    /// # Panics
    /// If the rectangle reaches beyond the field.
    pub fn put(&mut self, (x, y): (usize, usize), part: &Self) {
        let rect = Rect { x, y, width: part.width, height: part.height };
        assert_eq!(rect.intersection(self.bounds()), rect, "a part of {:?}", self.bounds());
        for row in 0..part.height {
            self.row_mut(y + row, x, part.width).copy_from_slice(part.row(row, 0, part.width));
        }
    }
}

impl<T> std::ops::Index<(usize, usize)> for Field<T> {
    type Output = T;

    fn index(&self, (x, y): (usize, usize)) -> &T {
        &self.values[y * self.width + x]
    }
}

impl<T> std::ops::IndexMut<(usize, usize)> for Field<T> {
    fn index_mut(&mut self, (x, y): (usize, usize)) -> &mut T {
        &mut self.values[y * self.width + x]
    }
}

/// A smooth step: 0 up to `low`, 1 from `high` on, and in between a cubic with slope 0 at both. If
/// you pass a greater `low` than `high`, it falls.
#[must_use]
pub fn smoothstep<T>([low, high]: [T; 2], value: T) -> T
where
    T: Copy + PartialOrd + From<f32> + Sub<Output = T> + Mul<Output = T> + Div<Output = T>,
{
    let [zero, one] = [0.0, 1.0].map(T::from);
    let t = match (value - low) / (high - low) {
        t if t < zero => zero,
        t if t > one => one,
        t => t,
    };
    t * t * (T::from(3.0) - T::from(2.0) * t)
}

/// Blurs `field` by a Gaussian of standard deviation `sigma`, in cells. If you pass 0 or less, you
/// get a copy. Cells outside the field count with the value of the nearest cell inside it.
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

/// A box filter: the mean of `2 radius + 1` cells of weight 1 and one more cell of weight `part`
/// at each end.
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
    fn it_is_flat_outside_of_its_limits_and_half_in_their_middle() {
        assert_eq!(
            [0.5, 1.0, 2.0, 3.0, 9.0].map(|at| smoothstep([1.0_f32, 3.0], at))[..2],
            [0.0; 2]
        );
        assert_eq!([2.0, 3.0, 9.0].map(|at| smoothstep([1.0_f64, 3.0], at)), [0.5, 1.0, 1.0]);
        fn slope(at: f64) -> f64 {
            (smoothstep([0.0, 1.0], at + 1e-4) - smoothstep([0.0, 1.0], at)) / 1e-4
        }
        assert!(slope(0.0) < 1e-3 && slope(0.9999) < 1e-3 && (slope(0.5) - 1.5).abs() < 1e-3);
        // Limits may fall.
        assert_eq!(smoothstep([1.0_f32, 0.0], 0.25), smoothstep([0.0, 1.0], 0.75));
    }

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
