//! A field of heights in mm over cells of one size.

use std::ops::Range;

/// Heights of paint or ground in mm, row by row from the upper edge of the canvas.
#[derive(Debug, Clone, PartialEq)]
pub struct Heights {
    cell_mm: f64,
    columns: usize,
    mm: Vec<f64>,
}

impl Heights {
    /// Heights `mm` in rows of `columns` cells, each `cell_mm` mm wide.
    ///
    /// # Panics
    /// If `mm` is not a whole number of rows.
    #[must_use]
    pub fn new(cell_mm: f64, columns: usize, mm: Vec<f64>) -> Self {
        assert!(columns > 0 && mm.len().is_multiple_of(columns), "{} / {columns}", mm.len());
        Self { cell_mm, columns, mm }
    }

    /// Heights in mm of a surface `width_mm` x `height_mm`. You pass `height`, which gets the
    /// centre of a cell in mm from the left and the upper edge.
    #[must_use]
    pub fn from_places(
        cell_mm: f64,
        (width_mm, height_mm): (f64, f64),
        height: impl Fn(f64, f64) -> f64,
    ) -> Self {
        let [columns, rows] = [width_mm, height_mm].map(|mm| (mm / cell_mm).round() as usize);
        let cells = (0..rows).flat_map(|y| (0..columns).map(move |x| [x, y]));
        let heights = cells.map(|cell| {
            let [x, y] = cell.map(|at| (at as f64 + 0.5) * cell_mm);
            height(x, y)
        });
        Self::new(cell_mm, columns, heights.collect())
    }

    /// Width of a cell in mm.
    #[must_use]
    pub fn cell_mm(&self) -> f64 {
        self.cell_mm
    }

    /// Number of columns.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.mm.len() / self.columns
    }

    /// Heights in mm of all cells, row by row.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.mm
    }

    /// Height in mm of the cell in column `x` of row `y`.
    ///
    /// # Panics
    /// If there is no such cell.
    #[must_use]
    pub fn at(&self, x: usize, y: usize) -> f64 {
        self.mm[y * self.columns + x]
    }

    /// Columns between two distances in mm from the left edge.
    #[must_use]
    pub fn columns_in(&self, mm: Range<f64>) -> Range<usize> {
        self.cells_in(mm, self.columns)
    }

    /// Rows between two distances in mm from the upper edge.
    #[must_use]
    pub fn rows_in(&self, mm: Range<f64>) -> Range<usize> {
        self.cells_in(mm, self.rows())
    }

    fn cells_in(&self, mm: Range<f64>, count: usize) -> Range<usize> {
        let [start, end] = [mm.start, mm.end].map(|mm| (mm / self.cell_mm).round().max(0.0));
        let start = (start as usize).min(count);
        start..(end as usize).clamp(start, count)
    }

    /// Cuts out the rows between two distances in mm from the upper edge.
    #[must_use]
    pub fn band(&self, mm: Range<f64>) -> Self {
        let rows = self.rows_in(mm);
        let cells = rows.start * self.columns..rows.end * self.columns;
        Self::new(self.cell_mm, self.columns, self.mm[cells].to_vec())
    }

    /// Mean over `columns` of each row: the profile across a stroke that runs along x, in mm.
    #[must_use]
    pub fn across(&self, columns: Range<usize>) -> Vec<f64> {
        let count = columns.len().max(1) as f64;
        let sums = (0..self.rows()).map(|y| columns.clone().map(|x| self.at(x, y)).sum::<f64>());
        sums.map(|sum| sum / count).collect()
    }

    /// Mean over `rows` of each column: the profile along a stroke that runs along x, in mm.
    #[must_use]
    pub fn along(&self, rows: Range<usize>) -> Vec<f64> {
        let count = rows.len().max(1) as f64;
        let sums = (0..self.columns).map(|x| rows.clone().map(|y| self.at(x, y)).sum::<f64>());
        sums.map(|sum| sum / count).collect()
    }

    /// Heights in mm of the cells in `columns` and `rows`, row by row.
    #[must_use]
    pub fn part(&self, columns: Range<usize>, rows: Range<usize>) -> Vec<f64> {
        let cells = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
        cells.map(|(x, y)| self.at(x, y)).collect()
    }

    /// Height in mm of the highest cell. Without paint this is 0.
    #[must_use]
    pub fn highest_mm(&self) -> f64 {
        self.mm.iter().fold(0.0, |highest: f64, &mm| highest.max(mm))
    }

    /// Volume in mm3.
    #[must_use]
    pub fn volume_mm3(&self) -> f64 {
        self.mm.iter().sum::<f64>() * self.cell_mm * self.cell_mm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_columns_and_rows_are_in_millimetres() {
        let heights = Heights::from_places(0.5, (4.0, 2.0), |x, y| 10.0 * x + y);
        assert_eq!((heights.columns(), heights.rows()), (8, 4));
        assert_eq!(heights.at(1, 3), 9.25);
        assert_eq!(heights.columns_in(1.0..2.0), 2..4);
        assert_eq!(heights.columns_in(-1.0..9.0), 0..8);
        assert_eq!(heights.rows_in(1.5..0.5), 3..3);
        assert_eq!(heights.across(0..8), [20.25, 20.75, 21.25, 21.75]);
        assert_eq!(heights.along(0..4)[..2], [3.5, 8.5]);
        assert_eq!(heights.band(0.5..1.0).values(), heights.part(0..8, 1..2));
        assert_eq!(heights.highest_mm(), 39.25);
        assert_eq!(heights.volume_mm3(), 21.0 * 8.0);
    }
}
