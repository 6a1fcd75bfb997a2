//! Symmetric banded matrices: Cholesky factor, solution, and the band of the inverse.

use rayon::prelude::*;

/// Lower band of a symmetric matrix, stored column by column.
#[derive(Debug, Clone)]
pub(crate) struct Banded {
    size: usize,
    /// Number of entries kept below the diagonal.
    reach: usize,
    columns: Vec<f64>,
}

impl Banded {
    pub(crate) fn zeros(size: usize, reach: usize) -> Self {
        Self { size, reach, columns: vec![0.0; size * (reach + 1)] }
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

    /// Replaces a row and a column by those of the identity, which fixes the unknown `i`.
    pub(crate) fn hold(&mut self, i: usize) {
        let width = self.reach + 1;
        self.columns[i * width..(i + 1) * width].fill(0.0);
        for column in i.saturating_sub(self.reach)..i {
            self.columns[column * width + i - column] = 0.0;
        }
        self.columns[i * width] = 1.0;
    }

    /// Entries of `count` columns at a time, the columns of one wavelength, for adding to them on several
    /// threads.
    pub(crate) fn by_columns(
        &mut self,
        count: usize,
    ) -> impl IndexedParallelIterator<Item = ColumnsMut<'_>> {
        let width = self.reach + 1;
        let columns = self.columns.par_chunks_mut(count * width);
        columns.map(move |entries| ColumnsMut { width, entries })
    }

    /// Product with a vector.
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

    /// Cholesky factor; `None` if the matrix is not positive definite.
    ///
    /// Columns are eliminated in panels, whose updates of the columns to the right run on all cores. Each
    /// entry takes its updates in the order of columns, so that the factor is the same for any number of
    /// threads.
    pub(crate) fn cholesky(mut self) -> Option<BandedCholesky> {
        let width = self.reach + 1;
        for first in (0..self.size).step_by(PANEL) {
            let end = (first + PANEL).min(self.size);
            let (head, tail) = self.columns.split_at_mut(end * width);
            let panel = &mut head[first * width..];
            for column in 0..end - first {
                let (own, right) = panel[column * width..].split_at_mut(width);
                let pivot = own[0];
                if !(pivot > 0.0 && pivot.is_finite()) {
                    return None;
                }
                let root = pivot.sqrt();
                own.iter_mut().for_each(|v| *v /= root);
                for (offset, target) in right.chunks_exact_mut(width).take(self.reach).enumerate() {
                    subtract(target, own, offset + 1);
                }
            }
            let update = |(offset, target): (usize, &mut [f64])| {
                let column = end + offset;
                let from = column.saturating_sub(self.reach).max(first) - first;
                subtract_all(target, &panel[from * width..], column - first - from);
            };
            let right = self.reach.min(self.size - end) * width;
            if self.reach < LEAST_PARALLEL {
                tail[..right].chunks_exact_mut(width).enumerate().for_each(update);
            } else {
                let columns = tail[..right].par_chunks_exact_mut(width).enumerate();
                columns.with_min_len(COLUMNS_OF_TASK).for_each(update);
            }
        }
        Some(BandedCholesky { factor: self })
    }
}

/// Columns that are eliminated together; they fit the nearest cache.
const PANEL: usize = 32;
/// Least reach for which the columns of one panel are worth several threads.
const LEAST_PARALLEL: usize = 100;
/// Least number of columns of one task.
const COLUMNS_OF_TASK: usize = 8;
/// Rows of a product that one task computes.
const ROWS_OF_PRODUCT: usize = 512;

/// Subtracts from a column, `offset` to the right of the factor's column `own`, their outer product.
fn subtract(target: &mut [f64], own: &[f64], offset: usize) {
    let Some(factor) = own.get(offset).filter(|factor| **factor != 0.0) else { return };
    for (t, v) in target.iter_mut().zip(&own[offset..]) {
        *t -= factor * v;
    }
}

/// Subtracts from a column the outer products of all columns of `panel` in their order; the first is
/// `offset` to its left.
fn subtract_all(target: &mut [f64], panel: &[f64], offset: usize) {
    let width = target.len();
    let mut columns = panel.chunks_exact(width);
    let mut offset = offset;
    // Four at a time read and write the target once.
    while columns.len() >= 4 {
        let four: [&[f64]; 4] = std::array::from_fn(|i| {
            let column = columns.next().expect("four are left");
            &column[offset - i..]
        });
        let [a, b, c, d] = four;
        let [fa, fb, fc, fd] = four.map(|column| column[0]);
        let common = a.len();
        let both = target[..common].iter_mut().zip(a).zip(&b[..common]);
        for (((t, a), b), (c, d)) in both.zip(c[..common].iter().zip(&d[..common])) {
            *t = *t - fa * a - fb * b - fc * c - fd * d;
        }
        for (at, t) in target.iter_mut().enumerate().take(d.len()).skip(common) {
            for (factor, column) in [(fb, b), (fc, c), (fd, d)] {
                if let Some(v) = column.get(at) {
                    *t -= factor * v;
                }
            }
        }
        offset -= 4;
    }
    for column in columns {
        subtract(target, column, offset);
        offset -= 1;
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

/// Right sides that [`BandedCholesky::solve_together`] solves at once.
pub(crate) const TOGETHER: usize = 16;

/// Cholesky factor L of A = L L'.
#[derive(Debug, Clone)]
pub(crate) struct BandedCholesky {
    factor: Banded,
}

impl BandedCholesky {
    /// Solves A x = `right`.
    pub(crate) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let (size, width) = (self.factor.size, self.factor.reach + 1);
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

    /// Solves A x = b for [`TOGETHER`] right sides at once, which stand side by side in each row. Each
    /// solution is that of [`Self::solve`].
    pub(crate) fn solve_together(&self, x: &mut [[f64; TOGETHER]]) {
        let (size, width) = (self.factor.size, self.factor.reach + 1);
        for (column, entries) in self.factor.columns.chunks_exact(width).enumerate() {
            let value = x[column].map(|v| v / entries[0]);
            x[column] = value;
            let end = (column + width).min(size);
            for (target, entry) in x[column + 1..end].iter_mut().zip(&entries[1..]) {
                target.iter_mut().zip(&value).for_each(|(t, v)| *t -= v * entry);
            }
        }
        for (column, entries) in self.factor.columns.chunks_exact(width).enumerate().rev() {
            let end = (column + width).min(size);
            let mut sum = [0.0; TOGETHER];
            for (row, entry) in x[column + 1..end].iter().zip(&entries[1..]) {
                sum.iter_mut().zip(row).for_each(|(s, v)| *s += v * entry);
            }
            x[column].iter_mut().zip(&sum).for_each(|(v, s)| *v = (*v - s) / entries[0]);
        }
    }

    /// Band of the inverse of A (Takahashi, Fagan and Chin 1973).
    pub(crate) fn inverse_band(&self) -> Banded {
        let (size, reach) = (self.factor.size, self.factor.reach);
        let width = reach + 1;
        let mut inverse = Banded::zeros(size, reach);
        let mut column_of_sums = vec![0.0; width];
        for column in (0..size).rev() {
            let entries = &self.factor.columns[column * width..(column + 1) * width];
            let below = reach.min(size - 1 - column);
            // sums[i] = sum over k of L(k) Z(k, i), both below the diagonal.
            let sums = &mut column_of_sums[..=below];
            sums.fill(0.0);
            for k in 1..=below {
                let from = (column + k) * width;
                sums[k] += entries[k] * inverse.columns[from];
                let lower = &inverse.columns[from + 1..=from + below - k];
                let mut cross = 0.0;
                for (offset, z) in lower.iter().enumerate() {
                    let i = k + 1 + offset;
                    sums[i] += entries[k] * z;
                    cross += entries[i] * z;
                }
                sums[k] += cross;
            }
            let pivot = entries[0];
            let mut diagonal = 1.0 / pivot;
            for i in 1..=below {
                let value = -sums[i] / pivot;
                inverse.columns[column * width + i] = value;
                diagonal -= entries[i] * value;
            }
            inverse.columns[column * width] = diagonal / pivot;
        }
        inverse
    }
}

impl Banded {
    /// Entry at `row` and `column` within the band, where `row >= column`.
    pub(crate) fn at(&self, row: usize, column: usize) -> f64 {
        self.columns[column * (self.reach + 1) + row - column]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    fn example() -> (Banded, DMatrix<f64>) {
        let (size, reach) = (23, 4);
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
                let (a, b) = (band.at(row, column), inverse[(row, column)]);
                assert!((a - b).abs() < 1e-12, "({row}, {column}): {a} {b}");
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
        let (size, reach) = (400, LEAST_PARALLEL + 7);
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
