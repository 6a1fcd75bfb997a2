//! Blur of fields that tile.

use graphics::blurred;
use graphics::field::Field;

/// Blurs a field that tiles in both directions by a Gaussian of standard deviation `sigma`, in
/// cells. The cells on opposite borders are neighbours.
pub(crate) fn blurred_tile(field: &Field<f32>, sigma: f64) -> Field<f32> {
    let width = field.width();
    let height = field.height();
    // The blur repeats the cells at the border; four deviations keep that out of the tile.
    let margin = (4.0 * sigma).ceil() as usize;
    let wrapped = |index: usize, size: usize| {
        (index as isize - margin as isize).rem_euclid(size as isize) as usize
    };
    let wide = width + 2 * margin;
    let high = height + 2 * margin;
    let mut repeated = Vec::with_capacity(wide * high);
    for y in 0..high {
        for x in 0..wide {
            repeated.push([field[(wrapped(x, width), wrapped(y, height))]]);
        }
    }
    let smooth = blurred(&Field::from_values(wide, high, repeated), sigma);
    let mut values = Vec::with_capacity(width * height);
    for y in margin..margin + height {
        values.extend(smooth.row(y, margin, width).iter().map(|[value]| *value));
    }
    Field::from_values(width, height, values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blur_goes_over_the_border_and_keeps_the_sum() {
        let mut field = Field::filled(32, 24, 0.0);
        field[(0, 0)] = 1.0;
        let smooth = blurred_tile(&field, 3.0);
        let sum: f32 = smooth.values().iter().sum();
        assert!((sum - 1.0).abs() < 1e-4, "{sum}");
        for (a, b) in [((1, 0), (31, 0)), ((0, 2), (0, 22)), ((3, 1), (29, 23))] {
            assert!((smooth[a] - smooth[b]).abs() < 1e-7 && smooth[a] > 0.0);
        }
    }
}
