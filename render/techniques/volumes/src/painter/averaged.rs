//! Values of samples averaged to pixels.

use graphics::field::Field;
use rayon::prelude::*;

use crate::pigments::FilmHeights;

/// A value of which a pixel has the mean over its samples.
pub(super) trait Averaged: Copy + Send + Sync {
    /// The mean of `count` values.
    fn mean(values: impl Iterator<Item = Self>, count: usize) -> Self;
}

impl<const N: usize> Averaged for [f32; N] {
    fn mean(values: impl Iterator<Item = Self>, count: usize) -> Self {
        let mut sum = [0.0; N];
        for value in values {
            sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += value);
        }
        sum.map(|sum| sum / count as f32)
    }
}

impl Averaged for f32 {
    fn mean(values: impl Iterator<Item = Self>, count: usize) -> Self {
        values.sum::<Self>() / count as Self
    }
}

impl Averaged for FilmHeights {
    fn mean(values: impl Iterator<Item = Self>, count: usize) -> Self {
        let mut sum = [0_i64; 9];
        for value in values {
            sum.iter_mut().zip(value.0).for_each(|(sum, value)| *sum += i64::from(value));
        }
        Self(sum.map(|sum| (sum / count as i64) as i32))
    }
}

/// The mean over `samples` x `samples` values, for a field whose sides are multiples of them.
pub(super) fn averaged<T: Averaged>(field: Field<T>, samples: usize) -> Field<T> {
    if samples == 1 {
        return field;
    }
    let width = field.width() / samples;
    let height = field.height() / samples;
    let values = (0..width * height)
        .into_par_iter()
        .with_min_len(4096)
        .map(|index: usize| {
            let x = index % width * samples;
            let y = index / width * samples;
            let rows = (0..samples).flat_map(|line| field.row(y + line, x, samples));
            T::mean(rows.copied(), samples * samples)
        })
        .collect();
    Field::from_values(width, height, values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_is_the_mean_of_its_samples() {
        let field = Field::from_values(4, 2, vec![0.0, 2.0, 1.0, 1.0, 4.0, 2.0, 1.0, 1.0]);
        assert_eq!(averaged(field.clone(), 2).values(), [2.0, 1.0]);
        assert_eq!(averaged(field.clone(), 1), field);
        let heights = [3, 5, 7, 9].map(|height| FilmHeights([height; 9]));
        let field = Field::from_values(2, 2, heights.to_vec());
        assert_eq!(averaged(field, 2).values(), [FilmHeights([6; 9])]);
    }
}
