//! Symmetric banded matrices: Cholesky factor, solution, and the band of the inverse.

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

    /// Product with a vector.
    pub(crate) fn times(&self, vector: &[f64]) -> Vec<f64> {
        let width = self.reach + 1;
        let mut product = vec![0.0; self.size];
        for (column, entries) in self.columns.chunks_exact(width).enumerate() {
            product[column] += entries[0] * vector[column];
            let rows = column + 1..(column + width).min(self.size);
            for (row, entry) in rows.zip(&entries[1..]) {
                product[row] += entry * vector[column];
                product[column] += entry * vector[row];
            }
        }
        product
    }

    /// Cholesky factor; `None` if the matrix is not positive definite.
    pub(crate) fn cholesky(mut self) -> Option<BandedCholesky> {
        let width = self.reach + 1;
        for column in 0..self.size {
            let start = column * width;
            let pivot = self.columns[start];
            if !(pivot > 0.0 && pivot.is_finite()) {
                return None;
            }
            let root = pivot.sqrt();
            let (head, tail) = self.columns.split_at_mut(start + width);
            let own = &mut head[start..];
            own.iter_mut().for_each(|v| *v /= root);
            // Subtracts the outer product from the columns to the right.
            let below = self.reach.min(self.size - 1 - column);
            for offset in 1..=below {
                let factor = own[offset];
                if factor == 0.0 {
                    continue;
                }
                let target = &mut tail[(offset - 1) * width..];
                for (t, v) in target.iter_mut().zip(&own[offset..=below]) {
                    *t -= factor * v;
                }
            }
        }
        Some(BandedCholesky { factor: self })
    }
}

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
}
