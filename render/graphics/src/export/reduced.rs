//! Pictures reduced to the size of a thumbnail or of a frame.

use rayon::prelude::*;

use crate::field::Field;

/// Width and height of a picture reduced until its longer side has at most `longest_px` pixels.
/// A smaller picture keeps its size.
#[must_use]
pub fn reduced_size((width, height): (usize, usize), longest_px: usize) -> (usize, usize) {
    let longest = width.max(height).max(1);
    if longest <= longest_px {
        return (width, height);
    }
    let reduced = |side: usize| {
        let exact = side as f64 * longest_px as f64 / longest as f64;
        (exact.round() as usize).max(usize::from(side > 0))
    };
    (reduced(width), reduced(height))
}

/// The picture in linear sRGB reduced to [`reduced_size`]: each pixel is the mean of the area that
/// it covers.
#[must_use]
pub fn reduced(picture: &Field<[f32; 4]>, longest_px: usize) -> Field<[f32; 4]> {
    let before = (picture.width(), picture.height());
    let (width, height) = reduced_size(before, longest_px);
    if (width, height) == before {
        return picture.clone();
    }
    let columns: Vec<_> = (0..width).map(|x| Covered::new(x, width, before.0)).collect();
    let mut out = Field::filled(width, height, [0.0; 4]);
    out.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        let rows = Covered::new(y, height, before.1);
        for (pixel, columns) in row.iter_mut().zip(&columns) {
            let mut sum = [0.0_f64; 4];
            for (y, down) in rows.shares() {
                for (x, across) in columns.shares() {
                    for (sum, value) in sum.iter_mut().zip(picture[(x, y)]) {
                        *sum += down * across * f64::from(value);
                    }
                }
            }
            *pixel = sum.map(|sum| sum as f32);
        }
    });
    out
}

/// The stretch of pixels that one pixel of the reduced picture covers along an axis.
struct Covered {
    start: f64,
    end: f64,
}

impl Covered {
    fn new(index: usize, count: usize, before: usize) -> Self {
        let edge = |index: usize| index as f64 * before as f64 / count as f64;
        Self { start: edge(index), end: edge(index + 1) }
    }

    /// Covered pixels with their shares, which sum to 1.
    fn shares(&self) -> impl Iterator<Item = (usize, f64)> {
        let Self { start, end } = *self;
        let last = end.ceil() as usize;
        (start.floor() as usize..last).filter_map(move |index| {
            let share = (end.min(index as f64 + 1.0) - start.max(index as f64)) / (end - start);
            (share > 0.0).then_some((index, share))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_keeps_its_shape_and_a_small_one_its_size() {
        assert_eq!(reduced_size((300, 100), 400), (300, 100));
        assert_eq!(reduced_size((300, 100), 150), (150, 50));
        assert_eq!(reduced_size((1000, 1), 10), (10, 1));
        assert_eq!(reduced_size((0, 0), 10), (0, 0));
    }

    #[test]
    fn each_pixel_is_the_mean_of_what_it_covers() {
        let values = [0.0, 3.0, 6.0, 9.0, 12.0].map(|value| [value, 1.0, -value, 1.0]);
        let row = Field::from_values(5, 1, values.to_vec());
        let found = reduced(&row, 2);
        assert_eq!((found.width(), found.height()), (2, 1));
        // Two and a half pixels each: (0 + 3 + 6 / 2) / 2.5 and (6 / 2 + 9 + 12) / 2.5.
        for (found, wanted) in found.values().iter().zip([2.4_f32, 9.6]) {
            let [a, b, c, d] = *found;
            assert!((a - wanted).abs() < 1e-5 && (c + wanted).abs() < 1e-5, "{found:?}");
            assert!((b - 1.0).abs() < 1e-6 && (d - 1.0).abs() < 1e-6, "{found:?}");
        }
    }
}
