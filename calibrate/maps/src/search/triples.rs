//! The linearised problem of one pixel. We compute the sums of squares of all small sets of
//! pigments in closed form.
//!
//! There are many sets of three, and most of them explain nothing, so we rule them out early by
//! bounds.

#![expect(
    clippy::needless_range_loop,
    reason = "sums over rows and columns of small matrices read best by their indices"
)]

use wide::f32x8;

use super::set_fit::SetFit;
use crate::films::film::{MOST_IN_SET, Work};
use crate::films::whitening::{Eight, LANES, Task, Vectors, by_vectors};

/// A pair of pigments, `a` and `b`, in the search of sets of three. In the space of rows, their
/// mixtures lie on the line through both.
#[derive(Debug, Clone, Copy, Default)]
struct Line {
    /// Square of the distance from `a` to `b`, and its inverse.
    square: f64,
    inverse: f64,
    /// Scalar product of the differences of `b` and of the pixel from `a`.
    to_b: f64,
    /// Least sum of squares of a mixture of both, with shares of any sign.
    of_pair: f64,
}

/// Memory of [`Quadratic::triples`].
#[derive(Debug)]
pub(crate) struct Marks {
    lines: Vec<Line>,
    /// For each second pigment and block, a bit for each third pigment.
    lanes: Vec<u32>,
}

impl Marks {
    pub(crate) fn new(count: usize) -> Self {
        let columns = count.div_ceil(LANES);
        Self { lines: vec![Line::default(); count], lanes: vec![0; count * columns] }
    }
}

struct Triples<'a, F> {
    quadratic: &'a Quadratic,
    limit: f64,
    marks: &'a mut Marks,
    found: F,
}

impl<F: FnMut([usize; 3], [f64; 3], f64) -> f64> Task for Triples<'_, F> {
    type Result = ();

    #[inline(always)]
    fn run<V: Vectors>(self, v: V) {
        self.quadratic.sets_of_three(v, self.limit, self.marks, self.found);
    }
}

impl Quadratic {
    /// Calls `found` for each set of three pigments with best shares above 0 and a sum of squares
    /// below a limit. `found` gets the indices, the shares and the sum. The limit is `limit` at
    /// first, then whatever `found` returned last.
    pub(crate) fn triples(
        &self,
        limit: f64,
        marks: &mut Marks,
        found: impl FnMut([usize; 3], [f64; 3], f64) -> f64,
    ) {
        by_vectors(Triples { quadratic: self, limit, marks, found });
    }

    #[inline(always)]
    fn sets_of_three<V: Vectors>(
        &self,
        v: V,
        mut limit: f64,
        marks: &mut Marks,
        mut found: impl FnMut([usize; 3], [f64; 3], f64) -> f64,
    ) {
        let count = self.count;
        let columns = self.own.len();
        for a in 0..count {
            let base = self.at(a, a);
            // All sets are marked before one is looked at: branches that depend on each would cost more than
            // the arithmetic.
            for b in a + 1..count {
                marks.lines[b] = self.line(a, b);
                self.mark(v, (a, b), limit, marks);
            }
            for b in a + 1..count {
                let Line { square, to_b, inverse, of_pair } = marks.lines[b];
                for block in (b + 1 + self.before) / LANES..columns {
                    let mut lanes = marks.lanes[b * columns + block];
                    while lanes != 0 {
                        let lane = lanes.trailing_zeros() as usize;
                        lanes &= lanes - 1;
                        let c = block * LANES + lane - self.before;
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

    #[inline(always)]
    fn line(&self, a: usize, b: usize) -> Line {
        let base = self.at(a, a);
        let across = self.at(a, b);
        let square = self.at(b, b) - 2.0 * across + base;
        let to_b = base - across;
        Line { square, to_b, inverse: 1.0 / square, of_pair: base - to_b * to_b / square }
    }

    /// Marks each third pigment after `b` that may be in a set with `a` and `b` and a sum below
    /// `limit`. We leave a little slack for rounding.
    #[inline(always)]
    fn mark<V: Vectors>(&self, v: V, (a, b): (usize, usize), limit: f64, marks: &mut Marks) {
        let columns = self.own.len();
        let splat = |value: f64| v.splat(value as f32);
        let base = self.at(a, a);
        let Line { square, to_b, inverse, of_pair } = marks.lines[b];
        let spans_a_line = square > 1e-9 * base;
        let [of_a, of_b] = [a, b].map(|place| {
            let row = place + self.before;
            &self.rows[row * columns..(row + 1) * columns]
        });
        let shift = splat(to_b);
        let slope = splat(inverse);
        let base_of_all = splat(base);
        let square_of_all = splat(square);
        let saved = splat(of_pair - 1.01 * limit - 1e-6 * base);
        let after = b + 1 + self.before;
        let mut kept = if spans_a_line { u32::MAX << (after % LANES) } else { 0 };
        for block in after / LANES..columns {
            let with_a = v.load(of_a[block]);
            let with_b = v.load(of_b[block]);
            let along = (with_b - with_a + shift) * slope;
            let rest = v.load(self.own[block]) - with_a - with_a + base_of_all
                - along * along * square_of_all;
            let to_c = base_of_all - with_a - shift * along;
            let near = to_c.is_above(v.splat(0.0)) & (to_c * to_c).is_above(saved * rest);
            marks.lanes[b * columns + block] = near & kept;
            kept = if spans_a_line { u32::MAX } else { 0 };
        }
    }
}

/// Products of the rows of all pairs of pigments, from [`Work`].
#[derive(Debug, Clone)]
pub(crate) struct Quadratic {
    pub(super) count: usize,
    /// Lanes before the first pigment.
    pub(super) before: usize,
    /// Products by pair.
    pub(super) products: Vec<f64>,
    /// Products by pair in lanes, in a row for each pigment. A row is valid only for the pigment itself
    /// and later ones.
    pub(super) rows: Vec<f32x8>,
    /// Products of each pigment with itself, in lanes.
    pub(super) own: Vec<f32x8>,
    /// Numbers by which we divided the rows. The shares of a set must be divided by them too.
    sizes: Vec<f64>,
}

impl Quadratic {
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

    /// Copies the products from `work`.
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

    #[inline(always)]
    pub(super) fn at(&self, a: usize, b: usize) -> f64 {
        self.products[a * self.count + b]
    }

    /// Makes a set. `parts` are its shares of the divided rows.
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

    pub(crate) fn single(&self, a: usize) -> SetFit {
        SetFit::new([a], [1.0], self.at(a, a) as f32)
    }

    /// The share of the first of two pigments that gives the least sum of squares, and this sum.
    /// You get `None` if a share is 0 or less.
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

    /// The set of these pigments with the shares of least sum of squares, or `None` if a share is 0
    /// or less.
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

#[cfg(test)]
mod tests {
    use super::*;
    use wide::f32x8;

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
                let block = &mut quadratic.rows[(a + 6) * 2 + (b + 6) / LANES];
                let mut lanes = block.to_array();
                lanes[(b + 6) % LANES] = product as f32;
                *block = f32x8::new(lanes);
                if a == b {
                    let mut lanes = quadratic.own[(a + 6) / LANES].to_array();
                    lanes[(a + 6) % LANES] = product as f32;
                    quadratic.own[(a + 6) / LANES] = f32x8::new(lanes);
                }
            }
        }
        quadratic
    }

    #[test]
    fn triples_are_those_of_the_closed_form_of_each_set() {
        let quadratic = invented();
        let mut found = Vec::new();
        quadratic.triples(f64::INFINITY, &mut Marks::new(10), |members, shares, sum| {
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
        quadratic.triples(f64::from(least) * 1.5, &mut Marks::new(10), |members, shares, sum| {
            below.push(quadratic.fit(members, shares, sum));
            f64::from(least) * 1.5
        });
        let expected = found.iter().filter(|set| set.chi2 < 1.5 * least).count();
        assert_eq!(below.len(), expected, "sets below a limit");
    }
}
