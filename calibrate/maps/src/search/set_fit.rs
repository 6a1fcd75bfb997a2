//! Shares of one set of pigments for one pixel.

#![expect(
    clippy::needless_range_loop,
    reason = "sums over rows and columns of small matrices read best by their indices"
)]

use crate::films::film::{Difference, Films, MOST_IN_SET, Pixel};

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

    fn difference_of<const N: usize>(&self, films: &Films, pixel: &Pixel) -> Difference {
        let members: [usize; N] = std::array::from_fn(|i| usize::from(self.members[i]));
        films.difference(pixel, members, std::array::from_fn(|i| self.shares[i]))
    }

    /// Moves the shares towards the least chi-square in measured reflectance by `steps` Gauss-Newton steps,
    /// and returns the difference at the best shares that were met.
    pub(crate) fn refine(&mut self, films: &Films, pixel: &Pixel, steps: usize) -> Difference {
        let found = self.difference(films, pixel);
        self.refine_from(found, films, pixel, steps)
    }

    /// Like [`SetFit::refine`], where `found` is the difference at these shares.
    pub(crate) fn refine_from(
        &mut self,
        mut found: Difference,
        films: &Films,
        pixel: &Pixel,
        steps: usize,
    ) -> Difference {
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
    pub(crate) fn covariance(&self, difference: &Difference) -> [[f64; MOST_IN_SET]; MOST_IN_SET] {
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
    match count {
        2 => inverse_of::<2>(difference),
        3 => inverse_of::<3>(difference),
        _ => inverse_of::<MOST_IN_SET>(difference),
    }
}

#[inline(always)]
fn inverse_of<const N: usize>(difference: &Difference) -> Option<(Square, f64)> {
    let mut trace = 0.0;
    for i in 0..N {
        trace += f64::from(difference.normal[i][i]);
    }
    if !(trace.is_finite() && trace > 0.0) {
        return None;
    }
    let weight = trace / N as f64;
    let mut left = [[0.0; MOST_IN_SET]; MOST_IN_SET];
    for i in 0..N {
        for j in 0..N {
            left[i][j] = f64::from(difference.normal[i][j]) + weight;
        }
        left[i][i] *= 1.0 + 1e-6;
    }
    Some((inverted::<N>(left)?, weight))
}

/// Inverse of a positive definite matrix by Gauss-Jordan elimination; `None` if a pivot is not positive.
#[inline(always)]
fn inverted<const N: usize>(mut left: Square) -> Option<Square> {
    let mut right = [[0.0; MOST_IN_SET]; MOST_IN_SET];
    for i in 0..N {
        right[i][i] = 1.0;
    }
    for pivot in 0..N {
        let value = left[pivot][pivot];
        let is_definite = value > 0.0;
        if !is_definite {
            return None;
        }
        for column in 0..N {
            left[pivot][column] /= value;
            right[pivot][column] /= value;
        }
        for row in 0..N {
            if row != pivot {
                let factor = left[row][pivot];
                for column in 0..N {
                    left[row][column] -= factor * left[pivot][column];
                    right[row][column] -= factor * right[pivot][column];
                }
            }
        }
    }
    Some(right)
}
