//! Symmetric banded matrices: Cholesky factor, solution of equations, and the band of the inverse.
//!
//! The refinement couples each wavelength only with its neighbours, so we get normal equations of this
//! form.

use std::sync::Mutex;

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

/// Rows of a product that one task computes.
const ROWS_OF_PRODUCT: usize = 512;
/// Entries that one task copies or clears.
const ENTRIES_OF_TASK: usize = 1 << 16;

/// Lower band of a symmetric matrix, stored column by column.
#[derive(Debug, Clone)]
pub(crate) struct Banded {
    size: usize,
    /// The band holds this many entries below the diagonal.
    reach: usize,
    columns: Vec<f64>,
}

impl Banded {
    pub(crate) fn zeros(size: usize, reach: usize) -> Self {
        Self { size, reach, columns: vec![0.0; size * (reach + 1)] }
    }

    /// Entry at `row` and `column` within the band, where `row >= column`.
    pub(crate) fn at(&self, row: usize, column: usize) -> f64 {
        self.columns[column * (self.reach + 1) + row - column]
    }

    pub(crate) fn diagonal(&self, i: usize) -> f64 {
        self.columns[i * (self.reach + 1)]
    }

    /// Adds to the entry at `row` and `column`, where `row >= column`.
    #[inline]
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) {
        debug_assert!(
            row >= column && row - column <= self.reach,
            "({row}, {column}) is off the band"
        );
        self.columns[column * (self.reach + 1) + row - column] += value;
    }

    /// Replaces row and column `i` by the identity's, which fixes this unknown.
    pub(crate) fn hold(&mut self, i: usize) {
        let width = self.reach + 1;
        self.columns[i * width..(i + 1) * width].fill(0.0);
        for column in i.saturating_sub(self.reach)..i {
            self.columns[column * width + i - column] = 0.0;
        }
        self.columns[i * width] = 1.0;
    }

    /// Entries of `count` columns at a time, e.g. the columns of one wavelength. Use this to add to them on
    /// several threads.
    pub(crate) fn by_columns(
        &mut self,
        count: usize,
    ) -> impl IndexedParallelIterator<Item = ColumnsMut<'_>> {
        let width = self.reach + 1;
        let columns = self.columns.par_chunks_mut(count * width);
        columns.map(move |entries| ColumnsMut { width, entries })
    }

    pub(crate) fn times(&self, vector: &[f64]) -> Vec<f64> {
        let width = self.reach + 1;
        let mut product = vec![0.0; self.size];
        product.par_chunks_mut(ROWS_OF_PRODUCT).enumerate().for_each(|(block, product)| {
            let first = block * ROWS_OF_PRODUCT;
            let end = first + product.len();
            for column in first.saturating_sub(self.reach)..end {
                let entries = &self.columns[column * width..(column + 1) * width];
                if column >= first {
                    product[column - first] += entries[0] * vector[column];
                }
                for row in first.max(column + 1)..end.min(column + width) {
                    product[row - first] += entries[row - column] * vector[column];
                }
                if column >= first {
                    let rows = &vector[column + 1..(column + width).min(self.size)];
                    let sum = &mut product[column - first];
                    rows.iter().zip(&entries[1..]).for_each(|(value, entry)| *sum += entry * value);
                }
            }
        });
        product
    }
}

/// Several neighbouring columns of a matrix.
pub(crate) struct ColumnsMut<'a> {
    width: usize,
    entries: &'a mut [f64],
}

impl ColumnsMut<'_> {
    /// Adds to the entry at `row` and `column`, both counted from the first of these columns, where
    /// `row >= column`.
    #[inline]
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.entries[column * self.width + row - column] += value;
    }
}

/// Memory of matrices that we no longer need, for the next ones. A large fit makes hundreds of them, and
/// fresh memory costs as much time as the arithmetic.
#[derive(Debug, Default)]
pub(crate) struct Spare(Mutex<Vec<Vec<f64>>>);

impl Spare {
    pub(crate) fn zeros(&self, size: usize, reach: usize) -> Banded {
        let Some(mut columns) = self.take(size * (reach + 1)) else {
            return Banded::zeros(size, reach);
        };
        columns.par_chunks_mut(ENTRIES_OF_TASK).for_each(|entries| entries.fill(0.0));
        Banded { size, reach, columns }
    }

    pub(crate) fn copy(&self, matrix: &Banded) -> Banded {
        let Some(mut columns) = self.take(matrix.columns.len()) else { return matrix.clone() };
        let pairs = columns.par_chunks_mut(ENTRIES_OF_TASK);
        pairs
            .zip(matrix.columns.par_chunks(ENTRIES_OF_TASK))
            .for_each(|(copy, entries)| copy.copy_from_slice(entries));
        Banded { columns, ..*matrix }
    }

    /// Keeps the memory of `matrix` for the next matrix of its size.
    pub(crate) fn keep(&self, matrix: Banded) {
        if let Ok(mut kept) = self.0.lock() {
            kept.push(matrix.columns);
        }
    }

    fn take(&self, entries: usize) -> Option<Vec<f64>> {
        let mut kept = self.0.lock().ok()?;
        kept.retain(|columns| columns.len() == entries);
        kept.pop()
    }
}

/// We eliminate this many columns together. They fit the first-level cache.
const PANEL: usize = 32;
/// We use several threads for one panel only if the band reaches at least this far below the diagonal.
const LEAST_PARALLEL: usize = 100;
/// One task updates at least this many pairs of columns.
const PAIRS_OF_TASK: usize = 4;

/// Cholesky factor L of A = L L'.
#[derive(Debug, Clone)]
pub(crate) struct BandedCholesky {
    factor: Banded,
}

impl BandedCholesky {
    pub(crate) fn into_matrix(self) -> Banded {
        self.factor
    }
}

impl Banded {
    /// Cholesky factor, or `None` if the matrix is not positive definite.
    ///
    /// We eliminate columns in panels. The updates of the columns to the right run on all cores. Each entry
    /// takes its updates in the order of columns, so you get the same factor for any number of threads and
    /// any width of the machine's vectors.
    pub(crate) fn cholesky(mut self) -> Option<BandedCholesky> {
        let width = self.reach + 1;
        let reach = self.reach;
        let arch = pulp::Arch::new();
        for first in (0..self.size).step_by(PANEL) {
            let end = (first + PANEL).min(self.size);
            let (head, tail) = self.columns.split_at_mut(end * width);
            let panel = &mut head[first * width..];
            arch.dispatch(Elimination { panel, width })?;
            let panel = &head[first * width..];
            let update = |(pair, targets): (usize, &mut [f64])| {
                let column = end + 2 * pair;
                let from = column.saturating_sub(reach).max(first) - first;
                let panel = &panel[from * width..];
                arch.dispatch(Update { targets, panel, width, offset: column - first - from });
            };
            let right = reach.min(self.size - end) * width;
            if reach < LEAST_PARALLEL {
                tail[..right].chunks_mut(2 * width).enumerate().for_each(update);
            } else {
                let pairs = tail[..right].par_chunks_mut(2 * width).enumerate();
                pairs.with_min_len(PAIRS_OF_TASK).for_each(update);
            }
        }
        Some(BandedCholesky { factor: self })
    }
}

/// Eliminates the columns of a panel among themselves, or `None` if a pivot is not positive.
struct Elimination<'a> {
    panel: &'a mut [f64],
    width: usize,
}

impl WithSimd for Elimination<'_> {
    type Output = Option<()>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Option<()> {
        let Self { panel, width } = self;
        for column in 0..panel.len() / width {
            let (own, right) = panel[column * width..].split_at_mut(width);
            let pivot = own[0];
            if !(pivot > 0.0 && pivot.is_finite()) {
                return None;
            }
            let root = pivot.sqrt();
            own.iter_mut().for_each(|v| *v /= root);
            for (offset, target) in right.chunks_exact_mut(width).take(width - 1).enumerate() {
                subtract(target, own, offset + 1);
            }
        }
        Some(())
    }
}

/// Subtracts the outer product of the factor's column `own` from the column `target`, which lies `offset`
/// columns to its right.
#[inline(always)]
fn subtract(target: &mut [f64], own: &[f64], offset: usize) {
    let Some(factor) = own.get(offset).filter(|factor| **factor != 0.0) else { return };
    for (t, v) in target.iter_mut().zip(&own[offset..]) {
        *t -= factor * v;
    }
}

/// Subtracts the outer products of all columns of a panel, in their order, from one column or from two
/// neighbouring columns. The first column of the panel lies `offset` columns to the left of the first
/// target.
struct Update<'a> {
    targets: &'a mut [f64],
    panel: &'a [f64],
    width: usize,
    offset: usize,
}

impl WithSimd for Update<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { targets, panel, width, mut offset } = self;
        let (left, right) = targets.split_at_mut(width);
        let mut columns = panel.chunks_exact(width);
        // A column of the panel may reach the first target and not the second.
        if offset + 1 == width || right.is_empty() {
            for column in columns.by_ref().take(if right.is_empty() { usize::MAX } else { 1 }) {
                subtract(left, column, offset);
                offset = offset.wrapping_sub(1);
            }
        }
        // Four columns at a time read and write the targets once.
        while columns.len() >= 4 {
            let four: [&[f64]; 4] = std::array::from_fn(|i| {
                let column = columns.next().expect("four are left");
                &column[offset - i..]
            });
            subtract_four(left, right, four);
            offset -= 4;
        }
        for column in columns {
            subtract(left, column, offset);
            subtract(right, column, offset + 1);
            offset = offset.wrapping_sub(1);
        }
    }
}

/// Subtracts the outer products of four columns from two neighbouring columns. Each of the four begins at
/// the row of the first target.
#[inline(always)]
fn subtract_four(left: &mut [f64], right: &mut [f64], four: [&[f64]; 4]) {
    let of_left = four.map(|column| column[0]);
    let of_right = four.map(|column| column[1]);
    for (factor, column) in of_left.iter().zip(four) {
        left[0] -= factor * column[0];
    }
    let common = four[0].len() - 1;
    let [a, b, c, d] = four.map(|column| &column[1..=common]);
    let targets = left[1..=common].iter_mut().zip(&mut right[..common]);
    for ((left, right), ((a, b), (c, d))) in targets.zip(a.iter().zip(b).zip(c.iter().zip(d))) {
        let [fa, fb, fc, fd] = of_left;
        *left = *left - fa * a - fb * b - fc * c - fd * d;
        let [fa, fb, fc, fd] = of_right;
        *right = *right - fa * a - fb * b - fc * c - fd * d;
    }
    // The later columns end lower.
    for (at, column) in four.iter().enumerate().skip(1) {
        for row in common + 1..column.len() {
            left[row] -= of_left[at] * column[row];
            right[row - 1] -= of_right[at] * column[row];
        }
    }
}

/// Number of right sides that [`BandedCholesky::solve_together`] solves at once.
pub(crate) const TOGETHER: usize = 16;

impl BandedCholesky {
    pub(crate) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let size = self.factor.size;
        let width = self.factor.reach + 1;
        let mut x = right.to_vec();
        for (column, entries) in self.factor.columns.chunks_exact(width).enumerate() {
            let value = x[column] / entries[0];
            x[column] = value;
            let end = (column + width).min(size);
            for (target, entry) in x[column + 1..end].iter_mut().zip(&entries[1..]) {
                *target -= value * entry;
            }
        }
        for (column, entries) in self.factor.columns.chunks_exact(width).enumerate().rev() {
            let end = (column + width).min(size);
            let sum: f64 =
                x[column + 1..end].iter().zip(&entries[1..]).map(|(v, entry)| v * entry).sum();
            x[column] = (x[column] - sum) / entries[0];
        }
        x
    }

    /// Solves A x = b for [`TOGETHER`] right sides at once. Each row of `x` holds one entry of every right
    /// side. You get the same solutions as from [`Self::solve`].
    pub(crate) fn solve_together(&self, x: &mut [[f64; TOGETHER]]) {
        pulp::Arch::new().dispatch(Together { factor: &self.factor, x });
    }
}

struct Together<'a> {
    factor: &'a Banded,
    x: &'a mut [[f64; TOGETHER]],
}

impl WithSimd for Together<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { factor, x } = self;
        let size = factor.size;
        let width = factor.reach + 1;
        for (column, entries) in factor.columns.chunks_exact(width).enumerate() {
            let value = x[column].map(|v| v / entries[0]);
            x[column] = value;
            let end = (column + width).min(size);
            for (target, entry) in x[column + 1..end].iter_mut().zip(&entries[1..]) {
                target.iter_mut().zip(&value).for_each(|(t, v)| *t -= v * entry);
            }
        }
        for (column, entries) in factor.columns.chunks_exact(width).enumerate().rev() {
            let end = (column + width).min(size);
            let mut sum = [0.0; TOGETHER];
            for (row, entry) in x[column + 1..end].iter().zip(&entries[1..]) {
                sum.iter_mut().zip(row).for_each(|(s, v)| *s += v * entry);
            }
            x[column].iter_mut().zip(&sum).for_each(|(v, s)| *v = (*v - s) / entries[0]);
        }
    }
}

/// We compute this many columns of the inverse together.
const INVERSE_PANEL: usize = 16;
const ROWS_OF_TASK: usize = 16;

impl BandedCholesky {
    /// Band of the inverse Z of A (Takahashi, Fagan and Chin 1973), in panels of columns from the last to
    /// the first.
    ///
    /// The equation Z L = L'^-1 gives the columns of a panel: first their rows below the panel, from the
    /// columns of Z that we know already, then the square block on the diagonal.
    pub(crate) fn inverse_band(&self) -> Banded {
        let size = self.factor.size;
        let reach = self.factor.reach;
        let mut inverse = Banded::zeros(size, reach);
        let arch = pulp::Arch::new();
        for panel in (0..size.div_ceil(INVERSE_PANEL)).rev() {
            let panel = Panel::of(&self.factor, panel * INVERSE_PANEL);
            let rows = reach.min(size - panel.end);
            let row =
                |row: usize| arch.dispatch(Row { panel: &panel, inverse: &inverse, row, rows });
            let below: Vec<[f64; INVERSE_PANEL]> = if reach < LEAST_PARALLEL {
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
    /// Square block on the diagonal. Beyond the end of the matrix it continues as the identity.
    own: [[f64; INVERSE_PANEL]; INVERSE_PANEL],
    /// Rows below the panel, 0 beyond the band.
    below: Vec<[f64; INVERSE_PANEL]>,
}

impl Panel {
    fn of(factor: &Banded, first: usize) -> Self {
        let size = factor.size;
        let reach = factor.reach;
        let end = (first + INVERSE_PANEL).min(size);
        let mut own = [[0.0; INVERSE_PANEL]; INVERSE_PANEL];
        let mut below = vec![[0.0; INVERSE_PANEL]; reach.min(size - end)];
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
    fn put(
        &self,
        square: &[[f64; INVERSE_PANEL]; INVERSE_PANEL],
        below: &[[f64; INVERSE_PANEL]],
        inverse: &mut Banded,
    ) {
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

/// Computes row `row` below a panel of the inverse, at the panel's columns. It depends on all `rows` rows
/// below the panel.
struct Row<'a> {
    panel: &'a Panel,
    inverse: &'a Banded,
    row: usize,
    rows: usize,
}

impl WithSimd for Row<'_> {
    type Output = [f64; INVERSE_PANEL];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [f64; INVERSE_PANEL] {
        let Self { panel, inverse, row, rows } = self;
        let at = panel.end + row;
        let mut sums = [0.0; INVERSE_PANEL];
        let left = (0..row).map(|k| inverse.at(at, panel.end + k));
        let diagonal = at * (inverse.reach + 1);
        let right = inverse.columns[diagonal..diagonal + rows - row].iter().copied();
        for (z, factor) in left.chain(right).zip(&panel.below) {
            sums.iter_mut().zip(factor).for_each(|(sum, f)| *sum += z * f);
        }
        let mut values = [0.0; INVERSE_PANEL];
        for column in (0..INVERSE_PANEL).rev() {
            let value = -sums[column] / panel.own[column][column];
            values[column] = value;
            // Columns to the left still lack what this one contributes.
            sums.iter_mut().zip(&panel.own[column]).take(column).for_each(|(s, f)| *s += value * f);
        }
        values
    }
}

/// Computes the square block of the inverse on the diagonal of a panel, from the rows below it.
struct Square<'a> {
    panel: &'a Panel,
    below: &'a [[f64; INVERSE_PANEL]],
}

impl WithSimd for Square<'_> {
    type Output = [[f64; INVERSE_PANEL]; INVERSE_PANEL];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [[f64; INVERSE_PANEL]; INVERSE_PANEL] {
        let Self { panel, below } = self;
        // By row of Z: sums over the rows below of Z times L.
        let mut sums = [[0.0; INVERSE_PANEL]; INVERSE_PANEL];
        for (z, factor) in below.iter().zip(&panel.below) {
            for (sums, z) in sums.iter_mut().zip(z) {
                sums.iter_mut().zip(factor).for_each(|(sum, f)| *sum += z * f);
            }
        }
        let mut square = [[0.0; INVERSE_PANEL]; INVERSE_PANEL];
        for column in (0..INVERSE_PANEL).rev() {
            let pivot = panel.own[column][column];
            for row in (column..INVERSE_PANEL).rev() {
                let within: f64 = (column + 1..INVERSE_PANEL)
                    .map(|k| square[row][k] * panel.own[k][column])
                    .sum();
                let diagonal = if row == column { pivot.recip() } else { 0.0 };
                let value = (diagonal - within - sums[row][column]) / pivot;
                square[row][column] = value;
                square[column][row] = value;
            }
        }
        square
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    fn example() -> (Banded, DMatrix<f64>) {
        let size = 23;
        let reach = 4;
        let mut banded = Banded::zeros(size, reach);
        let mut dense = DMatrix::zeros(size, size);
        for column in 0..size {
            for row in column..(column + reach + 1).min(size) {
                let value = if row == column {
                    9.0 + (row % 5) as f64
                } else {
                    ((row * 7 + column * 13) % 11) as f64 / 5.0 - 1.0
                };
                banded.add(row, column, value);
                dense[(row, column)] = value;
                dense[(column, row)] = value;
            }
        }
        (banded, dense)
    }

    #[test]
    fn solution_product_and_inverse_band_agree_with_the_dense_matrix() {
        let (banded, dense) = example();
        let right: Vec<f64> = (0..23).map(|i| f64::from(i) - 7.0).collect();
        let product = banded.times(&right);
        let dense_product = &dense * nalgebra::DVector::from_vec(right.clone());
        for (a, b) in product.iter().zip(&dense_product) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        let cholesky = banded.cholesky().unwrap();
        let inverse = dense.try_inverse().unwrap();
        let solution = cholesky.solve(&right);
        let dense_solution = &inverse * nalgebra::DVector::from_vec(right);
        for (a, b) in solution.iter().zip(&dense_solution) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        let band = cholesky.inverse_band();
        for column in 0..23usize {
            for row in column..(column + 5).min(23) {
                let a = band.at(row, column);
                let b = inverse[(row, column)];
                assert!((a - b).abs() < 1e-12, "({row}, {column}): {a} {b}");
            }
        }
    }

    #[test]
    fn an_unknown_that_is_held_has_the_row_and_column_of_the_identity() {
        let (mut banded, mut dense) = example();
        for held in [0, 2, 11, 22] {
            banded.hold(held);
            dense.row_mut(held).fill(0.0);
            dense.column_mut(held).fill(0.0);
            dense[(held, held)] = 1.0;
        }
        for column in 0..23_usize {
            for row in column..(column + 5).min(23) {
                assert_eq!(banded.at(row, column), dense[(row, column)], "({row}, {column})");
            }
        }
    }

    #[test]
    fn a_matrix_that_is_not_positive_definite_has_no_factor() {
        let mut banded = Banded::zeros(2, 1);
        banded.add(0, 0, 1.0);
        banded.add(1, 1, 1.0);
        banded.add(1, 0, 2.0);
        assert!(banded.cholesky().is_none(), "eigenvalue -1");
    }

    #[test]
    fn panels_give_the_factor_of_single_columns_to_the_bit() {
        // Larger than a panel, with a reach that is shared out to threads.
        let size = 400;
        let reach = LEAST_PARALLEL + 7;
        let mut banded = Banded::zeros(size, reach);
        for column in 0..size {
            for row in column..(column + reach + 1).min(size) {
                let off = ((row * 7 + column * 13) % 11) as f64 / 5.0 - 1.0;
                banded.add(row, column, if row == column { 300.0 } else { off });
            }
        }
        let width = reach + 1;
        let mut single = banded.columns.clone();
        for column in 0..size {
            let root = single[column * width].sqrt();
            let own = &mut single[column * width..(column + 1) * width];
            own.iter_mut().for_each(|v| *v /= root);
            let own = own.to_vec();
            for offset in 1..=reach.min(size - 1 - column) {
                let target = &mut single[(column + offset) * width..];
                for (t, v) in target.iter_mut().zip(&own[offset..]) {
                    *t -= own[offset] * v;
                }
            }
        }
        let factor = banded.clone().cholesky().unwrap();
        assert!(factor.factor.columns == single);
        let band = factor.inverse_band();
        let mut dense = DMatrix::zeros(size, size);
        for column in 0..size {
            for row in column..(column + reach + 1).min(size) {
                dense[(row, column)] = banded.at(row, column);
                dense[(column, row)] = banded.at(row, column);
            }
        }
        let inverse = dense.try_inverse().unwrap();
        for column in 0..size {
            for row in column..(column + reach + 1).min(size) {
                let a = band.at(row, column);
                let b = inverse[(row, column)];
                assert!((a - b).abs() < 1e-14, "({row}, {column}): {a} {b}");
            }
        }
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let right: Vec<f64> = (0..size).map(|i| (i % 17) as f64 - 7.0).collect();
        let alone = one.install(|| (banded.clone().cholesky().unwrap(), banded.times(&right)));
        assert!(alone.0.factor.columns == single && alone.1 == banded.times(&right));

        let mut together = vec![[0.0; TOGETHER]; size];
        for (i, row) in together.iter_mut().enumerate() {
            *row = std::array::from_fn(|place| right[i] * (1.0 + place as f64));
        }
        factor.solve_together(&mut together);
        for place in 0..TOGETHER {
            let right: Vec<f64> = right.iter().map(|v| v * (1.0 + place as f64)).collect();
            let solution: Vec<f64> = together.iter().map(|row| row[place]).collect();
            assert!(factor.solve(&right) == solution, "right side {place}");
        }
    }
}
