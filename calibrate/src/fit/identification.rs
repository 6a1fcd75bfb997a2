//! What mixtures can tell of each pigment, before anything is fitted.
//!
//! The equations K = Q S of the mixtures are homogeneous but for the reference
//! white. A pigment's S is known only through mixtures that tie it, directly
//! or through others, to that white.

/// What of a pigment the data cannot tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// Its S; its K/S is known from a masstone.
    Scattering,
    /// Both.
    Everything,
}

/// A pigment the data do not identify.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unidentified {
    /// Its index.
    pub pigment: usize,
    /// What is unknown.
    pub unknown: Unknown,
    /// The samples that hold it, by index.
    pub samples: Vec<usize>,
}

/// The pigments that `shares` (by sample, then pigment) do not identify, given
/// the `reference` whose S is 1.
///
/// A pigment counts as identified if it occurs in two or more samples of
/// different recipe, at least one of them a mixture with an identified
/// pigment.
#[must_use]
pub fn unidentified(shares: &[Vec<f64>], reference: usize) -> Vec<Unidentified> {
    let pigments = shares.first().map_or(0, Vec::len);
    let holding = |pigment: usize| -> Vec<usize> {
        (0..shares.len()).filter(|&s| shares[s][pigment] > 0.0).collect()
    };
    let partners = |sample: usize, pigment: usize| {
        (0..pigments).filter(move |&other| other != pigment && shares[sample][other] > 0.0)
    };
    let different = |samples: &[usize]| {
        samples.iter().any(|&s| {
            let pairs = shares[s].iter().zip(&shares[samples[0]]);
            pairs.map(|(a, b)| (a - b).abs()).sum::<f64>() > 1e-9
        })
    };
    let mut known = vec![false; pigments];
    known[reference] = true;
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
            Unidentified { pigment, unknown, samples }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_masstone_alone_tells_only_the_ratio() {
        let shares = vec![vec![1.0, 0.0], vec![0.0, 1.0]];
        let found = unidentified(&shares, 0);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].pigment, found[0].unknown), (1, Unknown::Scattering));
        assert_eq!(found[0].samples, vec![1]);
    }

    #[test]
    fn a_single_mixture_tells_nothing() {
        let found = unidentified(&[vec![1.0, 0.0], vec![0.5, 0.5]], 0);
        assert_eq!((found[0].pigment, found[0].unknown), (1, Unknown::Everything));
    }

    #[test]
    fn masstone_and_tint_identify_and_a_chain_reaches_the_white() {
        let shares = vec![
            vec![1.0, 0.0, 0.0],
            vec![0.0, 1.0, 0.0],
            vec![0.5, 0.5, 0.0],
            vec![0.0, 0.0, 1.0],
            vec![0.0, 0.5, 0.5],
        ];
        assert!(unidentified(&shares, 0).is_empty(), "pigment 2 hangs on 1, and 1 on the white");
    }

    #[test]
    fn two_pigments_mixed_only_with_each_other_do_not_reach_the_white() {
        let shares = vec![
            vec![1.0, 0.0, 0.0],
            vec![0.0, 1.0, 0.0],
            vec![0.0, 0.0, 1.0],
            vec![0.0, 0.5, 0.5],
        ];
        let found: Vec<usize> = unidentified(&shares, 0).iter().map(|u| u.pigment).collect();
        assert_eq!(found, vec![1, 2]);
    }
}
