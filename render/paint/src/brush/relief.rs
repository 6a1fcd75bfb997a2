//! Coarse heights of the canvas. We bend heads over these.

use crate::amount::QUANTA_PER_CELL;
use graphics::field::Field;
use graphics::lanes::{greater, lesser};

/// Number of cells of the canvas along x and y for each value of a relief.
pub const BLOCK: usize = 8;

/// Heights of ground and dry paint in mm, one value for each block of 8 x 8 cells. We take the mean
/// plus one standard deviation: this is near the crests, where hair rests. For a plane it is exact.
#[derive(Debug, Clone, PartialEq)]
pub struct Relief {
    cell_mm: f64,
    heights_mm: Field<f32>,
    /// Heights in cells.
    heights: Field<f32>,
}

impl Relief {
    /// Relief of `floor`, heights in quanta over the plane of the canvas, with cells of
    /// `cell_mm` mm.
    ///
    /// # Panics
    /// If there is no cell.
    #[must_use]
    pub fn from_floor(floor: &Field<i32>, cell_mm: f64) -> Self {
        assert!(!floor.bounds().is_empty(), "a canvas without cells");
        let width = floor.width().div_ceil(BLOCK);
        let height = floor.height().div_ceil(BLOCK);
        let heights = Field::from_values(
            width,
            height,
            (0..width * height).map(|i| crest(floor, i % width, i / width)).collect(),
        );
        let in_mm = heights.values().iter().map(|&h| (f64::from(h) * cell_mm) as f32).collect();
        Self { cell_mm, heights_mm: Field::from_values(width, height, in_mm), heights }
    }

    /// Relief of a plane at height 0 under `width` x `height` cells.
    #[must_use]
    pub fn flat(width: usize, height: usize, cell_mm: f64) -> Self {
        Self::from_floor(&Field::filled(width, height, 0), cell_mm)
    }

    /// Width of a cell of the canvas in mm.
    #[must_use]
    pub fn cell_mm(&self) -> f64 {
        self.cell_mm
    }

    /// Heights in mm, one for each block.
    #[must_use]
    pub fn heights_mm(&self) -> &Field<f32> {
        &self.heights_mm
    }

    /// The relief in coordinates from the cell `origin`.
    pub(super) fn seen_from(&self, origin: (i64, i64)) -> ReliefView<'_> {
        let block = BLOCK as i64;
        ReliefView {
            heights: &self.heights,
            first: (origin.0.div_euclid(block), origin.1.div_euclid(block)),
            // The value of a block applies at its centre.
            shift: (
                origin.0.rem_euclid(block) as f32 / block as f32 - 0.5,
                origin.1.rem_euclid(block) as f32 / block as f32 - 0.5,
            ),
        }
    }
}

/// Mean plus one standard deviation of one block, in cells.
fn crest(floor: &Field<i32>, column: usize, row: usize) -> f32 {
    let x = column * BLOCK;
    let y = row * BLOCK;
    let width = BLOCK.min(floor.width() - x);
    let height = BLOCK.min(floor.height() - y);
    let cells = (y..y + height).flat_map(|y| floor.row(y, x, width));
    let lowest = f64::from(floor[(x, y)]);
    let (sum, squares) = cells.fold((0.0, 0.0), |(sum, squares), &quanta| {
        let above = f64::from(quanta) - lowest;
        (sum + above, squares + above * above)
    });
    let count = (width * height) as f64;
    let mean = sum / count;
    let deviation = (squares / count - mean * mean).max(0.0).sqrt();
    ((lowest + mean + deviation) / f64::from(QUANTA_PER_CELL)) as f32
}

/// A relief in coordinates of a head: cells from an origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct ReliefView<'a> {
    heights: &'a Field<f32>,
    first: (i64, i64),
    shift: (f32, f32),
}

impl ReliefView<'_> {
    /// Height at `(x, y)` in cells. Outside the canvas, the height of its edge.
    #[inline(always)]
    pub(super) fn height(&self, x: f32, y: f32) -> f32 {
        let x = x * (1.0 / BLOCK as f32) + self.shift.0;
        let y = y * (1.0 / BLOCK as f32) + self.shift.1;
        let column = floor_of(x);
        let row = floor_of(y);
        let right = x - column as f32;
        let down = y - row as f32;
        let upper = self.between(column, row, right);
        let lower = self.between(column, row + 1, right);
        upper + (lower - upper) * down
    }

    #[inline(always)]
    fn between(&self, column: i32, row: i32, share: f32) -> f32 {
        let row = clamped(self.first.1 + i64::from(row), self.heights.height());
        let row = self.heights.row(row, 0, self.heights.width());
        let left = row[clamped(self.first.0 + i64::from(column), row.len())];
        let right = row[clamped(self.first.0 + i64::from(column) + 1, row.len())];
        left + (right - left) * share
    }

    /// Lowest and highest value that the interpolation uses within `reach` cells of `(x, y)`.
    pub(super) fn range(&self, (x, y): (f32, f32), reach: f32) -> (f32, f32) {
        let columns = block(x - reach, self.shift.0)..=block(x + reach, self.shift.0) + 1;
        let rows = block(y - reach, self.shift.1)..=block(y + reach, self.shift.1) + 1;
        let within = |range: std::ops::RangeInclusive<i64>, first: i64, count: usize| {
            clamped(first + range.start(), count)..=clamped(first + range.end(), count)
        };
        let columns = within(columns, self.first.0, self.heights.width());
        let mut found = (f32::INFINITY, f32::NEG_INFINITY);
        for row in within(rows, self.first.1, self.heights.height()) {
            let count = columns.end() - columns.start() + 1;
            for &height in self.heights.row(row, *columns.start(), count) {
                found = (lesser(height, found.0), greater(height, found.1));
            }
        }
        found
    }
}

#[inline(always)]
fn block(at: f32, shift: f32) -> i64 {
    i64::from(floor_of(at / BLOCK as f32 + shift))
}

/// Largest whole number not above the argument. We do not use `f32::floor`, because it is slow
/// without SSE 4.1.
#[inline(always)]
fn floor_of(value: f32) -> i32 {
    let cut = value as i32;
    cut - i32::from(value < cut as f32)
}

#[inline(always)]
fn clamped(index: i64, count: usize) -> usize {
    index.clamp(0, count as i64 - 1) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    const Q: i32 = QUANTA_PER_CELL as i32;

    #[test]
    fn a_plane_is_felt_as_it_is_also_beyond_its_edge() {
        let relief = Relief::from_floor(&Field::filled(21, 13, 3 * Q), 0.1);
        assert_eq!((relief.heights_mm().width(), relief.heights_mm().height()), (3, 2));
        assert!((relief.heights_mm()[(1, 1)] - 0.3).abs() < 1e-6);
        for origin in [(0, 0), (-500, 7), (9, 1_000_000_000)] {
            assert_eq!(relief.seen_from(origin).height(3.3, -4.7), 3.0, "{origin:?}");
            assert_eq!(relief.seen_from(origin).range((0.0, 0.0), 40.0), (3.0, 3.0), "{origin:?}");
        }
    }

    #[test]
    fn a_weave_is_felt_near_its_crests() {
        let mut floor = Field::filled(8, 8, 0);
        for (i, height) in floor.values_mut().iter_mut().enumerate() {
            *height = if i % 2 == 0 { Q } else { 0 };
        }
        assert_eq!(Relief::from_floor(&floor, 0.1).heights_mm()[(0, 0)], 0.1);
    }

    #[test]
    fn a_slope_is_felt_in_its_place() {
        let mut floor = Field::filled(64, 8, 0);
        for (i, height) in floor.values_mut().iter_mut().enumerate() {
            *height = (i % 64 / 8) as i32 * 8 * Q;
        }
        let relief = Relief::from_floor(&floor, 0.1);
        for x in [5.0_f32, 20.0, 31.5, 50.0] {
            let here = relief.seen_from((0, 0)).height(x, 4.0);
            assert!((here - (x - 4.0)).abs() < 1e-4, "{x}: {here}");
            let moved = relief.seen_from((13, 2)).height(x - 13.0, 2.0);
            assert!((moved - here).abs() < 1e-4, "{x}: {moved}, {here}");
        }
        assert_eq!(relief.seen_from((0, 0)).range((32.0, 4.0), 4.0), (24.0, 40.0));
    }
}
