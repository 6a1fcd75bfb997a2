//! Identification: which pigments the mixtures determine, before anything is fitted.
//!
//! The equations K = Q S of the mixtures are homogeneous except for the reference white. The S of a
//! pigment is known only through mixtures that connect it, directly or through others, to that white.

use pigment::PigmentId;

/// Quantity of a pigment that the data do not identify.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// Its S; its K/S is known from a masstone.
    Scattering,
    /// Both K and S.
    Everything,
}

/// A pigment that the data do not identify.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unidentified {
    /// Place of the pigment in the list of pigments.
    pub pigment: PigmentId,
    /// Quantity that is not identified.
    pub unknown: Unknown,
    /// Indices of the samples that contain the pigment.
    pub samples: Vec<usize>,
}

/// Two recipes whose shares differ by less than this, summed over pigments, are equal.
const SAME_RECIPE: f64 = 1e-9;

/// Finds the pigments that the mixtures do not identify, given the `reference` whose S is 1. `shares` are
/// the shares of all pigments, by sample.
///
/// A pigment is identified if it occurs in two or more samples of different recipe, at least one of them
/// a mixture with an identified pigment.
#[must_use]
pub fn unidentified<'a>(
    shares: impl IntoIterator<Item = &'a [f64]>,
    reference: PigmentId,
) -> Vec<Unidentified> {
    let collected: Vec<&[f64]> = shares.into_iter().collect();
    let shares = collected.as_slice();
    let pigments = shares.first().map_or(0, |shares| shares.len());
    let holding = |pigment: usize| -> Vec<usize> {
        (0..shares.len()).filter(|&s| shares[s][pigment] > 0.0).collect()
    };
    let partners = |sample: usize, pigment: usize| {
        (0..pigments).filter(move |&other| other != pigment && shares[sample][other] > 0.0)
    };
    let different = |samples: &[usize]| {
        samples.iter().any(|&s| {
            let pairs = shares[s].iter().zip(shares[samples[0]]);
            pairs.map(|(a, b)| (a - b).abs()).sum::<f64>() > SAME_RECIPE
        })
    };
    let mut known = vec![false; pigments];
    known[reference.index()] = true;
    loop {
        let found = (0..pigments).filter(|&p| !known[p]).find(|&pigment| {
            let samples = holding(pigment);
            !samples.is_empty()
                && different(&samples)
                && samples.iter().any(|&s| partners(s, pigment).any(|other| known[other]))
        });
        match found {
            Some(pigment) => known[pigment] = true,
            None => break,
        }
    }
    (0..pigments)
        .filter(|&pigment| !known[pigment])
        .map(|pigment| {
            let samples = holding(pigment);
            let masstone = samples.iter().any(|&s| partners(s, pigment).next().is_none());
            let unknown = if masstone { Unknown::Scattering } else { Unknown::Everything };
            Unidentified { pigment: PigmentId(pigment), unknown, samples }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(shares: &[Vec<f64>]) -> Vec<Unidentified> {
        unidentified(shares.iter().map(Vec::as_slice), PigmentId(0))
    }

    #[test]
    fn a_masstone_alone_identifies_only_the_ratio() {
        let shares = vec![vec![1.0, 0.0], vec![0.0, 1.0]];
        let found = found(&shares);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].pigment, found[0].unknown), (PigmentId(1), Unknown::Scattering));
        assert_eq!(found[0].samples, vec![1]);
    }

    #[test]
    fn a_single_mixture_identifies_nothing() {
        let found = found(&[vec![1.0, 0.0], vec![0.5, 0.5]]);
        assert_eq!((found[0].pigment, found[0].unknown), (PigmentId(1), Unknown::Everything));
    }

    #[test]
    fn masstone_and_tint_identify_a_pigment_through_a_chain_to_the_white() {
        let shares = vec![
            vec![1.0, 0.0, 0.0],
            vec![0.0, 1.0, 0.0],
            vec![0.5, 0.5, 0.0],
            vec![0.0, 0.0, 1.0],
            vec![0.0, 0.5, 0.5],
        ];
        assert!(found(&shares).is_empty(), "pigment 2 is mixed with 1, and 1 with the white");
    }

    #[test]
    fn two_pigments_mixed_only_with_each_other_do_not_reach_the_white() {
        let shares = vec![
            vec![1.0, 0.0, 0.0],
            vec![0.0, 1.0, 0.0],
            vec![0.0, 0.0, 1.0],
            vec![0.0, 0.5, 0.5],
        ];
        let found: Vec<usize> = found(&shares).iter().map(|u| u.pigment.index()).collect();
        assert_eq!(found, vec![1, 2]);
    }
}
