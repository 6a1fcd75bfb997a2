//! Interpolation of regular data by rows of weights, and the natural cubic spline through values at
//! irregular wavelengths.
//!
//! An interpolated value is a weighted sum of at most six neighbours. We work with the weights, so
//! that the same rows resample a spectrum and, transposed, reduce an observer to a coarse grid.

use documents::hint::Explain;

use crate::grid::Grid;

/// The method of interpolation between the wavelengths of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Interpolation {
    /// Linear between neighbours. This never overshoots.
    Linear,
    /// Sprague's fifth-order polynomial (Sprague 1880), which CIE 167:2005 recommends for regular spectra. It
    /// requires six wavelengths and may overshoot near a sharp edge.
    #[default]
    Sprague,
}

/// The value of a spectrum outside its band.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Extrapolation {
    /// No value. If you ask for one there, you get an error.
    Refuse,
    /// The value at the nearer end, as ASTM E308 prescribes for tristimulus values.
    Hold,
}

/// Weights of the values `first .. first + weights.len()` of a grid. Their weighted sum is the
/// value at one wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct InterpolationRow {
    pub(crate) first: usize,
    weights: [f64; 6],
    len: usize,
}

impl InterpolationRow {
    pub(crate) fn weights(&self) -> &[f64] {
        &self.weights[..self.len]
    }

    pub(crate) fn apply(&self, values: &[f64]) -> f64 {
        self.weights().iter().zip(&values[self.first..]).map(|(w, v)| w * v).sum()
    }

    fn single(index: usize) -> Self {
        Self { first: index, weights: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0], len: 1 }
    }
}

impl Interpolation {
    /// Name of the method in files and settings.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Sprague => "sprague",
        }
    }

    /// Sprague if `grid` has the six wavelengths it requires, otherwise linear.
    #[must_use]
    pub fn best_for(grid: Grid) -> Self {
        if grid.count() >= 6 { Self::Sprague } else { Self::Linear }
    }

    /// The weights that interpolate values on `grid` at `nm`.
    pub(crate) fn row(
        self,
        grid: Grid,
        nm: f64,
        ends: Extrapolation,
    ) -> Result<InterpolationRow, InterpolateError> {
        if self == Self::Sprague && grid.count() < 6 {
            return Err(InterpolateError::TooFew(grid.count()));
        }
        let last = grid.count() - 1;
        if !grid.covers(nm) {
            return match ends {
                Extrapolation::Hold if !nm.is_nan() => {
                    Ok(InterpolationRow::single(if nm < grid.start_nm() { 0 } else { last }))
                }
                _ => Err(InterpolateError::Outside {
                    nm,
                    start_nm: grid.start_nm(),
                    end_nm: grid.end_nm(),
                }),
            };
        }
        if last == 0 {
            return Ok(InterpolationRow::single(0));
        }
        let position = ((nm - grid.start_nm()) / grid.step_nm()).clamp(0.0, last as f64);
        let index = (position.floor() as usize).min(last - 1);
        let fraction = position - index as f64;
        Ok(match self {
            Self::Linear => InterpolationRow {
                first: index,
                weights: [1.0 - fraction, fraction, 0.0, 0.0, 0.0, 0.0],
                len: 2,
            },
            Self::Sprague => sprague_row(index, fraction, grid.count()),
        })
    }
}

/// Weights of Sprague's polynomial at the position `x` in an interval, 0 to 1. The six points reach
/// from two before the interval to three after its start (CIE 167:2005, section 4).
fn sprague_weights(x: f64) -> [f64; 6] {
    // Row n holds the coefficients of x^n in terms of the six values, times 24.
    const COEFFICIENTS: [[f64; 6]; 6] = [
        [0.0, 0.0, 24.0, 0.0, 0.0, 0.0],
        [2.0, -16.0, 0.0, 16.0, -2.0, 0.0],
        [-1.0, 16.0, -30.0, 16.0, -1.0, 0.0],
        [-9.0, 39.0, -70.0, 66.0, -33.0, 7.0],
        [13.0, -64.0, 126.0, -124.0, 61.0, -12.0],
        [-5.0, 25.0, -50.0, 50.0, -25.0, 5.0],
    ];
    let mut weights = [0.0; 6];
    for row in COEFFICIENTS.iter().rev() {
        for (weight, c) in weights.iter_mut().zip(row) {
            *weight = *weight * x + c / 24.0;
        }
    }
    weights
}

/// Extrapolates two values before the first one from the first six (CIE 167:2005, table of boundary
/// coefficients, times 209). Mirror it to extrapolate beyond the last.
const BEFORE: [[f64; 6]; 2] = [
    [884.0, -1960.0, 3033.0, -2648.0, 1080.0, -180.0],
    [508.0, -540.0, 488.0, -367.0, 144.0, -24.0],
];

fn sprague_row(index: usize, fraction: f64, count: usize) -> InterpolationRow {
    let raw = sprague_weights(fraction);
    // The six points are index - 2 .. index + 3. Shift the window into the data and express the
    // points outside it by the boundary polynomials.
    let first = index.saturating_sub(2).min(count - 6);
    let mut weights = [0.0; 6];
    for (offset, weight) in raw.into_iter().enumerate() {
        let point = index as isize + offset as isize - 2;
        if point < 0 {
            let row = BEFORE[(point + 2) as usize];
            for (target, c) in weights.iter_mut().zip(row) {
                *target += weight * c / 209.0;
            }
        } else if point as usize >= count {
            let row = BEFORE[1 - (point as usize - count)];
            for (target, c) in weights.iter_mut().zip(row.iter().rev()) {
                *target += weight * c / 209.0;
            }
        } else {
            weights[point as usize - first] += weight;
        }
    }
    InterpolationRow { first, weights, len: 6 }
}

/// A spectrum that cannot be interpolated.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, Explain)]
pub enum InterpolateError {
    /// The wavelength is outside the band of the data.
    #[error("`{nm}` nm lies outside the measured band of {start_nm} to {end_nm} nm")]
    Outside {
        /// The requested wavelength in nm.
        nm: f64,
        /// First wavelength of the data in nm.
        start_nm: f64,
        /// Last wavelength of the data in nm.
        end_nm: f64,
    },
    /// Sprague's polynomial requires six wavelengths.
    #[error("sprague interpolation needs 6 wavelengths, found `{0}`")]
    TooFew(usize),
}

/// A curve of cubic pieces with continuous slope and second derivative. The second derivative is 0 at both
/// ends (de Boor 1978, chapter 4).
#[derive(Debug)]
pub(crate) struct Spline<'a> {
    places: &'a [f64],
    values: &'a [f64],
    bends: Vec<f64>,
}

impl<'a> Spline<'a> {
    /// The spline through `values` at `places`. Pass two or more of each, in equal number. `places` must
    /// rise strictly.
    pub(crate) fn through(places: &'a [f64], values: &'a [f64]) -> Self {
        let count = places.len();
        let width: Vec<f64> = places.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let slope: Vec<f64> = values
            .windows(2)
            .zip(&width)
            .map(|(pair, width)| (pair[1] - pair[0]) / width)
            .collect();
        // The tridiagonal system of the inner second derivatives, eliminated downwards, solved upwards.
        let mut bends = vec![0.0; count];
        let mut above = vec![0.0; count];
        for at in 1..count - 1 {
            let left = width[at - 1];
            let right = width[at];
            let pivot = 2.0 * (left + right) - left * above[at - 1];
            above[at] = right / pivot;
            bends[at] = (6.0 * (slope[at] - slope[at - 1]) - left * bends[at - 1]) / pivot;
        }
        for at in (1..count - 1).rev() {
            bends[at] -= above[at] * bends[at + 1];
        }
        Self { places, values, bends }
    }

    /// The value at `place`, which lies between the first and the last.
    ///
    /// We let the value leave the range of the four values around `place` by at most the width of this
    /// range. Smooth curves stay well within. Without this limit, two readings of a noisy spectrum at almost
    /// equal wavelengths would make the curve swing.
    pub(crate) fn at(&self, place: f64) -> f64 {
        let after = self.places.partition_point(|&p| p < place).clamp(1, self.places.len() - 1);
        let before = after - 1;
        let width = self.places[after] - self.places[before];
        let a = (self.places[after] - place) / width;
        let b = (place - self.places[before]) / width;
        let bend = (a * a * a - a) * self.bends[before] + (b * b * b - b) * self.bends[after];
        let value = a * self.values[before] + b * self.values[after] + bend * width * width / 6.0;
        let around = &self.values[before.saturating_sub(1)..(after + 2).min(self.values.len())];
        let least = around.iter().copied().fold(f64::INFINITY, f64::min);
        let most = around.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        value.clamp(2.0 * least - most, 2.0 * most - least)
    }
}

/// Fourth differences of values at a regular step, relative to their second differences (roots of the sums
/// of squares). You get 0 for a straight line, about 1 to 2.7 for lamps that are smooth at this step, and 3.4
/// for single lines and for noise. `None` for fewer than eight values.
pub(crate) fn roughness(values: &[f64]) -> Option<f64> {
    if values.len() < 8 {
        return None;
    }
    let bends = |values: &[f64]| -> Vec<f64> {
        values.windows(3).map(|three| three[0] - 2.0 * three[1] + three[2]).collect()
    };
    let size = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>().sqrt();
    let second = bends(values);
    let fourth = bends(&second);
    let bend = size(&second);
    // Rounding and noise bend a straight line by so little. Then every interpolation will do.
    let is_straight = bend <= 0.01 * size(values);
    Some(if is_straight { 0.0 } else { size(&fourth) / bend })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roughness_grows_from_lines_by_way_of_peaks_to_spikes() {
        let ramp: Vec<f64> = (0..20).map(|at| 0.1 * f64::from(at)).collect();
        let peak = |width: f64| -> Vec<f64> {
            (-15..=15).map(|at| (-(f64::from(at) / width).powi(2)).exp()).collect()
        };
        let found = [ramp, peak(4.0), peak(1.5), peak(0.1)].map(|v| roughness(&v).unwrap());
        assert!(found[0] == 0.0 && found[3] > 3.4, "{found:?}");
        assert!(found.is_sorted(), "{found:?}");
        assert_eq!(roughness(&[1.0; 7]), None);
    }

    #[test]
    fn sprague_is_exact_for_polynomials_of_degree_four_inside() {
        let grid = Grid::from_nm(400.0, 10.0, 12).unwrap();
        let values: Vec<f64> = grid.wavelengths_nm().map(polynomial).collect();
        for nm in [420.0, 423.7, 455.5, 489.9] {
            let row = Interpolation::Sprague.row(grid, nm, Extrapolation::Refuse).unwrap();
            assert!((row.apply(&values) - polynomial(nm)).abs() < 1e-12, "at {nm} nm");
        }
    }

    fn polynomial(nm: f64) -> f64 {
        let x = (nm - 450.0) / 50.0;
        1.0 + x - 2.0 * x * x + 0.5 * x.powi(3) + 0.25 * x.powi(4)
    }

    #[test]
    fn a_constant_stays_constant_up_to_both_ends() {
        let grid = Grid::from_nm(400.0, 10.0, 6).unwrap();
        for method in [Interpolation::Linear, Interpolation::Sprague] {
            for tenth in 0..=500 {
                let nm = 400.0 + f64::from(tenth) / 10.0;
                let row = method.row(grid, nm, Extrapolation::Refuse).unwrap();
                assert!((row.apply(&[0.7; 6]) - 0.7).abs() < 1e-12, "{method:?} at {nm} nm");
            }
        }
    }

    #[test]
    fn outside_the_band_evaluation_fails_or_holds_the_end_value() {
        let grid = Grid::from_nm(400.0, 10.0, 3).unwrap();
        let refused = Interpolation::Linear.row(grid, 399.0, Extrapolation::Refuse);
        assert!(matches!(refused, Err(InterpolateError::Outside { .. })), "{refused:?}");
        let held = Interpolation::Linear.row(grid, 721.0, Extrapolation::Hold).unwrap();
        assert_eq!(held.apply(&[1.0, 2.0, 3.0]), 3.0);
    }

    #[test]
    fn a_spline_passes_through_its_values_with_one_slope_on_both_sides() {
        let places = [0.0, 1.0, 2.5, 3.0, 5.0, 5.5];
        let values = [1.0, 0.0, 4.0, 2.0, 2.0, -1.0];
        let spline = Spline::through(&places, &values);
        for (place, value) in places.iter().zip(values) {
            assert!((spline.at(*place) - value).abs() < 1e-12);
        }
        for place in &places[1..5] {
            let [above, below] = [*place, place - 1e-6]
                .map(|place| (spline.at(place + 1e-6) - spline.at(place)) / 1e-6);
            assert!((above - below).abs() < 1e-4, "at {place}");
        }
        let line = places.map(|place| 3.0 - 2.0 * place);
        assert!((Spline::through(&places, &line).at(1.7) - (3.0 - 3.4)).abs() < 1e-12);
    }

    #[test]
    fn two_noisy_values_at_almost_one_place_do_not_swing_the_curve() {
        let places = [400.0, 410.0, 420.0, 420.01, 430.0, 440.0];
        let values = [0.5, 0.5, 0.49, 0.51, 0.5, 0.5];
        let spline = Spline::through(&places, &values);
        for tenth in 4000..=4400 {
            let value = spline.at(f64::from(tenth) / 10.0);
            assert!((0.46..0.54).contains(&value), "{value} at {tenth} tenths");
        }
    }
}
