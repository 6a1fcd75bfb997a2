//! Solution of equations by a Cholesky factor.

use pulp::{Simd, WithSimd};

use super::factor::BandedCholesky;
use super::matrix::Banded;

/// Right sides that [`BandedCholesky::solve_together`] solves at once.
pub(crate) const TOGETHER: usize = 16;

impl BandedCholesky {
    /// Solves A x = `right`.
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

    /// Solves A x = b for [`TOGETHER`] right sides at once, which stand side by side in each row. Each
    /// solution is that of [`Self::solve`].
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
