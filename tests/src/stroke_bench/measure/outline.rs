//! The outline of a mark: how far its edges deviate from straight lines.

use std::ops::Range;

use super::super::heights::Heights;
use super::mark::{extent_mm, first_crossing, last_crossing};
use super::series::{fitted, mean, rms};
use super::waves::smoothed;

/// Root of the mean squared distance in mm of the upper and of the lower edge of a mark from the
/// straight line nearest to each, over `columns`. The edge of a column is where the height, going
/// inwards, first reaches half of the film, between the centres of cells. The film of a column is
/// the mean over the middle 60 % of its width, smoothed over 5 mm along the mark.
/// `None` where a column has no paint.
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

/// Root of the mean squared distance of `places`, told every `step`, from the nearest straight
/// line; perpendicular to that line.
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

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::near::assert_near;

    /// A mark 6 mm wide whose upper edge lies at `edge(x)`; cells hold their covered share.
    fn mark(edge: impl Fn(f64) -> f64) -> Heights {
        Heights::from_places(0.1, (40.0, 30.0), |x, y| {
            let share = |inside: f64| (inside / 0.1 + 0.5).clamp(0.0, 1.0);
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
        // Whole cells only: the error is even over a cell, with a deviation of 1 / sqrt 12.
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
}
