//! Cholesky factor of a banded matrix.

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use super::matrix::Banded;

/// Columns that are eliminated together; they fit the nearest cache.
const PANEL: usize = 32;
/// Least reach for which the columns of one panel are worth several threads.
pub(super) const LEAST_PARALLEL: usize = 100;
/// Least number of pairs of columns of one task.
const PAIRS_OF_TASK: usize = 4;

/// Cholesky factor L of A = L L'.
#[derive(Debug, Clone)]
pub(crate) struct BandedCholesky {
    pub(super) factor: Banded,
}

impl BandedCholesky {
    /// The factor as a matrix.
    pub(crate) fn into_matrix(self) -> Banded {
        self.factor
    }
}

impl Banded {
    /// Cholesky factor; `None` if the matrix is not positive definite.
    ///
    /// Columns are eliminated in panels, whose updates of the columns to the right run on all cores. Each
    /// entry takes its updates in the order of columns, so that the factor is the same for any number of
    /// threads and any width of the machine's vectors.
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

/// Eliminates the columns of a panel among themselves; `None` if a pivot is not positive.
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

/// Subtracts from a column, `offset` to the right of the factor's column `own`, their outer product.
#[inline(always)]
fn subtract(target: &mut [f64], own: &[f64], offset: usize) {
    let Some(factor) = own.get(offset).filter(|factor| **factor != 0.0) else { return };
    for (t, v) in target.iter_mut().zip(&own[offset..]) {
        *t -= factor * v;
    }
}

/// Subtracts from one column or two neighbours the outer products of all columns of a panel in their
/// order; the first is `offset` to the left of the first target.
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

/// Subtracts from two neighbouring columns the outer products of four columns, given from the row of the
/// first target on.
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
