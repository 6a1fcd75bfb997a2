//! Scores of sets of pigments: how well they explain a pixel, and how likely they are beforehand.

use super::set_fit::SetFit;
use crate::films::film::Difference;

/// Scores above the best beyond which a set does not matter: its weight is below 2e-3.
pub(crate) const NEGLIGIBLE: f32 = 20.0;
/// Factor by which differences of scores count less than those of exact likelihoods: the errors of a library are
/// known roughly, so that probabilities would promise too much. Chosen of 1 to 3 on simulated paintings.
const TEMPERATURE: f64 = 1.5;
/// Probability of a pigment that a survey needs nowhere.
const LEAST_LIKELY: f32 = 0.05;
/// Least addition to the score by a further pigment of a palette: -2 ln of one half.
const FURTHER: f32 = 2.0 * std::f32::consts::LN_2;

/// How sets are scored: -2 ln of their probabilities, less a constant.
#[derive(Debug, Clone)]
pub(crate) struct Scores {
    /// Bands of a pixel.
    bands: usize,
    /// Additions to the score by number of pigments.
    of_count: [f32; 4],
    /// Additions to the score by pigment: none, or what a survey knows of the palette.
    of_pigment: Vec<f32>,
    /// Chi-square that a pigment must save of which no survey says that it is in the palette.
    penalty: f64,
    /// Degrees of freedom of the residuals' distribution; infinite for a normal one.
    tail: f64,
}

impl Scores {
    /// Scores of pixels of `bands` before a survey, for sets of `pigments` each of which must save the chi-square
    /// `penalty`. `tail` are the degrees of freedom of the residuals' distribution; infinite for a normal one.
    pub(crate) fn new((pigments, bands): (usize, usize), penalty: f64, tail: f64) -> Self {
        Self {
            bands,
            of_count: Self::of_count(pigments as f64, penalty),
            of_pigment: vec![0.0; pigments],
            penalty,
            tail,
        }
    }

    /// -2 ln of the probability of a refined set, less a constant: its misfit, the part of all shares that
    /// agree with the pixel, and the prior: a set of any number of pigments is as likely as one of another, and
    /// so is any set of one number, but for what a survey tells of the palette. How often it found a set is no
    /// part of it: pixels of one paint share the errors of the library, so that they are no independent
    /// evidence. As a prior they made probabilities between 0.5 and 0.9 too high by 0.2.
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

    /// Weight of a set whose score is `above` that of the best one.
    pub(crate) fn weight(above: f32) -> f64 {
        (-0.5 / TEMPERATURE * f64::from(above)).exp()
    }

    /// The scores of a scan whose palette holds each pigment with these probabilities. Pigments outside it pay
    /// for that and the penalty, and those inside it no penalty: it guards against pigments that are not there.
    pub(crate) fn with_palette(&self, palette: &[f32]) -> Self {
        let size: f64 = palette.iter().map(|p| f64::from(*p)).sum();
        Self {
            of_count: Self::never_likelier(Self::of_count(size, 0.0)),
            of_pigment: palette
                .iter()
                .map(|&inside: &f32| {
                    let likely = LEAST_LIKELY + (1.0 - LEAST_LIKELY) * inside;
                    self.penalty as f32 * (1.0 - inside) - 2.0 * likely.ln()
                })
                .collect(),
            ..self.clone()
        }
    }

    /// Additions to the score by number of pigments, for `pigments` of which up to four are mixed, and each
    /// of which must save `penalty`.
    fn of_count(pigments: f64, penalty: f64) -> [f32; 4] {
        let mut sets = 1.0;
        std::array::from_fn(|size| {
            sets *= (pigments - size as f64).max(1.0) / (size + 1) as f64;
            (2.0 * sets.ln() + penalty * (size + 1) as f64) as f32
        })
    }

    /// The additions `of_count` raised so that each further pigment makes a set half as likely at most. A palette of
    /// three has three pairs and one triple, which would cost less than a pair.
    fn never_likelier(mut of_count: [f32; 4]) -> [f32; 4] {
        let before = of_count;
        for size in 1..of_count.len() {
            let more = before[size] - before[size - 1];
            of_count[size] = of_count[size - 1] + more.max(FURTHER);
        }
        of_count
    }

    /// -2 ln of the likelihood of a chi-square, less a constant.
    pub(crate) fn misfit(&self, chi2: f32) -> f32 {
        if self.tail.is_infinite() {
            return chi2;
        }
        let scale = self.tail + self.bands as f64;
        (scale * (f64::from(chi2.max(0.0)) / self.tail).ln_1p()) as f32
    }

    /// Greatest change of the score by chi-square.
    pub(crate) fn steepest(&self) -> f32 {
        if self.tail.is_infinite() {
            return 1.0;
        }
        ((self.tail + self.bands as f64) / self.tail) as f32
    }

    /// Factor by which the variance of a pixel's errors exceeds the usual one.
    pub(crate) fn excess(&self, chi2: f32) -> f64 {
        if self.tail.is_infinite() {
            return 1.0;
        }
        (self.tail + f64::from(chi2)) / (self.tail + self.bands as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pigment_costs_what_a_survey_tells_of_it() {
        let scores = Scores::new((18, 31), 2.0, f64::INFINITY);
        assert_eq!(scores.of_pigment, [0.0; 18], "before a survey");
        let mut palette = vec![0.0; 18];
        (palette[0], palette[1]) = (1.0, 0.5);
        let found = scores.with_palette(&palette).of_pigment;
        // -2 ln of the probability, which is 5 % at least, and the penalty as far as it is not in the palette.
        for (place, expected) in
            [0.0, 1.0 - 2.0 * 0.525_f32.ln(), 2.0 - 2.0 * 0.05_f32.ln()].into_iter().enumerate()
        {
            assert!((found[place] - expected).abs() < 1e-5, "{place}: {found:?}");
        }
    }

    #[test]
    fn a_further_pigment_of_a_palette_costs_something() {
        let scores = Scores::new((18, 31), 2.0, f64::INFINITY);
        // Three whole pigments of the palette, the others hardly in it.
        let mut palette = vec![0.0; 18];
        palette[..3].fill(1.0);
        let few = scores.with_palette(&palette).of_count;
        for (size, pair) in few.windows(2).enumerate() {
            assert!((pair[1] - pair[0] - FURTHER).abs() < 1e-5, "{size}: {few:?}");
        }
        // Of eighteen there are 18, 153, 816 and 3060 sets.
        palette.fill(1.0);
        let many = scores.with_palette(&palette).of_count;
        for (found, sets) in many.iter().zip([18.0, 153.0, 816.0, 3060.0_f32]) {
            assert!((found - 2.0 * sets.ln()).abs() < 1e-3, "{many:?}");
        }
    }
}
