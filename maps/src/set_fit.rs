//! Shares of one set of pigments for one pixel.

use wide::f32x8;

use crate::film::{Difference, Films, MOST_IN_SET, Pixel, Work};
use crate::whitening::LANES;

/// A set of one to four pigments with shares that fit a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SetFit {
    /// Places of the pigments, rising; `u8::MAX` beyond the last.
    pub(crate) members: [u8; MOST_IN_SET],
    pub(crate) count: u8,
    /// Shares of the members, sum 1.
    pub(crate) shares: [f32; MOST_IN_SET],
    pub(crate) chi2: f32,
    /// -2 ln of the likelihood, with the penalty of each pigment.
    pub(crate) score: f32,
}

impl SetFit {
    /// A set of pigments in any order, with their shares.
    pub(crate) fn new<const N: usize>(members: [usize; N], shares: [f32; N], chi2: f32) -> Self {
        let mut fit = Self {
            members: [u8::MAX; MOST_IN_SET],
            count: N as u8,
            shares: [0.0; MOST_IN_SET],
            chi2,
            score: f32::INFINITY,
        };
        for i in 0..N {
            let place = (0..N).filter(|&j| members[j] < members[i]).count();
            fit.members[place] = members[i] as u8;
            fit.shares[place] = shares[i];
        }
        fit
    }

    /// A set of one to four pigments with their shares; `None` for any other number.
    pub(crate) fn of_parts(parts: &[(usize, f32)]) -> Option<Self> {
        let unknown = f32::INFINITY;
        Some(match *parts {
            [(a, x)] => Self::new([a], [x], unknown),
            [(a, x), (b, y)] => Self::new([a, b], [x, y], unknown),
            [(a, x), (b, y), (c, z)] => Self::new([a, b, c], [x, y, z], unknown),
            [(a, x), (b, y), (c, z), (d, w)] => Self::new([a, b, c, d], [x, y, z, w], unknown),
            _ => return None,
        })
    }

    /// The set as one number.
    pub(crate) fn key(&self) -> u32 {
        u32::from_be_bytes(self.members)
    }

    pub(crate) fn len(&self) -> usize {
        usize::from(self.count)
    }

    /// Pigments with their shares.
    pub(crate) fn parts(&self) -> impl Iterator<Item = (usize, f32)> + '_ {
        let pairs = self.members.iter().zip(&self.shares).take(self.len());
        pairs.map(|(&member, &share)| (usize::from(member), share))
    }

    /// Compares `pixel` with the film of these shares.
    pub(crate) fn difference(&self, films: &Films, pixel: &Pixel) -> Difference {
        match self.count {
            1 => self.difference_of::<1>(films, pixel),
            2 => self.difference_of::<2>(films, pixel),
            3 => self.difference_of::<3>(films, pixel),
            _ => self.difference_of::<MOST_IN_SET>(films, pixel),
        }
    }

    fn difference_of<const N: usize>(
        &self,
        films: &Films,
        pixel: &Pixel,
    ) -> Difference {
        let members: [usize; N] = std::array::from_fn(|i| usize::from(self.members[i]));
        films.difference(pixel, members, std::array::from_fn(|i| self.shares[i]))
    }

    /// Moves the shares towards the least chi-square in measured reflectance by `steps` Gauss-Newton steps,
    /// and returns the difference at the best shares that were met.
    pub(crate) fn refine(
        &mut self,
        films: &Films,
        pixel: &Pixel,
        steps: usize,
    ) -> Difference {
        let mut found = self.difference(films, pixel);
        self.chi2 = found.chi2;
        if self.count == 1 {
            return found;
        }
        let mut tried = self.stepped(&found);
        for step in 1..=steps {
            let difference = tried.difference(films, pixel);
            if difference.chi2 < self.chi2 {
                self.shares = tried.shares;
                self.chi2 = difference.chi2;
                found = difference;
                if step < steps {
                    tried = self.stepped(&found);
                }
            } else {
                // The step was too long.
                for (share, best) in tried.shares.iter_mut().zip(&self.shares) {
                    *share = 0.75 * best + 0.25 * *share;
                }
            }
        }
        found
    }

    /// Copy after one full step. A share falls to a tenth at most, so that the step stays on the simplex.
    fn stepped(&self, difference: &Difference) -> Self {
        let mut next = *self;
        let step = match inverse(difference, self.len()) {
            Some((inverse, _)) => product(&inverse, &difference.right, self.len()),
            None => [0.0; MOST_IN_SET],
        };
        let mut sum = 0.0;
        for i in 0..self.len() {
            let share = self.shares[i];
            next.shares[i] = (share + step[i] as f32).max(0.1 * share).max(1e-7);
            sum += next.shares[i];
        }
        for share in &mut next.shares[..self.len()] {
            *share /= sum;
        }
        next
    }

    /// Variances and covariances of the shares, from the curvature of chi-square on the simplex.
    pub(crate) fn covariance(
        &self,
        difference: &Difference,
    ) -> [[f64; MOST_IN_SET]; MOST_IN_SET] {
        let count = self.len();
        let mut covariance = [[0.0; MOST_IN_SET]; MOST_IN_SET];
        if count == 1 {
            return covariance;
        }
        if let Some((inverse, weight)) = inverse(difference, count) {
            for i in 0..count {
                for j in 0..count {
                    let along = f64::from(self.shares[i]) * f64::from(self.shares[j]) / weight;
                    covariance[i][j] = inverse[i][j] - along;
                }
            }
        }
        covariance
    }
}

/// Variance of a share that may be anything from 0 to 1.
const FREE_SHARE: f64 = 1.0 / 12.0;

impl Difference {
    /// -2 ln of the part of all shares of `count` pigments that agree with the pixel, where variances are
    /// `excess` times those of the curvature: what a set pays for shares that had to be found exactly.
    pub(crate) fn exactness(&self, count: usize, excess: f64) -> f64 {
        let last = count - 1;
        let mut left = [[0.0; MOST_IN_SET]; MOST_IN_SET];
        let at = |i: usize, j: usize| f64::from(self.normal[i][j]);
        for i in 0..last {
            for j in 0..last {
                let along = at(i, j) - at(i, last) - at(j, last) + at(last, last);
                left[i][j] = FREE_SHARE * along / excess + if i == j { 1.0 } else { 0.0 };
            }
        }
        let mut determinant = 1.0;
        for pivot in 0..last {
            let value = left[pivot][pivot].max(1.0);
            determinant *= value;
            for row in pivot + 1..last {
                let factor = left[row][pivot] / value;
                for column in pivot..last {
                    left[row][column] -= factor * left[pivot][column];
                }
            }
        }
        determinant.ln()
    }
}

type Square = [[f64; MOST_IN_SET]; MOST_IN_SET];

fn product(matrix: &Square, vector: &[f32; MOST_IN_SET], count: usize) -> [f64; MOST_IN_SET] {
    let mut result = [0.0; MOST_IN_SET];
    for i in 0..count {
        for j in 0..count {
            result[i] += matrix[i][j] * f64::from(vector[j]);
        }
    }
    result
}

/// Inverse of the normal equations with `weight` added to every entry, and this weight.
///
/// The reflectance does not change if all shares grow alike, so that the equations are singular along the
/// shares. The weight removes that, and a step by the inverse keeps the sum of the shares.
fn inverse(difference: &Difference, count: usize) -> Option<(Square, f64)> {
    let mut trace = 0.0;
    for i in 0..count {
        trace += f64::from(difference.normal[i][i]);
    }
    if !(trace.is_finite() && trace > 0.0) {
        return None;
    }
    let weight = trace / count as f64;
    let mut left = [[0.0; MOST_IN_SET]; MOST_IN_SET];
    for i in 0..count {
        for j in 0..count {
            left[i][j] = f64::from(difference.normal[i][j]) + weight;
        }
        left[i][i] *= 1.0 + 1e-6;
    }
    Some((inverted(left, count)?, weight))
}

/// Inverse of a positive definite matrix by Gauss-Jordan elimination; `None` if a pivot is not positive.
fn inverted(mut left: Square, count: usize) -> Option<Square> {
    let mut right = [[0.0; MOST_IN_SET]; MOST_IN_SET];
    for i in 0..count {
        right[i][i] = 1.0;
    }
    for pivot in 0..count {
        let value = left[pivot][pivot];
        if !(value > 0.0) {
            return None;
        }
        for column in 0..count {
            left[pivot][column] /= value;
            right[pivot][column] /= value;
        }
        for row in 0..count {
            if row != pivot {
                let factor = left[row][pivot];
                for column in 0..count {
                    left[row][column] -= factor * left[pivot][column];
                    right[row][column] -= factor * right[pivot][column];
                }
            }
        }
    }
    Some(right)
}

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
        if !(to_a > 0.0 && to_b > 0.0) {
            return None;
        }
        let share = to_a / (to_a + to_b);
        Some((share, bb - share * to_a))
    }

    /// Calls `found` with the places, the shares and the sum of squares of three pigments whose best shares
    /// are all above 0, if the sum is below a limit: at first `limit`, then what `found` returned last.
    pub(crate) fn triples(
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
                let (square, to_b) = (self.at(b, b) - 2.0 * self.at(a, b) + base, base - self.at(a, b));
                if !(square > 1e-9 * base) {
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
                        if !(b < c && c < count) {
                            continue;
                        }
                        let along = (self.at(b, c) - self.at(a, c) - self.at(a, b) + base) * inverse;
                        let rest = self.at(c, c) - 2.0 * self.at(a, c) + base
                            - along * along * square;
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
            if !(value > 1e-9 * base) {
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
            if !(x[row] > 0.0) {
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
