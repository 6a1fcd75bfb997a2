//! The mark of a stroke that runs along x: its width, its film, its lips and its ends.

use std::ops::Range;

use super::super::heights::Heights;
use super::series::{mean, quantile};

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
    /// Mean height of the wet paint there, over the steady part.
    pub film_mm: f64,
    /// Place along x where it begins.
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
    /// The only mark in `heights`. `None` without paint, or with less than 20 mm of it.
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

    /// Highest place of the mean profile across near the upper and near the lower edge, over
    /// the film.
    #[must_use]
    pub fn side_lips(&self, heights: &Heights) -> [f64; 2] {
        let profile = heights.across(self.steady.clone());
        let highest = |from: f64, to: f64| {
            let rows = heights.rows_in(from..to);
            profile[rows].iter().fold(0.0, |a: f64, &b| a.max(b)) / self.film_mm
        };
        let (top, bottom) = self.edges_mm;
        [highest(top - LIP_MM, top + LIP_MM), highest(bottom - LIP_MM, bottom + LIP_MM)]
    }

    /// Highest place of the mean profile along the last `LIP_MM` mm before the mark's end, over
    /// the film from 15 to 5 mm before it.
    #[must_use]
    pub fn end_lip(&self, heights: &Heights) -> f64 {
        let profile = heights.along(self.middle.clone());
        let Some((_, end)) = self.ends_mm(heights) else { return f64::NAN };
        let film = mean(&profile[heights.columns_in(end - 15.0..end - 5.0)]);
        let last = &profile[heights.columns_in(end - 2.0 * LIP_MM..end + LIP_MM)];
        last.iter().fold(0.0, |a: f64, &b| a.max(b)) / film
    }

    /// Places in mm along x where the mean film begins and ends: where it crosses half of the
    /// film of the first and of the last 10 mm of the steady part.
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
mod tests {
    use super::*;
    use crate::near::assert_near;

    /// A mark from x 8 to 62.3 mm and y 5.03 to 15.03 mm, `film` high, with lips 0.5 mm wide.
    fn stroke(film: impl Fn(f64) -> f64, side: f64, end: f64) -> Heights {
        Heights::from_places(0.1, (80.0, 20.0), |x, y| {
            let inside = |at: f64, from: f64, to: f64| {
                ((at - from) / 0.1 + 0.5).clamp(0.0, 1.0) * ((to - at) / 0.1 + 0.5).clamp(0.0, 1.0)
            };
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
        let falling = |x: f64| 0.4 - 0.005 * x;
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
