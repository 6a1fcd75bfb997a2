//! The natural cubic spline through values at irregular places.

/// A curve of cubic pieces whose slope and second derivative are continuous, and whose second
/// derivative is 0 at both ends (de Boor 1978, chapter 4).
#[derive(Debug)]
pub(crate) struct Spline<'a> {
    places: &'a [f64],
    values: &'a [f64],
    /// Second derivative at each place.
    bends: Vec<f64>,
}

impl<'a> Spline<'a> {
    /// The spline through `values` at `places`: as many of each, two or more, and the places rise
    /// strictly.
    pub(crate) fn through(places: &'a [f64], values: &'a [f64]) -> Self {
        let count = places.len();
        let width = |at: usize| places[at + 1] - places[at];
        let slope = |at: usize| (values[at + 1] - values[at]) / width(at);
        // The tridiagonal system of the inner second derivatives, eliminated downwards, solved upwards.
        let mut bends = vec![0.0; count];
        let mut above = vec![0.0; count];
        for at in 1..count - 1 {
            let left = width(at - 1);
            let right = width(at);
            let pivot = 2.0 * (left + right) - left * above[at - 1];
            above[at] = right / pivot;
            bends[at] = (6.0 * (slope(at) - slope(at - 1)) - left * bends[at - 1]) / pivot;
        }
        for at in (1..count - 1).rev() {
            bends[at] -= above[at] * bends[at + 1];
        }
        Self { places, values, bends }
    }

    /// The value at `place`, which lies between the first and the last.
    ///
    /// It leaves the range of the four values around it by at most the width of that range. Smooth
    /// values stay well within; two readings of a noisy spectrum at almost one place would otherwise
    /// swing the curve beside them.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spline_passes_through_its_values_with_one_slope_on_both_sides() {
        let places = [0.0, 1.0, 2.5, 3.0, 5.0, 5.5];
        let values = [1.0, 0.0, 4.0, 2.0, 2.0, -1.0];
        let spline = Spline::through(&places, &values);
        for (place, value) in places.iter().zip(values) {
            assert!((spline.at(*place) - value).abs() < 1e-12);
        }
        let slope = |place: f64| (spline.at(place + 1e-6) - spline.at(place)) / 1e-6;
        for place in &places[1..5] {
            assert!((slope(*place) - slope(place - 1e-6)).abs() < 1e-4, "at {place}");
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
