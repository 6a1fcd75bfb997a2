//! Errors of predicted films against measured ones.

use spectra::TristimulusWeights;

use pigment::digits::rounded;
use pigment::evaluate::{Summary, delta_e};
use pigment::library::SampleEvidence;

/// Errors of a set of films.
pub(crate) struct Scores {
    /// Root mean square error of reflectance.
    pub(crate) rms: f64,
    pub(crate) delta_e: Summary,
    pub(crate) per_sample: Vec<SampleEvidence>,
}

impl Scores {
    /// Errors of films, each given as name of the sample, measured and predicted reflectance.
    pub(crate) fn of<'a>(
        weights: &TristimulusWeights,
        films: impl IntoIterator<Item = (String, &'a [f64], Vec<f64>)>,
    ) -> Self {
        let mut squares = 0.0;
        let mut count = 0.0;
        let mut per_sample = Vec::new();
        for (sample, measured, predicted) in films {
            squares += predicted.iter().zip(measured).map(|(p, m)| (p - m).powi(2)).sum::<f64>();
            count += measured.len() as f64;
            let delta_e = delta_e(weights, measured, &predicted);
            per_sample.push(SampleEvidence { sample, delta_e });
        }
        let rms = f64::sqrt(squares / f64::max(count, 1.0));
        Self { rms, delta_e: summary(&per_sample), per_sample }
    }

    /// Copy rounded to six significant digits, for a file.
    pub(crate) fn rounded(mut self) -> Self {
        self.per_sample.iter_mut().for_each(|s| s.delta_e = rounded(s.delta_e));
        Self {
            rms: rounded(self.rms),
            delta_e: summary(&self.per_sample).rounded(),
            per_sample: self.per_sample,
        }
    }
}

fn summary(per_sample: &[SampleEvidence]) -> Summary {
    let errors: Vec<f64> = per_sample.iter().map(|s| s.delta_e).collect();
    Summary::of(&errors)
}

/// Share of each sample in the sum of all squared colour errors, 0 to 1, the greatest first; samples of
/// equal shares in their order. Empty if all errors are 0.
#[must_use]
pub fn shares_of_squares(per_sample: &[SampleEvidence]) -> Vec<(&str, f64)> {
    let total: f64 = per_sample.iter().map(|s| s.delta_e * s.delta_e).sum();
    if total <= 0.0 {
        return Vec::new();
    }
    let share = |s: &'_ SampleEvidence| s.delta_e * s.delta_e / total;
    let mut shares: Vec<(&str, f64)> =
        per_sample.iter().map(|s| (s.sample.as_str(), share(s))).collect();
    shares.sort_by(|a, b| b.1.total_cmp(&a.1));
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_squares_sum_to_one_and_fall() {
        let samples = [("a", 1.0), ("b", 3.0), ("c", 0.0)]
            .map(|(name, delta_e)| SampleEvidence { sample: name.to_owned(), delta_e });
        let shares = shares_of_squares(&samples);
        assert_eq!(shares, [("b", 0.9), ("a", 0.1), ("c", 0.0)]);
        assert!(shares_of_squares(&samples[2..]).is_empty());
    }
}
