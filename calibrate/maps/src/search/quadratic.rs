//! The linearised problem of one pixel: sums of squares of all small sets of pigments in closed form.

#![expect(
    clippy::needless_range_loop,
    reason = "sums over rows and columns of small matrices read best by their indices"
)]

use wide::f32x8;

use super::set_fit::SetFit;
use crate::films::film::{MOST_IN_SET, Work};
use crate::films::whitening::LANES;

/// Products of the rows of pigments, by place.
#[derive(Debug, Clone)]
pub(crate) struct Quadratic {
    pub(super) count: usize,
    /// Lanes before that of the first pigment.
    pub(super) before: usize,
    /// Products by pair.
    pub(super) products: Vec<f64>,
    /// Products by pair in lanes, of which the upper half is valid.
    pub(super) rows: Vec<f32x8>,
    /// Products of each pigment with itself, in lanes.
    pub(super) own: Vec<f32x8>,
    /// Sizes by which the rows are divided; the shares of a set are divided by them too.
    sizes: Vec<f64>,
}

impl Quadratic {
    /// Memory for the products of `count` pigments.
    pub(crate) fn new(count: usize) -> Self {
        let columns = count.div_ceil(LANES);
        Self {
            count,
            before: columns * LANES - count,
            products: vec![0.0; count * count],
            rows: vec![f32x8::ZERO; columns * LANES * columns],
            own: vec![f32x8::ZERO; columns],
            sizes: vec![1.0; count],
        }
    }

    /// Takes over the products that were computed in `work`.
    pub(crate) fn read(&mut self, work: &Work) {
        self.rows.copy_from_slice(&work.products);
        for (block, own) in self.own.iter_mut().enumerate() {
            *own = f32x8::new(std::array::from_fn(|lane: usize| {
                let place = (block * LANES + lane).checked_sub(self.before);
                place.map_or(0.0, |place| work.product(place, place))
            }));
        }
        for a in 0..self.count {
            self.sizes[a] = f64::from(work.size(a));
            for b in a..self.count {
                let product = f64::from(work.product(a, b));
                self.products[a * self.count + b] = product;
                self.products[b * self.count + a] = product;
            }
        }
    }

    /// Product of the rows of two pigments.
    #[inline(always)]
    pub(super) fn at(&self, a: usize, b: usize) -> f64 {
        self.products[a * self.count + b]
    }

    /// A set whose parts of the divided rows are `parts`.
    pub(crate) fn fit<const N: usize>(
        &self,
        members: [usize; N],
        parts: [f64; N],
        chi2: f64,
    ) -> SetFit {
        let mut shares = [0.0; N];
        let mut sum = 0.0;
        for i in 0..N {
            shares[i] = parts[i] / self.sizes[members[i]];
            sum += shares[i];
        }
        SetFit::new(members, shares.map(|share| (share / sum) as f32), chi2 as f32)
    }

    /// A single pigment.
    pub(crate) fn single(&self, a: usize) -> SetFit {
        SetFit::new([a], [1.0], self.at(a, a) as f32)
    }

    /// Shares of two pigments where the sum of squares is least; `None` if one is 0 or less.
    #[inline(always)]
    pub(crate) fn pair(&self, a: usize, b: usize) -> Option<(f64, f64)> {
        let aa = self.at(a, a);
        let ab = self.at(a, b);
        let bb = self.at(b, b);
        let to_a = bb - ab;
        let to_b = aa - ab;
        let share = to_a / (to_a + to_b);
        (to_a > 0.0 && to_b > 0.0).then_some((share, bb - share * to_a))
    }

    /// Shares of a set where the sum of squares is least; `None` if one is 0 or less.
    pub(crate) fn set<const N: usize>(&self, members: [usize; N]) -> Option<SetFit> {
        // The last share is 1 less the others.
        let last = members[N - 1];
        let base = self.at(last, last);
        let to_last: [f64; N] = std::array::from_fn(|i| self.at(members[i], last));
        let mut left = [[0.0; MOST_IN_SET]; MOST_IN_SET];
        let mut x: [f64; N] = std::array::from_fn(|i| base - to_last[i]);
        for i in 0..N - 1 {
            for j in 0..N - 1 {
                left[i][j] = self.at(members[i], members[j]) - to_last[i] - to_last[j] + base;
            }
        }
        let right = x;
        for pivot in 0..N - 1 {
            let value = left[pivot][pivot];
            let is_independent = value > 1e-9 * base;
            if !is_independent {
                return None;
            }
            for row in pivot + 1..N - 1 {
                let factor = left[row][pivot] / value;
                for column in pivot..N - 1 {
                    left[row][column] -= factor * left[pivot][column];
                }
                x[row] -= factor * x[pivot];
            }
        }
        for row in (0..N - 1).rev() {
            for column in row + 1..N - 1 {
                x[row] -= left[row][column] * x[column];
            }
            x[row] /= left[row][row];
            let is_inside = x[row] > 0.0;
            if !is_inside {
                return None;
            }
        }
        let mut sum = 0.0;
        let mut saved = 0.0;
        for i in 0..N - 1 {
            sum += x[i];
            saved += x[i] * right[i];
        }
        x[N - 1] = 1.0 - sum;
        (x[N - 1] > 0.0).then(|| self.fit(members, x, base - saved))
    }
}
