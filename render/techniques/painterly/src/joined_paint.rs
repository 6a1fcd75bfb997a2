//! The paint of several maps in common slots.

use artmap::sample::PaintOfSamples;
use documents::hint::{Explain, Fault, Hint};
use paint::layer::SLOTS;

/// The pigments of all maps in common slots, and the common slot of each slot of each map.
pub(super) fn joined(
    paints: &[&PaintOfSamples],
) -> Result<(PaintOfSamples, Vec<[usize; SLOTS]>), PaintOfMapsError> {
    let library = &paints[0].library;
    let mut slots = paints[0].slots;
    let mut moves = Vec::new();
    for paint in paints {
        if paint.library != *library {
            return Err(PaintOfMapsError::Libraries);
        }
        let mut of: [usize; SLOTS] = std::array::from_fn(|slot| slot);
        for (slot, pigment) in paint.slots.iter().enumerate() {
            let Some(pigment) = pigment else { continue };
            let found = slots.iter().position(|own| own.as_ref() == Some(pigment));
            of[slot] = found
                .or_else(|| slots.iter().position(Option::is_none))
                .ok_or(PaintOfMapsError::Pigments)?;
            slots[of[slot]] = Some(*pigment);
        }
        moves.push(of);
    }
    Ok((PaintOfSamples { library: library.clone(), slots }, moves))
}

/// Why maps cannot make one painting.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum PaintOfMapsError {
    /// Pigments are of several libraries.
    #[error("the maps have pigments of different libraries")]
    Libraries,
    /// There are too many pigments.
    #[error("the maps have more than {SLOTS} pigments together")]
    Pigments,
}

impl Explain for PaintOfMapsError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Libraries => "make all maps of samples with the same pigment library",
            Self::Pigments => "make all maps of samples with the same pigments",
        }))
    }

    fn fault(&self) -> Fault {
        Fault::Input
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use paint::layer::Slots;
    use pigment::{PigmentId, PigmentLibrary};

    use super::*;

    fn paint(pigments: &[usize]) -> PaintOfSamples {
        let mut slots = Slots::default();
        for (slot, pigment) in slots.iter_mut().zip(pigments) {
            *slot = Some(PigmentId(*pigment));
        }
        PaintOfSamples { library: Arc::new(PigmentLibrary::van_gogh_oils()), slots }
    }

    #[test]
    fn pigments_of_several_maps_share_slots() {
        let maps = [paint(&[4, 2]), paint(&[2, 7, 4])];
        let (of, moves) = joined(&[&maps[0], &maps[1]]).unwrap();
        assert_eq!(of.slots, paint(&[4, 2, 7]).slots);
        assert_eq!((&moves[0][..2], &moves[1][..3]), (&[0, 1][..], &[1, 2, 0][..]));
    }

    #[test]
    fn more_than_eight_pigments_and_other_libraries_are_refused() {
        let many = paint(&[0, 1, 2, 3, 4]);
        let more = paint(&[5, 6, 7, 8]);
        assert_eq!(joined(&[&many, &more]).unwrap_err(), PaintOfMapsError::Pigments);
        let mut other = PigmentLibrary::van_gogh_oils();
        other.title = "another".into();
        let other = PaintOfSamples { library: Arc::new(other), ..paint(&[0]) };
        let error = joined(&[&many, &other]).unwrap_err();
        assert!(error == PaintOfMapsError::Libraries && error.hint().is_some());
    }
}
