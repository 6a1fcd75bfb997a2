//! Shares of one set of pigments for one pixel, and the score of the set.
//!
//! The score combines how well a set explains the pixel with how likely we take the set to be
//! beforehand.

#![expect(
    clippy::needless_range_loop,
    reason = "sums over rows and columns of small matrices read best by their indices"
)]

use crate::films::film::{Difference, Films, MOST_IN_SET, Pixel};
use crate::films::settings::Evidence;

/// We do not refine a set further if a step saves less chi-square than this. It changes the weight
/// of a set by 1 % at most.
const CONVERGED: f64 = 0.02;

/// A set of one to four pigments with shares that fit a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SetFit {
    /// Indices of the pigments, rising, with `u8::MAX` beyond the last.
    pub(crate) members: [u8; MOST_IN_SET],
    pub(crate) count: u8,
    /// Shares of the members, sum 1.
    pub(crate) shares: [f32; MOST_IN_SET],
    pub(crate) chi2: f32,
    /// -2 ln of the likelihood, with the penalty of each pigment.
    pub(crate) score: f32,
}

impl SetFit {
    /// Makes a set of pigments with their shares. You may pass them in any order.
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

    /// Makes a set of one to four pigments with their shares. Any other number gives `None`.
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

    /// The pigments of the set, packed into one number.
    pub(crate) fn key(&self) -> u32 {
        u32::from_be_bytes(self.members)
    }

    pub(crate) fn len(&self) -> usize {
        usize::from(self.count)
    }

    /// The columns of the members as bits.
    pub(crate) fn columns(&self, column_of: &[usize]) -> u64 {
        self.parts().fold(0, |bits, (member, _)| bits | 1 << column_of[member])
    }

    pub(crate) fn parts(&self) -> impl Iterator<Item = (usize, f32)> + '_ {
        let pairs = self.members.iter().zip(&self.shares).take(self.len());
        pairs.map(|(&member, &share)| (usize::from(member), share))
    }

    /// Compares `pixel` with the film of this set.
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

    /// Moves the shares towards the least chi-square in measured reflectance by `steps`
    /// Gauss-Newton steps. Keeps the best shares on the way and returns their difference.
    pub(crate) fn refine(&mut self, films: &Films, pixel: &Pixel, steps: usize) -> Difference {
        let found = self.difference(films, pixel);
        self.refine_from(found, films, pixel, steps)
    }

    /// Like [`SetFit::refine`], but you pass the difference at these shares as `found`. This stops
    /// before a step that would save less than [`CONVERGED`].
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
        let (mut tried, mut saved) = self.stepped(&found);
        for step in 1..=steps {
            if saved < CONVERGED {
                break;
            }
            let difference = tried.difference(films, pixel);
            if difference.chi2 < self.chi2 {
                self.shares = tried.shares;
                self.chi2 = difference.chi2;
                found = difference;
                if step < steps {
                    (tried, saved) = self.stepped(&found);
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

    /// Copy with the shares after one full Gauss-Newton step, and how much chi-square this saves if
    /// the reflectance is linear. We let a share fall to a tenth at most, so that the step stays on
    /// the simplex.
    fn stepped(&self, difference: &Difference) -> (Self, f64) {
        let mut next = *self;
        let step = match inverse(difference, self.len()) {
            Some((inverse, _)) => product(&inverse, &difference.right, self.len()),
            None => [0.0; MOST_IN_SET],
        };
        let mut sum = 0.0;
        let mut saved = 0.0;
        for i in 0..self.len() {
            let share = self.shares[i];
            next.shares[i] = (share + step[i] as f32).max(0.1 * share).max(1e-7);
            sum += next.shares[i];
            saved += step[i] * f64::from(difference.right[i]);
        }
        for share in &mut next.shares[..self.len()] {
            *share /= sum;
        }
        (next, saved)
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

impl Difference {
    /// -2 ln of the fraction of all possible shares of `count` pigments that agree with the pixel.
    /// This is the price of a set with exact shares. We multiply the variances that follow from the
    /// curvature by `excess`.
    ///
    /// All shares of sum 1 are equally likely beforehand (Dirichlet with parameters of 1). With m
    /// pigments, the covariance of all shares but the last is (I - J / m) / (m (m + 1)), where J
    /// holds ones, and its square root is (I - t J) / sqrt(m (m + 1)) with t = (1 - 1 / sqrt(m)) / (m - 1).
    pub(crate) fn exactness(&self, count: usize, excess: f64) -> f64 {
        if count == 1 {
            return 0.0;
        }
        let last = count - 1;
        let normal = self.normal.map(|row| row.map(f64::from));
        let mut along = [[0.0; MOST_IN_SET]; MOST_IN_SET];
        let mut sums = [0.0; MOST_IN_SET];
        let mut all = 0.0;
        for i in 0..last {
            for j in 0..last {
                along[i][j] = normal[i][j] - normal[i][last] - normal[j][last] + normal[last][last];
                sums[i] += along[i][j];
            }
            all += sums[i];
        }
        let pigments = count as f64;
        let t = (1.0 - 1.0 / pigments.sqrt()) / (pigments - 1.0);
        let variance = 1.0 / (pigments * (pigments + 1.0) * excess);
        let mut left = [[0.0; MOST_IN_SET]; MOST_IN_SET];
        for i in 0..last {
            for j in 0..last {
                left[i][j] = variance * (along[i][j] - t * (sums[i] + sums[j]) + t * t * all);
            }
            left[i][i] += 1.0;
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
        libm::log(determinant)
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
/// The reflectance does not change if all shares grow alike, so the equations are singular along
/// the shares. The weight removes this, and a step by the inverse keeps the sum of the shares.
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

/// Inverse of a positive definite matrix by Gauss-Jordan elimination, or `None` if a pivot is not
/// positive.
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

/// A set does not matter if its score is above the best by more than this, because its weight is
/// then below 2e-3.
pub(crate) const NEGLIGIBLE: f32 = 20.0;
/// A pigment is present from this share on. Below it, the errors of the library look like traces
/// of pigments.
pub(crate) const TRACE: f64 = 0.01;
/// A median chi-square below this counts as this.
const LEAST_MEDIAN: f64 = 0.05;
/// How sets are scored: -2 ln of their probabilities, less a constant.
#[derive(Debug, Clone)]
pub(crate) struct Scores {
    /// Additions to the score of a set by its number of pigments, one to four. After a survey, all
    /// are 0.
    of_count: [f32; 4],
    /// Additions to the score by pigment, from the survey. Before it, all are 0.
    of_pigment: Vec<f32>,
    evidence: Evidence,
    /// Factor on the misfit: how much smaller the errors of the scan are than we expect.
    counted: f64,
}

impl Scores {
    /// Scores before a survey, for sets of `pigments`. Each pigment must lower chi-square by
    /// `penalty`.
    pub(crate) fn new(pigments: usize, penalty: f64, evidence: Evidence) -> Self {
        Self {
            of_count: Self::of_count(pigments as f64, penalty),
            of_pigment: vec![0.0; pigments],
            evidence,
            counted: 1.0,
        }
    }

    /// -2 ln of the probability of a refined set, less a constant. This adds its misfit, the price
    /// of exact shares, and the prior. Before a survey, the prior makes sets of any number of
    /// pigments equally likely, and all sets of one number too. A survey tells how often the scan
    /// holds each pigment.
    ///
    /// We do not count how often a survey found a set: pixels of one paint share the errors of the
    /// library, so they are not independent evidence. When we used this as a prior, probabilities
    /// between 0.5 and 0.9 came out too high by 0.2.
    pub(crate) fn of_set(&self, set: &SetFit, difference: &Difference) -> f32 {
        let exactness = difference.exactness(set.len(), self.excess(set.chi2)) as f32;
        self.misfit(set.chi2) + exactness + self.prior(set)
    }

    /// Additions to the score of a set that do not depend on the pixel.
    pub(crate) fn prior(&self, set: &SetFit) -> f32 {
        self.of_count[set.len() - 1] + self.of_pigments(set)
    }

    /// Additions to the score by the pigments of a set.
    pub(crate) fn of_pigments(&self, set: &SetFit) -> f32 {
        set.parts().map(|(member, _)| self.of_pigment[member]).sum()
    }

    /// Weight of a set with a score `above` the best one.
    pub(crate) fn weight(&self, above: f32) -> f64 {
        libm::exp(-0.5 / self.evidence.temperature * f64::from(above))
    }

    /// Weight of the shares of a set with a score `above` the best one. Shares follow the likelier
    /// sets more closely than probabilities do.
    pub(crate) fn weight_of_shares(above: f32) -> f64 {
        libm::exp(-0.5 * f64::from(above))
    }

    /// The scores for a scan that holds each pigment with the probability `palette`, 0 to 1, and has
    /// the median chi-square `median` per degree of freedom. A pigment adds -2 ln of its odds.
    pub(crate) fn with_survey(&self, palette: &[f32], median: f64) -> Self {
        Self {
            of_count: [0.0; 4],
            of_pigment: palette.iter().map(|inside| of_odds(f64::from(*inside))).collect(),
            counted: libm::pow(median.max(LEAST_MEDIAN), -self.evidence.of_scan),
            ..self.clone()
        }
    }

    /// Additions to the score by number of pigments. Sets hold up to four of `pigments`, and each
    /// must lower chi-square by `penalty`.
    fn of_count(pigments: f64, penalty: f64) -> [f32; 4] {
        let mut sets = 1.0;
        std::array::from_fn(|size| {
            sets *= (pigments - size as f64).max(1.0) / (size + 1) as f64;
            (2.0 * libm::log(sets) + penalty * (size + 1) as f64) as f32
        })
    }

    /// -2 ln of the likelihood of a chi-square, less a constant.
    pub(crate) fn misfit(&self, chi2: f32) -> f32 {
        let scale = self.counted * (self.evidence.tail + self.evidence.bands);
        (scale * libm::log1p(f64::from(chi2.max(0.0)) / self.evidence.tail)) as f32
    }

    /// Greatest slope of the score over chi-square.
    pub(crate) fn steepest(&self) -> f32 {
        let Evidence { tail, bands, .. } = self.evidence;
        (self.counted * (tail + bands) / tail) as f32
    }

    /// Ratio of the variance of a pixel's errors to the usual variance.
    pub(crate) fn excess(&self, chi2: f32) -> f64 {
        let Evidence { tail, bands, .. } = self.evidence;
        (tail + f64::from(chi2)) / (tail + bands) / self.counted
    }
}

/// -2 ln of the odds of a probability, which must be above 0 and below 1.
pub(crate) fn of_odds(probability: f64) -> f32 {
    (-2.0 * libm::log(probability / (1.0 - probability))) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scores() -> Scores {
        let evidence = Evidence { tail: 5.0, bands: 15.0, temperature: 2.0, of_scan: 0.5 };
        Scores::new(18, 2.0, evidence)
    }

    #[test]
    fn a_pigment_costs_what_a_survey_tells_of_it() {
        let scores = scores();
        // Of eighteen there are 18, 153, 816 and 3060 sets.
        for ((found, sets), size) in
            scores.of_count.iter().zip([18.0, 153.0, 816.0, 3060.0_f32]).zip(1..)
        {
            let expected = 2.0 * sets.ln() + 2.0 * size as f32;
            assert!((found - expected).abs() < 1e-3, "{:?}", scores.of_count);
        }
        let mut palette = vec![0.02; 18];
        (palette[0], palette[1]) = (0.5, 0.9);
        let informed = scores.with_survey(&palette, 1.0);
        let set = SetFit::of_parts(&[(0, 0.5), (1, 0.2), (2, 0.3)]).unwrap();
        let expected = -2.0 * (9.0 * 0.02 / 0.98_f32).ln();
        assert!((informed.prior(&set) - expected).abs() < 1e-4, "{}", informed.prior(&set));
    }

    #[test]
    fn exact_shares_cost_the_same_in_any_order_of_the_pigments() {
        let normal = [[9.0, 2.0, 1.0, 0.0], [2.0, 5.0, -1.0, 0.0], [1.0, -1.0, 7.0, 0.0], [0.0; 4]];
        let price = |order: [usize; 3], count| {
            let mut turned = [[0.0; MOST_IN_SET]; MOST_IN_SET];
            for (row, &from) in turned.iter_mut().zip(&order) {
                for (entry, &of) in row.iter_mut().zip(&order) {
                    *entry = normal[from][of];
                }
            }
            Difference { normal: turned, ..Difference::default() }.exactness(count, 2.0)
        };
        // Shares of two pigments are equally likely from 0 to 1, with a variance of a twelfth.
        let along = 9.0 + 5.0 - 2.0 * 2.0;
        let expected = (1.0 + along / 12.0 / 2.0_f64).ln();
        assert!((price([0, 1, 2], 2) - expected).abs() < 1e-9, "{}", price([0, 1, 2], 2));
        assert_eq!(price([0, 1, 2], 1), 0.0);
        let first = price([0, 1, 2], 3);
        for order in [[0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
            assert!((price(order, 3) - first).abs() < 1e-9, "{order:?}: {first}");
        }
    }

    #[test]
    fn a_scan_with_small_errors_counts_more() {
        let scores = scores();
        let usual = scores.with_survey(&[0.5; 18], 1.0);
        let exact = scores.with_survey(&[0.5; 18], 0.25);
        assert!((exact.misfit(3.0) / usual.misfit(3.0) - 2.0).abs() < 1e-5);
        assert!((exact.excess(3.0) / usual.excess(3.0) - 0.5).abs() < 1e-12);
        assert!((usual.misfit(3.0) - 20.0 * 1.6_f32.ln()).abs() < 1e-4);
    }
}
