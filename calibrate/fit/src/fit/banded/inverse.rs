//! The band of an inverse.

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use super::factor::{BandedCholesky, LEAST_PARALLEL};
use super::matrix::Banded;

/// Columns whose entries of the inverse are computed together.
const PANEL: usize = 16;
/// Least number of rows of one task.
const ROWS_OF_TASK: usize = 16;

impl BandedCholesky {
    /// Band of the inverse Z of A (Takahashi, Fagan and Chin 1973), in panels of columns from the last to
    /// the first.
    ///
    /// Z L = L'^-1 gives the rows below a panel from the Z of these rows, and then the panel's own square.
    pub(crate) fn inverse_band(&self) -> Banded {
        let size = self.factor.size;
        let reach = self.factor.reach;
        let mut inverse = Banded::zeros(size, reach);
        let arch = pulp::Arch::new();
        for panel in (0..size.div_ceil(PANEL)).rev() {
            let panel = Panel::of(&self.factor, panel * PANEL);
            let rows = reach.min(size - panel.end);
            let row =
                |row: usize| arch.dispatch(Row { panel: &panel, inverse: &inverse, row, rows });
            let below: Vec<[f64; PANEL]> = if reach < LEAST_PARALLEL {
                (0..rows).map(row).collect()
            } else {
                (0..rows).into_par_iter().with_min_len(ROWS_OF_TASK).map(row).collect()
            };
            let square = arch.dispatch(Square { panel: &panel, below: &below });
            panel.put(&square, &below, &mut inverse);
        }
        inverse
    }
}

/// Neighbouring columns of the factor, as two dense blocks.
struct Panel {
    first: usize,
    end: usize,
    /// Rows of the panel's own columns; those past the end of the matrix are of the identity.
    own: [[f64; PANEL]; PANEL],
    /// Rows below the panel, 0 beyond the band.
    below: Vec<[f64; PANEL]>,
}

impl Panel {
    fn of(factor: &Banded, first: usize) -> Self {
        let size = factor.size;
        let reach = factor.reach;
        let end = (first + PANEL).min(size);
        let mut own = [[0.0; PANEL]; PANEL];
        let mut below = vec![[0.0; PANEL]; reach.min(size - end)];
        for (place, row) in own.iter_mut().enumerate().skip(end - first) {
            row[place] = 1.0;
        }
        for column in first..end {
            for row in column..(column + reach + 1).min(size) {
                let rows = if row < end { &mut own[row - first] } else { &mut below[row - end] };
                rows[column - first] = factor.at(row, column);
            }
        }
        Self { first, end, own, below }
    }

    /// Writes the entries within the band.
    fn put(&self, square: &[[f64; PANEL]; PANEL], below: &[[f64; PANEL]], inverse: &mut Banded) {
        let width = inverse.reach + 1;
        for column in self.first..self.end {
            let place = column - self.first;
            let entries = &mut inverse.columns[column * width..(column + 1) * width];
            let own = square[place..self.end - self.first].iter();
            for (entry, row) in entries.iter_mut().zip(own.chain(below)) {
                *entry = row[place];
            }
        }
    }
}

/// The inverse in row `row` below a panel, at the panel's columns, from all `rows` rows below it.
struct Row<'a> {
    panel: &'a Panel,
    inverse: &'a Banded,
    row: usize,
    rows: usize,
}

impl WithSimd for Row<'_> {
    type Output = [f64; PANEL];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [f64; PANEL] {
        let Self { panel, inverse, row, rows } = self;
        let at = panel.end + row;
        let mut sums = [0.0; PANEL];
        let left = (0..row).map(|k| inverse.at(at, panel.end + k));
        let diagonal = at * (inverse.reach + 1);
        let right = inverse.columns[diagonal..diagonal + rows - row].iter().copied();
        for (z, factor) in left.chain(right).zip(&panel.below) {
            sums.iter_mut().zip(factor).for_each(|(sum, f)| *sum += z * f);
        }
        let mut values = [0.0; PANEL];
        for column in (0..PANEL).rev() {
            let value = -sums[column] / panel.own[column][column];
            values[column] = value;
            // Columns to the left still lack what this one contributes.
            sums.iter_mut().zip(&panel.own[column]).take(column).for_each(|(s, f)| *s += value * f);
        }
        values
    }
}

/// The inverse at a panel's own rows and columns, from that of the rows below.
struct Square<'a> {
    panel: &'a Panel,
    below: &'a [[f64; PANEL]],
}

impl WithSimd for Square<'_> {
    type Output = [[f64; PANEL]; PANEL];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [[f64; PANEL]; PANEL] {
        let Self { panel, below } = self;
        // By row of Z: sums over the rows below of Z times L.
        let mut sums = [[0.0; PANEL]; PANEL];
        for (z, factor) in below.iter().zip(&panel.below) {
            for (sums, z) in sums.iter_mut().zip(z) {
                sums.iter_mut().zip(factor).for_each(|(sum, f)| *sum += z * f);
            }
        }
        let mut square = [[0.0; PANEL]; PANEL];
        for column in (0..PANEL).rev() {
            let pivot = panel.own[column][column];
            for row in (column..PANEL).rev() {
                let within: f64 =
                    (column + 1..PANEL).map(|k| square[row][k] * panel.own[k][column]).sum();
                let diagonal = if row == column { pivot.recip() } else { 0.0 };
                let value = (diagonal - within - sums[row][column]) / pivot;
                square[row][column] = value;
                square[column][row] = value;
            }
        }
        square
    }
}
