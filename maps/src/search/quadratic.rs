//! The linearised problem of one pixel: sums of squares of all small sets of pigments in closed form.

#![expect(
    clippy::needless_range_loop,
    reason = "sums over rows and columns of small matrices read best by their indices"
)]

use wide::f32x8;

use super::set_fit::SetFit;
use crate::films::film::{MOST_IN_SET, Work};
use crate::films::vectors::{Task, by_vectors};
use crate::films::whitening::LANES;

/// Products of the rows of pigments, by place.
#[derive(Debug, Clone)]
pub(crate) struct Quadratic {
    count: usize,
    /// Products by pair.
    products: Vec<f64>,
    /// Products by pair in lanes, of which the upper half is valid.
    rows: Vec<f32x8>,
    /// Products of each pigment with itself, in lanes.
    own: Vec<f32x8>,
    /// Sizes by which the rows are divided; the shares of a set are divided by them too.
    sizes: Vec<f64>,
}

impl Quadratic {
    /// Memory for the products of `count` pigments.
    pub(crate) fn new(count: usize) -> Self {
        let columns = count.div_ceil(LANES);
        Self {
            count,
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
            let product = |lane: usize| {
                let place = block * LANES + lane;
                if place < self.count { work.product(place, place) } else { 0.0 }
            };
            *own = f32x8::new(std::array::from_fn(product));
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

    #[inline(always)]
    fn at(&self, a: usize, b: usize) -> f64 {
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
        let (aa, ab, bb) = (self.at(a, a), self.at(a, b), self.at(b, b));
        let (to_a, to_b) = (bb - ab, aa - ab);
        let share = to_a / (to_a + to_b);
        (to_a > 0.0 && to_b > 0.0).then_some((share, bb - share * to_a))
    }

    /// Calls `found` with the places, the shares and the sum of squares of three pigments whose best shares
    /// are all above 0, if the sum is below a limit: at first `limit`, then what `found` returned last.
    pub(crate) fn triples(&self, limit: f64, found: impl FnMut([usize; 3], [f64; 3], f64) -> f64) {
        by_vectors(Triples { quadratic: self, limit, found });
    }

    #[inline(always)]
    fn sets_of_three(
        &self,
        mut limit: f64,
        mut found: impl FnMut([usize; 3], [f64; 3], f64) -> f64,
    ) {
        let (count, columns) = (self.count, self.own.len());
        for a in 0..count {
            let base = self.at(a, a);
            let of_a = &self.rows[a * columns..(a + 1) * columns];
            for b in a + 1..count {
                // Differences from pigment `a` span the plane of shares of sum 1.
                let (square, to_b) =
                    (self.at(b, b) - 2.0 * self.at(a, b) + base, base - self.at(a, b));
                let spans_a_line = square > 1e-9 * base;
                if !spans_a_line {
                    continue;
                }
                let (inverse, of_pair) = (1.0 / square, base - to_b * to_b / square);
                let of_b = &self.rows[b * columns..(b + 1) * columns];
                let splat = |value: f64| f32x8::splat(value as f32);
                let (shift, slope) = (splat(base - self.at(a, b)), splat(inverse));
                let (base_of_all, square_of_all, to_b_of_all) =
                    (splat(base), splat(square), splat(to_b));
                for block in (b + 1) / LANES..columns {
                    let along = (of_b[block] - of_a[block] + shift) * slope;
                    let rest = self.own[block] - of_a[block] - of_a[block] + base_of_all
                        - along * along * square_of_all;
                    let to_c = base_of_all - of_a[block] - to_b_of_all * along;
                    // Most sets end here, where a little slack makes up for rounding.
                    let saved = splat(of_pair - 1.01 * limit - 1e-6 * base);
                    let near = to_c.simd_gt(f32x8::ZERO) & (to_c * to_c).simd_gt(saved * rest);
                    let mut lanes = near.to_bitmask();
                    while lanes != 0 {
                        let c = block * LANES + lanes.trailing_zeros() as usize;
                        lanes &= lanes - 1;
                        if c <= b || c >= count {
                            continue;
                        }
                        let along =
                            (self.at(b, c) - self.at(a, c) - self.at(a, b) + base) * inverse;
                        let rest =
                            self.at(c, c) - 2.0 * self.at(a, c) + base - along * along * square;
                        let share_c = (base - self.at(a, c) - to_b * along) / rest;
                        let share_b = to_b * inverse - share_c * along;
                        let share_a = 1.0 - share_b - share_c;
                        let sum = of_pair - share_c * share_c * rest;
                        let inside = share_a > 0.0 && share_b > 0.0 && share_c > 0.0;
                        if inside && rest > 1e-9 * base && sum < limit {
                            limit = found([a, b, c], [share_a, share_b, share_c], sum);
                        }
                    }
                }
            }
        }
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
        let (mut sum, mut saved) = (0.0, 0.0);
        for i in 0..N - 1 {
            sum += x[i];
            saved += x[i] * right[i];
        }
        x[N - 1] = 1.0 - sum;
        (x[N - 1] > 0.0).then(|| self.fit(members, x, base - saved))
    }
}

struct Triples<'a, F> {
    quadratic: &'a Quadratic,
    limit: f64,
    found: F,
}

impl<F: FnMut([usize; 3], [f64; 3], f64) -> f64> Task for Triples<'_, F> {
    type Result = ();

    #[inline(always)]
    fn run(self) {
        self.quadratic.sets_of_three(self.limit, self.found);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Products of ten rows of invented numbers.
    fn invented() -> Quadratic {
        let rows: Vec<Vec<f64>> = (0..10)
            .map(|p: usize| (0..12).map(|b| ((3 * p * p + 7 * b * p + b) as f64).sin()).collect())
            .collect();
        let mut quadratic = Quadratic::new(rows.len());
        for (a, first) in rows.iter().enumerate() {
            for (b, second) in rows.iter().enumerate() {
                let product: f64 = first.iter().zip(second).map(|(x, y)| x * y).sum();
                quadratic.products[a * 10 + b] = product;
                let block = &mut quadratic.rows[a * 2 + b / LANES];
                let mut lanes = block.to_array();
                lanes[b % LANES] = product as f32;
                *block = f32x8::new(lanes);
                if a == b {
                    let mut lanes = quadratic.own[a / LANES].to_array();
                    lanes[a % LANES] = product as f32;
                    quadratic.own[a / LANES] = f32x8::new(lanes);
                }
            }
        }
        quadratic
    }

    #[test]
    fn triples_are_those_of_the_closed_form_of_each_set() {
        let quadratic = invented();
        let mut found = Vec::new();
        quadratic.triples(f64::INFINITY, |members, shares, sum| {
            found.push(quadratic.fit(members, shares, sum));
            f64::INFINITY
        });
        let mut expected = Vec::new();
        for a in 0..10 {
            for b in a + 1..10 {
                for c in b + 1..10 {
                    expected.extend(quadratic.set([a, b, c]));
                }
            }
        }
        assert!(expected.len() > 10, "{} sets inside", expected.len());
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(found.members, expected.members);
            assert!((found.chi2 - expected.chi2).abs() < 1e-5, "{found:?} {expected:?}");
            for (a, b) in found.shares.iter().zip(&expected.shares) {
                assert!((a - b).abs() < 1e-5, "{found:?} {expected:?}");
            }
        }
        let least = found.iter().map(|set| set.chi2).fold(f32::INFINITY, f32::min);
        let mut below = Vec::new();
        quadratic.triples(f64::from(least) * 1.5, |members, shares, sum| {
            below.push(quadratic.fit(members, shares, sum));
            f64::from(least) * 1.5
        });
        let expected = found.iter().filter(|set| set.chi2 < 1.5 * least).count();
        assert_eq!(below.len(), expected, "sets below a limit");
    }
}
