//! Pure measures of heights in mm: how far the edges of a mark deviate from straight lines, how
//! even a surface is (saw-tooth, pits, colour), which waves a profile has, and where the mark of a
//! stroke along x begins and ends, how wide and thick it is and which lips it has. Also means,
//! trends and correlations of series.

use std::f64::consts::{LN_2, PI, TAU};
use std::ops::Range;

use spectra::color::{Lab, delta_e_ciede2000};

use super::heights::Heights;

/// How far the upper and the lower edge of a mark deviate from straight lines, in mm, over
/// `columns`: root of the mean squared distance from the nearest line. Going inwards, the edge of a
/// column is where the height first reaches half of the film, between the centres of cells. The
/// film of a column is the mean over the middle 60 % of its width, smoothed over 5 mm along the
/// mark. Returns `None` if a column has no paint.
#[must_use]
pub fn edge_deviations_mm(heights: &Heights, columns: Range<usize>) -> Option<[f64; 2]> {
    let cell_mm = heights.cell_mm();
    let profiles: Vec<Vec<f64>> = columns.map(|x| heights.across(x..x + 1)).collect();
    let films = profiles
        .iter()
        .map(|profile: &Vec<f64>| {
            let (top, bottom) = extent_mm(profile, cell_mm)?;
            let narrow = 0.2 * (bottom - top);
            Some(mean(&profile[heights.rows_in(top + narrow..bottom - narrow)]))
        })
        .collect::<Option<Vec<_>>>()?;
    let levels = smoothed(&films, cell_mm, 5.0);
    let edges = |find: fn(&[f64], f64, f64) -> Option<f64>| {
        let pairs = profiles.iter().zip(&levels);
        pairs
            .map(|(profile, level)| find(profile, cell_mm, 0.5 * level))
            .collect::<Option<Vec<_>>>()
    };
    Some([
        line_deviation(&edges(first_crossing)?, cell_mm),
        line_deviation(&edges(last_crossing)?, cell_mm),
    ])
}

/// Root of the mean squared distance of `places` from the nearest straight line, perpendicular to
/// the line. There is a place every `step`.
#[must_use]
pub fn line_deviation(places: &[f64], step: f64) -> f64 {
    let along: Vec<f64> = (0..places.len()).map(|index| index as f64 * step).collect();
    let line = fitted::<2>(&along, places);
    let off: Vec<f64> = places.iter().zip(&line).map(|(place, line)| place - line).collect();
    let rise = match line[..] {
        [first, .., last] => (last - first) / (along[along.len() - 1]),
        _ => 0.0,
    };
    rms(&off) / rise.hypot(1.0)
}

/// Root of the mean squared second difference between neighbouring cells along x and along y, in
/// mm. A chequerboard of amplitude a gives 4 a, for example, and a plane gives 0.
#[must_use]
pub fn second_differences_mm(
    heights: &Heights,
    columns: Range<usize>,
    rows: Range<usize>,
) -> [f64; 2] {
    let mut along = Vec::new();
    let mut across = Vec::new();
    for y in rows.start.max(1)..rows.end.min(heights.rows().saturating_sub(1)) {
        for x in columns.start.max(1)..columns.end.min(heights.columns() - 1) {
            let twice = 2.0 * heights.at(x, y);
            along.push(heights.at(x - 1, y) + heights.at(x + 1, y) - twice);
            across.push(heights.at(x, y - 1) + heights.at(x, y + 1) - twice);
        }
    }
    [rms(&along), rms(&across)]
}

/// Share of the cells chosen by `inside` (column, row) that are lower than a fifth of the median
/// of the cells within 1 mm along x and y.
#[must_use]
pub fn pits(heights: &Heights, inside: impl Fn(usize, usize) -> bool) -> f64 {
    let reach = (1.0 / heights.cell_mm()).round() as usize;
    let mut low = 0_usize;
    let mut count = 0_usize;
    for y in 0..heights.rows() {
        for x in (0..heights.columns()).filter(|&x| inside(x, y)) {
            let columns = x.saturating_sub(reach)..(x + reach + 1).min(heights.columns());
            let rows = y.saturating_sub(reach)..(y + reach + 1).min(heights.rows());
            let median = quantile(&heights.part(columns, rows), 0.5);
            low += usize::from(heights.at(x, y) < 0.2 * median);
            count += 1;
        }
    }
    low as f64 / count as f64
}

/// Mean CIEDE2000 of colours from their mean.
#[must_use]
pub fn color_spread(colors: &[Lab]) -> f64 {
    let [lightness, a, b] = [0, 1, 2].map(|part: usize| {
        mean(&colors.iter().map(|lab| lab.to_array()[part]).collect::<Vec<_>>())
    });
    let center = Lab { lightness, a, b };
    mean(&colors.iter().map(|&lab| delta_e_ciede2000(center, lab)).collect::<Vec<_>>())
}

/// Profile without waves shorter than `cut_mm`. This is the Gaussian filter of surface texture (ISO
/// 16610-21:2011, equation 1), which passes half of a wave of that length. Near the ends it
/// normalises the weights inside. `step_mm` is the distance of two values.
#[must_use]
pub fn smoothed(profile: &[f64], step_mm: f64, cut_mm: f64) -> Vec<f64> {
    let width = (LN_2 / PI).sqrt() * cut_mm;
    let reach = (2.0 * width / step_mm).ceil() as usize;
    let weights: Vec<f64> =
        (0..=reach).map(|lag| (-PI * (lag as f64 * step_mm / width).powi(2)).exp()).collect();
    let values = (0..profile.len()).map(|index| {
        let first = index.saturating_sub(reach);
        let last = (index + reach).min(profile.len() - 1);
        let mut sum = 0.0;
        let mut whole = 0.0;
        for (other, value) in profile.iter().enumerate().take(last + 1).skip(first) {
            let weight = weights[index.abs_diff(other)];
            sum += weight * value;
            whole += weight;
        }
        sum / whole
    });
    values.collect()
}

/// Profile minus [`smoothed`]: waves shorter than `cut_mm`.
#[must_use]
pub fn rough(profile: &[f64], step_mm: f64, cut_mm: f64) -> Vec<f64> {
    let smooth = smoothed(profile, step_mm, cut_mm);
    profile.iter().zip(smooth).map(|(value, smooth)| value - smooth).collect()
}

/// Power of the wave of `per_mm` waves a mm in a profile, under a Hann window.
fn power(profile: &[f64], step_mm: f64, per_mm: f64) -> f64 {
    let count = profile.len() as f64;
    let mut real = 0.0;
    let mut imaginary = 0.0;
    for (index, value) in profile.iter().enumerate() {
        let window = 0.5 - 0.5 * ((index as f64 + 0.5) / count * TAU).cos();
        let (sin, cos) = (index as f64 * step_mm * per_mm * TAU).sin_cos();
        real += window * value * cos;
        imaginary += window * value * sin;
    }
    (real * real + imaginary * imaginary) / (count * count)
}

/// Wavelength in mm at the peak of the mean power spectrum of several profiles of equal length,
/// after subtracting the parabola of each. Searches waves from two cells to two thirds of the
/// length, in steps of a quarter of a wave per length. Returns NaN without profiles or relief.
#[must_use]
pub fn peak_wavelength_mm(profiles: &[Vec<f64>], step_mm: f64) -> f64 {
    let length_mm = profiles.first().map_or(0.0, |profile| profile.len() as f64 * step_mm);
    let flat: Vec<Vec<f64>> = profiles.iter().map(|profile| without_parabola(profile)).collect();
    let mut best = (0.0, f64::NAN);
    let mut waves = 1.5;
    while waves / length_mm <= 0.5 / step_mm {
        let per_mm = waves / length_mm;
        let whole: f64 = flat.iter().map(|profile| power(profile, step_mm, per_mm)).sum();
        if whole > best.0 {
            best = (whole, 1.0 / per_mm);
        }
        waves += 0.25;
    }
    best.1
}

/// Mean. An empty series gives NaN.
#[must_use]
pub fn mean(series: &[f64]) -> f64 {
    series.iter().sum::<f64>() / series.len() as f64
}

/// Root of the mean square. An empty series gives NaN.
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

/// Smallest ratio of a value to the one before it. This is above 1 if all values rise.
#[must_use]
pub fn least_rise(series: &[f64]) -> f64 {
    series.windows(2).map(|pair| pair[1] / pair[0]).fold(f64::INFINITY, f64::min)
}

/// The value with the share `quantile` (0 to 1) of the values below it. An empty series gives NaN.
#[must_use]
pub fn quantile(series: &[f64], quantile: f64) -> f64 {
    let mut sorted = series.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = (quantile * sorted.len() as f64) as usize;
    sorted.get(place.min(sorted.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
}

/// Polynomial of degree `N - 1` nearest to `values` at `places` (least squares). Returns its values
/// at these places.
#[must_use]
pub fn fitted<const N: usize>(places: &[f64], values: &[f64]) -> Vec<f64> {
    let middle = mean(places);
    let reach = places.iter().map(|x| (x - middle).abs()).fold(1e-9, f64::max);
    let powers = |x: f64| -> [f64; N] {
        std::array::from_fn(|power| ((x - middle) / reach).powi(power as i32))
    };
    // Solves the normal equations by elimination. The powers are of the order of 1.
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
    let factors: Vec<f64> = (0..N)
        .map(|row| if rows[row][row] == 0.0 { 0.0 } else { rows[row][N] / rows[row][row] })
        .collect();
    places
        .iter()
        .map(|&x| factors.iter().zip(powers(x)).map(|(factor, power)| factor * power).sum())
        .collect()
}

/// Series minus its nearest parabola.
#[must_use]
pub fn without_parabola(series: &[f64]) -> Vec<f64> {
    let places: Vec<f64> = (0..series.len()).map(|index| index as f64).collect();
    let trend = fitted::<3>(&places, series);
    series.iter().zip(trend).map(|(value, trend)| value - trend).collect()
}

/// Pearson's correlation of two series of one length. If one is constant, this is 0.
#[must_use]
pub fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean_a = mean(a);
    let mean_b = mean(b);
    let pairs: Vec<(f64, f64)> = a.iter().zip(b).map(|(a, b)| (a - mean_a, b - mean_b)).collect();
    let covariance: f64 = pairs.iter().map(|(a, b)| a * b).sum();
    let power: f64 = pairs.iter().map(|(a, _)| a * a).sum::<f64>()
        * pairs.iter().map(|(_, b)| b * b).sum::<f64>();
    if power > 0.0 { covariance / power.sqrt() } else { 0.0 }
}

/// Slope of the best line for `b` as a function of `a`: the share of a relief `a` that you see in
/// `b`.
#[must_use]
pub fn slope(a: &[f64], b: &[f64]) -> f64 {
    let mean_a = mean(a);
    let mean_b = mean(b);
    let covariance: f64 = a.iter().zip(b).map(|(a, b)| (a - mean_a) * (b - mean_b)).sum();
    let variance: f64 = a.iter().map(|a| (a - mean_a) * (a - mean_a)).sum();
    if variance > 0.0 { covariance / variance } else { 0.0 }
}

/// Autocorrelation at `lags` (in values), averaged over several series: the mean product divided by
/// the mean square. The series must have no trend.
#[must_use]
pub fn autocorrelation(all: &[Vec<f64>], lags: Range<usize>) -> Vec<f64> {
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

/// Distance in mm from the start of a mark, and from its end, to its steady part.
const SETTLED_MM: (f64, f64) = (10.0, 5.0);

/// Shortest steady part in mm.
const SHORTEST_MM: f64 = 5.0;

/// Distance in mm from an edge of a mark within which its lip is searched.
const LIP_MM: f64 = 1.5;

/// The mark of a stroke along x. All lengths are in mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Columns of the steady part.
    pub steady: Range<usize>,
    /// Distance from the upper edge of the canvas to both edges of the mark.
    pub edges_mm: (f64, f64),
    /// Rows of the middle 60 % of the width.
    pub middle: Range<usize>,
    /// Mean height of the wet paint in these rows, over the steady part.
    pub film_mm: f64,
    /// Place along x where the mark begins.
    pub start_mm: f64,
}

/// Distance in mm at which `profile` first reaches `level`, between the centres of two cells.
#[must_use]
pub fn first_crossing(profile: &[f64], step_mm: f64, level: f64) -> Option<f64> {
    let index = profile.iter().position(|&value| value >= level)?;
    let before = index.checked_sub(1).map_or(0.0, |before| profile[before]);
    let share = (level - before) / (profile[index] - before);
    Some(((index as f64 - 0.5 + share) * step_mm).max(0.0))
}

/// Distance in mm at which `profile` last falls below `level`, between the centres of two cells.
#[must_use]
pub fn last_crossing(profile: &[f64], step_mm: f64, level: f64) -> Option<f64> {
    let reversed: Vec<f64> = profile.iter().rev().copied().collect();
    let from_end = first_crossing(&reversed, step_mm, level)?;
    Some(profile.len() as f64 * step_mm - from_end)
}

/// Both outermost places in mm at which a profile crosses half of its covered cells' median.
#[must_use]
pub fn extent_mm(profile: &[f64], step_mm: f64) -> Option<(f64, f64)> {
    extent_at_mm(profile, step_mm, 0.5)
}

/// Both outermost places in mm at which a profile crosses a share of its covered cells' median.
fn extent_at_mm(profile: &[f64], step_mm: f64, share: f64) -> Option<(f64, f64)> {
    let highest = profile.iter().fold(0.0, |a: f64, &b| a.max(b));
    let covered: Vec<f64> = profile.iter().copied().filter(|&mm| mm > 0.05 * highest).collect();
    let level = share * quantile(&covered, 0.5);
    if level.is_nan() || level <= 0.0 {
        return None;
    }
    Some((first_crossing(profile, step_mm, level)?, last_crossing(profile, step_mm, level)?))
}

impl Mark {
    /// The only mark in `heights`. Returns `None` if there is less than 20 mm of paint.
    #[must_use]
    pub fn along_x(heights: &Heights) -> Option<Self> {
        Self::within(heights, 0.0..heights.columns() as f64 * heights.cell_mm())
    }

    /// The mark between two distances in mm from the left edge. It begins and ends where the mean
    /// of a column crosses a tenth of the median of all covered columns.
    #[must_use]
    pub fn within(heights: &Heights, x_mm: Range<f64>) -> Option<Self> {
        let cell_mm = heights.cell_mm();
        let part = heights.columns_in(x_mm);
        let columns = &heights.along(0..heights.rows())[part.clone()];
        let (from, to) = extent_at_mm(columns, cell_mm, 0.1)?;
        let left_mm = part.start as f64 * cell_mm;
        let start_mm = left_mm + from;
        let end_mm = left_mm + to;
        if end_mm - start_mm < SETTLED_MM.0 + SETTLED_MM.1 + SHORTEST_MM {
            return None;
        }
        let steady = heights.columns_in(start_mm + SETTLED_MM.0..end_mm - SETTLED_MM.1);
        let profile = heights.across(steady.clone());
        let (top, bottom) = extent_mm(&profile, cell_mm)?;
        let narrow = 0.2 * (bottom - top);
        let middle = heights.rows_in(top + narrow..bottom - narrow);
        let film_mm = mean(&profile[middle.clone()]);
        Some(Self { steady, edges_mm: (top, bottom), middle, film_mm, start_mm })
    }

    /// Width in mm.
    #[must_use]
    pub fn width_mm(&self) -> f64 {
        self.edges_mm.1 - self.edges_mm.0
    }

    /// Mean film in mm between two distances in mm from the start of the mark.
    #[must_use]
    pub fn film_in(&self, heights: &Heights, mm: Range<f64>) -> f64 {
        let columns = heights.columns_in(self.start_mm + mm.start..self.start_mm + mm.end);
        mean(&heights.part(columns, self.middle.clone()))
    }

    /// Highest place of the mean profile across, near the upper and near the lower edge, relative
    /// to the film.
    #[must_use]
    pub fn side_lips(&self, heights: &Heights) -> [f64; 2] {
        let profile = heights.across(self.steady.clone());
        let (top, bottom) = self.edges_mm;
        [top, bottom].map(|edge| {
            let rows = heights.rows_in(edge - LIP_MM..edge + LIP_MM);
            profile[rows].iter().fold(0.0, |a: f64, &b| a.max(b)) / self.film_mm
        })
    }

    /// Highest place of the mean profile along the last `LIP_MM` mm before the mark's end, relative
    /// to the film from 15 to 5 mm before it.
    #[must_use]
    pub fn end_lip(&self, heights: &Heights) -> f64 {
        let profile = heights.along(self.middle.clone());
        let Some((_, end)) = self.ends_mm(heights) else { return f64::NAN };
        let film = mean(&profile[heights.columns_in(end - 15.0..end - 5.0)]);
        let last = &profile[heights.columns_in(end - 2.0 * LIP_MM..end + LIP_MM)];
        last.iter().fold(0.0, |a: f64, &b| a.max(b)) / film
    }

    /// Places in mm along x where the mean film begins and ends: where it crosses half of the film
    /// of the first and of the last 10 mm of the steady part.
    #[must_use]
    pub fn ends_mm(&self, heights: &Heights) -> Option<(f64, f64)> {
        let profile = heights.along(self.middle.clone());
        let ten = (10.0 / heights.cell_mm()) as usize;
        let Range { start, end } = self.steady;
        let first = mean(&profile[start..(start + ten).min(end)]);
        let last = mean(&profile[end.saturating_sub(ten).max(start)..end]);
        let from = first_crossing(&profile, heights.cell_mm(), 0.5 * first)?;
        Some((from, last_crossing(&profile, heights.cell_mm(), 0.5 * last)?))
    }
}

#[cfg(test)]
mod series_tests {
    use super::*;
    use crate::golden::assert_near;
    use std::f64::consts::TAU;

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
        let on_it: Vec<f64> = (0_u32..)
            .zip(&wave)
            .map(|(i, value)| value + (3.0 + 0.2 * f64::from(i) - 0.01 * f64::from(i * i)))
            .collect();
        let left = without_parabola(&on_it);
        assert_near("rms of the wave", &[rms(&left)], &[0.5f64.sqrt()], 0.01);
        let line = fitted::<2>(&[1.0, 2.0, 4.0], &[3.0, 5.0, 9.0]);
        assert_near("a line", &line, &[3.0, 5.0, 9.0], 1e-9);
    }

    #[test]
    fn waves_correlate_with_themselves_and_not_across_a_quarter() {
        let wave = wave(400, 20.0);
        let found = [20, 10, 5].map(|lag| correlation(&wave[..380], &wave[lag..380 + lag]));
        assert_near("correlation", &found, &[1.0, -1.0, 0.0], 1e-9);
        assert_eq!(correlation(&[1.0, 1.0], &[1.0, 2.0]), 0.0);
    }

    #[test]
    fn a_relief_shows_by_the_slope_whatever_lies_beside_it() {
        let relief: Vec<f64> = (0..300).map(|i| (f64::from(i) * 0.7).sin()).collect();
        let top: Vec<f64> = (0_u32..)
            .zip(&relief)
            .map(|(i, z)| 0.25 * z + (5.0 + (f64::from(i) * 0.31).cos()))
            .collect();
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

#[cfg(test)]
mod mark_tests {
    use super::*;
    use crate::golden::assert_near;

    /// A mark from x 8 to 62.3 mm and y 5.03 to 15.03 mm, `film` high, with lips 0.5 mm wide.
    fn stroke(film: impl Fn(f64) -> f64, side: f64, end: f64) -> Heights {
        fn inside(at: f64, from: f64, to: f64) -> f64 {
            ((at - from) / 0.1 + 0.5).clamp(0.0, 1.0) * ((to - at) / 0.1 + 0.5).clamp(0.0, 1.0)
        }
        Heights::from_places(0.1, (80.0, 20.0), |x, y| {
            let near_side = (5.5..14.5).contains(&y);
            let lip = if x > 61.5 {
                end
            } else if near_side {
                1.0
            } else {
                side
            };
            film(x) * lip * inside(x, 8.0, 62.3) * inside(y, 5.03, 15.03)
        })
    }

    #[test]
    fn width_film_and_lips_of_a_known_mark() {
        let heights = stroke(|_| 0.2, 1.8, 1.4);
        let mark = Mark::along_x(&heights).unwrap();
        assert_near("edges", &[mark.edges_mm.0, mark.edges_mm.1], &[5.03, 15.03], 0.05);
        assert_near("film", &[mark.film_mm, mark.film_in(&heights, 0.5..50.0)], &[0.2; 2], 1e-9);
        assert_near("lips", &mark.side_lips(&heights), &[1.8, 1.8], 1e-9);
        assert_near("end", &[mark.end_lip(&heights)], &[1.4], 1e-9);
        assert_near("width", &[mark.width_mm()], &[10.0], 0.1);
    }

    #[test]
    fn ends_are_found_where_half_of_the_near_film_is_left() {
        fn falling(x: f64) -> f64 {
            0.4 - 0.005 * x
        }
        let heights = stroke(falling, 1.0, 1.0);
        let mark = Mark::along_x(&heights).unwrap();
        let (from, to) = mark.ends_mm(&heights).unwrap();
        assert_near("ends", &[from, to], &[8.0, 62.3], 0.05);
        let first = mark.film_in(&heights, 9.0..11.0);
        let last = mark.film_in(&heights, 49.0..51.0);
        assert_near("film falls", &[first, last], &[falling(18.0), falling(58.0)], 1e-3);
    }

    #[test]
    fn a_mark_is_found_beside_others_and_a_short_one_is_none() {
        let heights = stroke(|x| if x < 25.0 { 2.0 } else { 0.1 }, 1.0, 1.0);
        let mark = Mark::within(&heights, 30.0..80.0).unwrap();
        assert_near("film", &[mark.film_mm, mark.start_mm], &[0.1, 30.0], 0.01);
        assert_eq!((mark.steady.start, mark.steady.end), (400, 573));
        assert_eq!(Mark::within(&heights, 50.0..80.0), None);
    }

    #[test]
    fn no_paint_leaves_no_mark() {
        let bare = Heights::from_places(0.1, (80.0, 20.0), |_, _| 0.0);
        assert_eq!(Mark::along_x(&bare), None);
        assert_eq!(extent_mm(&[], 0.1), None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::golden::assert_near;
    use std::f64::consts::TAU;

    /// A mark 6 mm wide with its upper edge at `edge(x)`. Cells hold their covered share.
    fn mark(edge: impl Fn(f64) -> f64) -> Heights {
        fn share(inside: f64) -> f64 {
            (inside / 0.1 + 0.5).clamp(0.0, 1.0)
        }
        Heights::from_places(0.1, (40.0, 30.0), |x, y| {
            0.1 * share(y - edge(x)) * share(edge(x) + 6.0 - y)
        })
    }

    #[test]
    fn a_straight_edge_deviates_by_little_whatever_its_direction() {
        for slope in [0.0, 0.1, 10f64.to_radians().tan()] {
            let heights = mark(|x| 10.0 + slope * x);
            let [upper, lower] = edge_deviations_mm(&heights, 0..400).unwrap();
            assert!(upper < 0.008 && lower < 0.008, "{slope}: {upper} {lower}");
        }
    }

    #[test]
    fn a_wavy_edge_deviates_by_its_rms_and_stairs_by_those_of_a_step() {
        let heights = mark(|x| 10.0 + 0.3 * (x / 5.0 * TAU).sin());
        let found = edge_deviations_mm(&heights, 0..400).unwrap();
        assert_near("wave", &found, &[0.3 * 0.5f64.sqrt(); 2], 0.01);
        // With whole cells, the error is even over a cell, with a deviation of 1 / sqrt 12.
        let slope = 10f64.to_radians().tan();
        let stairs = mark(|x| ((10.0 + slope * x) / 0.1).round() * 0.1);
        let [upper, _] = edge_deviations_mm(&stairs, 0..400).unwrap();
        assert_near("stairs", &[upper / 0.1], &[1.0 / 12f64.sqrt()], 0.02);
    }

    #[test]
    fn a_column_without_paint_has_no_edge() {
        let heights = Heights::from_places(0.1, (4.0, 4.0), |x, _| if x < 2.0 { 0.1 } else { 0.0 });
        assert_eq!(edge_deviations_mm(&heights, 0..40), None);
    }

    #[test]
    fn a_chequerboard_has_four_amplitudes_and_a_plane_none() {
        let board =
            Heights::new(0.1, 20, (0..400).map(|i| 0.01 * f64::from((i / 20 + i) % 2)).collect());
        let plane = Heights::from_places(0.1, (2.0, 2.0), |x, y| 0.3 * x + 0.1 * y);
        let ribs =
            Heights::from_places(0.1, (2.0, 2.0), |_, y| 0.01 * ((y / 0.1) as usize % 2) as f64);
        for (name, heights, wanted) in [
            ("board", board, [4.0 * 0.005; 2]),
            ("plane", plane, [0.0; 2]),
            ("ribs along x", ribs, [0.0, 0.02]),
        ] {
            assert_near(name, &second_differences_mm(&heights, 0..20, 0..20), &wanted, 1e-12);
        }
    }

    #[test]
    fn pits_are_counted_within_the_patch() {
        // One cell in 100 is a hole.
        let heights = Heights::from_places(0.1, (10.0, 10.0), |x, y| {
            let hole = [x, y].iter().all(|mm| (mm / 0.1) as usize % 10 == 5);
            if hole { 0.01 } else { 0.2 }
        });
        let all = pits(&heights, |_, _| true);
        assert_near(
            "a hole in 100",
            &[all, pits(&heights, |x, _| x % 10 == 5)],
            &[0.01, 0.1],
            1e-9,
        );
    }

    #[test]
    fn colors_spread_about_their_mean() {
        fn gray(lightness: f64) -> Lab {
            Lab { lightness, a: 0.0, b: 0.0 }
        }
        assert_near("no spread", &[color_spread(&[gray(50.0); 4])], &[0.0], 1e-12);
        let spread = color_spread(&[gray(48.0), gray(52.0)]);
        assert!((1.7..2.3).contains(&spread), "CIEDE2000 is about 1 a step at L* 50: {spread}");
    }

    fn wave(length_mm: f64, wavelength_mm: f64, height_mm: f64) -> Vec<f64> {
        (0..(length_mm / 0.1) as usize)
            .map(|index: usize| height_mm * (index as f64 * 0.1 / wavelength_mm * TAU).sin())
            .collect()
    }

    #[test]
    fn the_filter_halves_a_wave_of_its_length_and_keeps_long_ones() {
        let passed = [3.0, 30.0, 0.6].map(|wavelength_mm| {
            let wave = wave(90.0, wavelength_mm, 1.0);
            rms(&smoothed(&wave, 0.1, 3.0)[150..750]) / rms(&wave[150..750])
        });
        assert_near("passed", &passed, &[0.5, 0.993, 0.0], 0.005);
        let level = smoothed(&[2.0; 30], 0.1, 3.0);
        assert_near("a level", &level, &[2.0; 30], 1e-12);
        assert_near("nothing rough on a level", &rough(&[2.0; 30], 0.1, 3.0), &[0.0; 30], 1e-12);
    }

    #[test]
    fn the_peak_is_at_the_wavelength_of_the_strongest_wave() {
        for wavelength_mm in [0.3, 0.7, 1.2] {
            let strong = wave(6.0, wavelength_mm, 0.02);
            let weak = wave(6.0, 2.5, 0.005);
            let both: Vec<f64> = strong
                .iter()
                .zip(weak)
                .enumerate()
                .map(|(i, (a, b))| a + b + 0.01 * i as f64)
                .collect();
            let peak = peak_wavelength_mm(&[both], 0.1);
            assert!((peak / wavelength_mm - 1.0).abs() < 0.05, "{peak} for {wavelength_mm}");
        }
        assert!(peak_wavelength_mm(&[vec![0.0; 60]], 0.1).is_nan(), "no relief has no peak");
        assert!(peak_wavelength_mm(&[], 0.1).is_nan(), "no profile has no peak");
    }
}
