//! Samples of several files as one set.

use documents::hint::{Explain, Fault, Hint};

use super::passage::SampleSet;

/// Why sets cannot be joined.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum JoinError {
    /// Some sets have paint, others have colours only.
    #[error("`{with}` has paint of pigments, `{without}` has colours only")]
    PaintAndColor {
        /// Provenance of a set with paint.
        with: String,
        /// Provenance of a set without.
        without: String,
    },
    /// The sets are painted with different pigments, or with the same in another order.
    #[error("`{first}` and `{other}` are painted with different pigments")]
    Pigments {
        /// Provenance of the first set.
        first: String,
        /// Provenance of the other set.
        other: String,
    },
}

impl Explain for JoinError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::PaintAndColor { .. } => "take all samples from paintings, or none",
            Self::Pigments { .. } => "paint all samples with one library and one hue",
        }))
    }

    fn fault(&self) -> Fault {
        Fault::Input
    }
}

impl SampleSet {
    /// All samples of `sets` in one set, from dark to light. A name that is taken gets a number.
    ///
    /// # Errors
    /// [`JoinError`] if the sets do not have the same pigments.
    pub fn joined(sets: Vec<Self>) -> Result<Self, JoinError> {
        let mut sets = sets.into_iter();
        let Some(mut joined) = sets.next() else {
            return Ok(Self { samples: Vec::new(), paint: None, provenance: String::new() });
        };
        let first = joined.provenance.clone();
        for set in sets {
            match (&joined.paint, &set.paint) {
                (None, None) => {}
                (Some(a), Some(b)) if a == b => {}
                (Some(_), Some(_)) => {
                    return Err(JoinError::Pigments { first, other: set.provenance });
                }
                (Some(_), None) => {
                    return Err(JoinError::PaintAndColor { with: first, without: set.provenance });
                }
                (None, Some(_)) => {
                    return Err(JoinError::PaintAndColor { with: set.provenance, without: first });
                }
            }
            for mut sample in set.samples {
                let taken = |name: &str| joined.samples.iter().any(|other| other.name == name);
                let plain = sample.name.clone();
                let mut number = 2;
                while taken(&sample.name) {
                    sample.name = format!("{plain} ({number})");
                    number += 1;
                }
                joined.samples.push(sample);
            }
            joined.provenance = format!("{}; {}", joined.provenance, set.provenance);
        }
        joined.samples.sort_by(|a, b| a.mean_lightness().total_cmp(&b.mean_lightness()));
        Ok(joined)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use paint::layer::Slots;
    use pigment::{PigmentId, PigmentLibrary};

    use super::*;
    use crate::sample::{PaintOfSamples, strokes};

    fn set(tones: &[f32], provenance: &str) -> SampleSet {
        let samples = tones
            .iter()
            .map(|tone: &f32| strokes(&format!("tone {tone}"), 24, 8, *tone, 1))
            .collect();
        SampleSet { samples, paint: None, provenance: provenance.to_owned() }
    }

    fn painted(set: SampleSet, pigment: usize) -> SampleSet {
        let mut slots = Slots::default();
        slots[0] = Some(PigmentId(pigment));
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        SampleSet { paint: Some(PaintOfSamples { library, slots }), ..set }
    }

    #[test]
    fn samples_of_all_sets_go_from_dark_to_light_under_their_own_names() {
        let joined = SampleSet::joined(vec![set(&[0.5, 0.1], "a"), set(&[0.2, 0.1], "b")]).unwrap();
        let names: Vec<&str> = joined.samples.iter().map(|sample| sample.name.as_str()).collect();
        assert_eq!(names, ["tone 0.1", "tone 0.1 (2)", "tone 0.2", "tone 0.5"]);
        assert_eq!(joined.provenance, "a; b");
        assert!(SampleSet::joined(Vec::new()).unwrap().samples.is_empty());
    }

    #[test]
    fn sets_of_other_pigments_are_refused() {
        let refused = |sets| SampleSet::joined(sets).unwrap_err().to_string();
        let [a, b] = [|| painted(set(&[0.1], "a"), 0), || painted(set(&[0.2], "b"), 1)];
        assert!(refused(vec![a(), b()]).contains("`a` and `b`"));
        assert!(refused(vec![a(), set(&[0.2], "c")]).contains("`c` has colours only"));
        assert!(refused(vec![set(&[0.2], "c"), a()]).contains("`c` has colours only"));
        assert!(SampleSet::joined(vec![a(), a()]).is_ok());
    }
}
