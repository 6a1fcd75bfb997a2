//! The surface of a patch: saw-tooth, pits, evenness and colour.

use std::ops::Range;

use spectra::color::{Lab, delta_e_ciede2000};

use super::super::heights::Heights;
use super::series::{mean, quantile, rms};

/// Root of the mean squared second difference between neighbouring cells along x and along y, in
/// mm: 4 a for a chequerboard of amplitude a, 0 for a plane.
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
    let middle = |part: fn(&Lab) -> f64| mean(&colors.iter().map(part).collect::<Vec<_>>());
    let center = Lab {
        lightness: middle(|lab| lab.lightness),
        a: middle(|lab| lab.a),
        b: middle(|lab| lab.b),
    };
    mean(&colors.iter().map(|&lab| delta_e_ciede2000(center, lab)).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::near::assert_near;

    #[test]
    fn a_chequerboard_has_four_amplitudes_and_a_plane_none() {
        let board =
            Heights::new(0.1, 20, (0..400).map(|i| 0.01 * f64::from((i / 20 + i) % 2)).collect());
        let plane = Heights::from_places(0.1, (2.0, 2.0), |x, y| 0.3 * x + 0.1 * y);
        let of = |heights: &Heights| second_differences_mm(heights, 0..20, 0..20);
        assert_near("board", &of(&board), &[4.0 * 0.005; 2], 1e-12);
        assert_near("plane", &of(&plane), &[0.0; 2], 1e-12);
        let ribs =
            Heights::from_places(0.1, (2.0, 2.0), |_, y| 0.01 * ((y / 0.1) as usize % 2) as f64);
        assert_near("ribs along x", &of(&ribs), &[0.0, 0.02], 1e-12);
    }

    #[test]
    fn pits_are_counted_within_the_patch() {
        // One cell in 100 is a hole.
        let heights = Heights::from_places(0.1, (10.0, 10.0), |x, y| {
            let cell = |mm: f64| (mm / 0.1) as usize % 10;
            if cell(x) == 5 && cell(y) == 5 { 0.01 } else { 0.2 }
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
        let gray = |lightness: f64| Lab { lightness, a: 0.0, b: 0.0 };
        assert_near("no spread", &[color_spread(&[gray(50.0); 4])], &[0.0], 1e-12);
        let spread = color_spread(&[gray(48.0), gray(52.0)]);
        assert!((1.7..2.3).contains(&spread), "CIEDE2000 is about 1 a step at L* 50: {spread}");
    }
}
