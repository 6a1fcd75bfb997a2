//! Series of numbers: means, deviations, trends and correlations.

/// Mean; not a number for an empty series.
#[must_use]
pub fn mean(series: &[f64]) -> f64 {
    series.iter().sum::<f64>() / series.len() as f64
}

/// Root of the mean square; not a number for an empty series.
#[must_use]
pub fn rms(series: &[f64]) -> f64 {
    (series.iter().map(|value| value * value).sum::<f64>() / series.len() as f64).sqrt()
}

/// Root of the mean squared deviation from the mean.
#[must_use]
pub fn deviation(series: &[f64]) -> f64 {
    let mean = mean(series);
    rms(&series.iter().map(|value| value - mean).collect::<Vec<_>>())
}

/// Largest minus smallest value, over the mean.
#[must_use]
pub fn spread_over_mean(series: &[f64]) -> f64 {
    let (lowest, highest) = ends(series);
    (highest - lowest) / mean(series)
}

/// Smallest and largest value.
#[must_use]
pub fn ends(series: &[f64]) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    series.iter().fold(start, |(low, high), &value| (low.min(value), high.max(value)))
}

/// Smallest ratio of a value to the one before it: above 1 where all values rise.
#[must_use]
pub fn least_rise(series: &[f64]) -> f64 {
    series.windows(2).map(|pair| pair[1] / pair[0]).fold(f64::INFINITY, f64::min)
}

/// Share `quantile` (0 to 1) of the values lies below; not a number for an empty series.
#[must_use]
pub fn quantile(series: &[f64], quantile: f64) -> f64 {
    let mut sorted = series.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = (quantile * sorted.len() as f64) as usize;
    sorted.get(place.min(sorted.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
}

/// Polynomial of degree `N - 1` nearest to `values` at `places` (least squares), as its values
/// there.
#[must_use]
pub fn fitted<const N: usize>(places: &[f64], values: &[f64]) -> Vec<f64> {
    let middle = mean(places);
    let reach = places.iter().map(|x| (x - middle).abs()).fold(1e-9, f64::max);
    let powers = |x: f64| -> [f64; N] {
        std::array::from_fn(|power| ((x - middle) / reach).powi(power as i32))
    };
    // Normal equations, solved by elimination; the powers are of the order of 1.
    let mut rows = vec![vec![0.0; N + 1]; N];
    for (&x, &value) in places.iter().zip(values) {
        let powers = powers(x);
        for (row, a) in rows.iter_mut().zip(powers) {
            for (sum, b) in row.iter_mut().zip(powers.into_iter().chain([value])) {
                *sum += a * b;
            }
        }
    }
    for pivot in 0..N {
        let lead = rows[pivot].clone();
        for (index, row) in rows.iter_mut().enumerate() {
            if index != pivot && lead[pivot] != 0.0 {
                let factor = row[pivot] / lead[pivot];
                row.iter_mut().zip(&lead).for_each(|(value, lead)| *value -= factor * lead);
            }
        }
    }
    let factor =
        |row: usize| if rows[row][row] == 0.0 { 0.0 } else { rows[row][N] / rows[row][row] };
    places
        .iter()
        .map(|x: &f64| powers(*x).iter().enumerate().map(|(i, power)| factor(i) * power).sum())
        .collect()
}

/// Series minus its nearest parabola.
#[must_use]
pub fn without_parabola(series: &[f64]) -> Vec<f64> {
    let places: Vec<f64> = (0..series.len()).map(|index| index as f64).collect();
    let trend = fitted::<3>(&places, series);
    series.iter().zip(trend).map(|(value, trend)| value - trend).collect()
}

/// Pearson's correlation of two series of one length; 0 if one is constant.
#[must_use]
pub fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean_a = mean(a);
    let mean_b = mean(b);
    let pairs = || a.iter().zip(b).map(|(a, b)| (a - mean_a, b - mean_b));
    let covariance: f64 = pairs().map(|(a, b)| a * b).sum();
    let power: f64 =
        pairs().map(|(a, _)| a * a).sum::<f64>() * pairs().map(|(_, b)| b * b).sum::<f64>();
    if power > 0.0 { covariance / power.sqrt() } else { 0.0 }
}

/// Slope of the line that fits `b` best as a function of `a`: the share of a relief `a` that
/// shows in `b`.
#[must_use]
pub fn slope(a: &[f64], b: &[f64]) -> f64 {
    let mean_a = mean(a);
    let mean_b = mean(b);
    let covariance: f64 = a.iter().zip(b).map(|(a, b)| (a - mean_a) * (b - mean_b)).sum();
    let variance: f64 = a.iter().map(|a| (a - mean_a) * (a - mean_a)).sum();
    if variance > 0.0 { covariance / variance } else { 0.0 }
}

/// Autocorrelation at `lags` (in values), averaged over several series: the sum of products over
/// that of squares, each per value. The series have no trend.
#[must_use]
pub fn autocorrelation(all: &[Vec<f64>], lags: std::ops::Range<usize>) -> Vec<f64> {
    let product = |lag: usize| {
        let mut sum = 0.0;
        let mut count = 0.0;
        for series in all {
            for (a, b) in series.iter().zip(series.iter().skip(lag)) {
                sum += a * b;
                count += 1.0;
            }
        }
        sum / f64::max(count, 1.0)
    };
    let power = product(0);
    lags.map(|lag| if power > 0.0 { product(lag) / power } else { 0.0 }).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::near::assert_near;

    fn wave(count: usize, period: f64) -> Vec<f64> {
        (0..count).map(|index| (index as f64 / period * TAU).sin()).collect()
    }

    #[test]
    fn means_and_deviations_of_known_series() {
        assert_near(
            "mean and rms",
            &[mean(&[3.0, 5.0]), rms(&[3.0, 5.0])],
            &[4.0, 17f64.sqrt()],
            1e-12,
        );
        assert_near("deviation", &[deviation(&[3.0, 5.0])], &[1.0], 1e-12);
        assert_near("spread", &[spread_over_mean(&[3.0, 4.0, 5.0])], &[0.5], 1e-12);
        assert_near("rise", &[least_rise(&[1.0, 3.0, 4.5])], &[1.5], 1e-12);
        assert_near("median", &[quantile(&[9.0, 1.0, 5.0], 0.5)], &[5.0], 0.0);
        assert!(quantile(&[], 0.5).is_nan() && mean(&[]).is_nan(), "nothing has no median");
    }

    #[test]
    fn a_parabola_is_taken_away_and_a_wave_on_it_stays() {
        let wave = wave(200, 10.0);
        let bent = |index: usize| 3.0 + 0.2 * index as f64 - 0.01 * (index * index) as f64;
        let on_it: Vec<f64> = wave.iter().enumerate().map(|(i, value)| value + bent(i)).collect();
        let left = without_parabola(&on_it);
        assert_near("rms of the wave", &[rms(&left)], &[0.5f64.sqrt()], 0.01);
        let line = fitted::<2>(&[1.0, 2.0, 4.0], &[3.0, 5.0, 9.0]);
        assert_near("a line", &line, &[3.0, 5.0, 9.0], 1e-9);
    }

    #[test]
    fn waves_correlate_with_themselves_and_not_across_a_quarter() {
        let wave = wave(400, 20.0);
        let shifted = |lag: usize| correlation(&wave[..380], &wave[lag..380 + lag]);
        assert_near(
            "correlation",
            &[shifted(20), shifted(10), shifted(5)],
            &[1.0, -1.0, 0.0],
            1e-9,
        );
        assert_eq!(correlation(&[1.0, 1.0], &[1.0, 2.0]), 0.0);
    }

    #[test]
    fn a_relief_shows_by_the_slope_whatever_lies_beside_it() {
        let relief: Vec<f64> = (0..300).map(|i| (f64::from(i) * 0.7).sin()).collect();
        let other = |i: usize| 5.0 + (i as f64 * 0.31).cos();
        let top: Vec<f64> = relief.iter().enumerate().map(|(i, z)| 0.25 * z + other(i)).collect();
        let found = slope(&relief, &top);
        assert!((found - 0.25).abs() < 0.02, "{found}");
        assert_eq!(slope(&[1.0; 9], &[2.0; 9]), 0.0);
    }

    #[test]
    fn a_period_shows_in_the_autocorrelation() {
        let found = autocorrelation(&[wave(400, 20.0), wave(600, 20.0)], 5..21);
        let parts = [found[0], found[5], found[15]];
        assert_near("quarter, half and whole period", &parts, &[0.0, -1.0, 1.0], 0.02);
    }
}
