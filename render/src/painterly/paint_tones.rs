//! The paint of a map laid out for painting: a slice for each tone, at several sizes.

use artmap::map::{ArtMap, Between};
use artmap::sample::{PaintOfSamples, TexelPaint};
use graphics::field::Field;
use paint::layer::SLOTS;
use rayon::prelude::*;
use spectra::hint::{Explain, Fault, Hint};

use super::tones::{LEAST_SIZE, tone_tiles};

/// Pigments by slot, then vehicle, in mm.
pub(super) type Amounts = [f32; SLOTS + 1];

/// Paint of all tones of some maps, in the order and sizes of `Tones`.
#[derive(Debug, Clone)]
pub(super) struct PaintTones {
    pub(super) of: PaintOfSamples,
    /// Each slice with its sizes, the largest first.
    slices: Vec<Vec<Field<Amounts>>>,
}

impl PaintTones {
    /// Lays out the paint of maps; `None` if one of them has none.
    ///
    /// # Errors
    /// [`PaintOfMapsError`] for maps whose pigments are not of one library, or more than eight.
    pub(super) fn new(
        maps: &[&ArtMap],
        between: Between,
    ) -> Result<Option<Self>, PaintOfMapsError> {
        let paints: Option<Vec<&PaintOfSamples>> =
            maps.iter().map(|map| map.paint.as_ref()).collect();
        let Some(paints) = paints else { return Ok(None) };
        let (of, moves) = joined(&paints)?;
        let mut slices = Vec::new();
        for (map, moves) in maps.iter().zip(moves) {
            let tiles = tone_tiles(map, between).into_par_iter();
            let laid: Option<Vec<_>> =
                tiles.map(|tile| Some(sizes(&tile.paint?, &moves))).collect();
            let Some(laid) = laid else { return Ok(None) };
            slices.extend(laid);
        }
        Ok(Some(Self { of, slices }))
    }

    /// Paint between four texels of a slice at a size: that to the upper left of `place`, with the
    /// shares of its neighbours to the right and below in 256ths.
    #[inline(always)]
    pub(super) fn between(
        &self,
        (slice, halvings): (usize, usize),
        [u, v]: [usize; 2],
        share: [u32; 2],
    ) -> Amounts {
        let texels = &self.slices[slice][halvings];
        let size = texels.width();
        let [across, down] = share.map(|share| share as f32 / 256.0);
        let (right, below) = ((u + 1) % size, (v + 1) % size);
        let weighed = [
            ((u, v), (1.0 - across) * (1.0 - down)),
            ((right, v), across * (1.0 - down)),
            ((u, below), (1.0 - across) * down),
            ((right, below), across * down),
        ];
        let mut sum = [0.0; SLOTS + 1];
        for (at, weight) in weighed {
            sum.iter_mut().zip(texels[at]).for_each(|(sum, mm)| *sum += weight * mm);
        }
        sum
    }
}

/// The pigments of all maps in common slots, and the common slot of each slot of each map.
fn joined(
    paints: &[&PaintOfSamples],
) -> Result<(PaintOfSamples, Vec<[usize; SLOTS]>), PaintOfMapsError> {
    let library = &paints[0].library;
    let mut slots = paints[0].slots;
    let mut moves = Vec::new();
    for paint in paints {
        if paint.library != *library {
            return Err(PaintOfMapsError::Libraries);
        }
        let mut of = [0; SLOTS];
        for (slot, pigment) in paint.slots.iter().enumerate() {
            let Some(pigment) = pigment else { continue };
            let found = slots.iter().position(|own| own.as_ref() == Some(pigment));
            let free = || slots.iter().position(Option::is_none);
            of[slot] = found.or_else(free).ok_or(PaintOfMapsError::Pigments)?;
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

/// The sizes of a tile, each texel the mean of four of the size before.
fn sizes(paint: &Field<TexelPaint>, moves: &[usize; SLOTS]) -> Vec<Field<Amounts>> {
    let amounts = |texel: &TexelPaint| {
        let mut amounts = [0.0; SLOTS + 1];
        for (slot, mm) in moves.iter().zip(texel.pigments_mm) {
            amounts[*slot] += mm;
        }
        amounts[SLOTS] = texel.vehicle_mm;
        amounts
    };
    let first = paint.values().iter().map(amounts).collect();
    let mut laid = vec![Field::from_values(paint.width(), paint.height(), first)];
    while let Some(last) = laid.last()
        && last.width().is_multiple_of(2)
        && last.width() >= 2 * LEAST_SIZE
    {
        let half = last.width() / 2;
        let mean = |index: usize| -> Amounts {
            let (x, y) = (2 * (index % half), 2 * (index / half));
            let four = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
            std::array::from_fn(|at| four.iter().map(|&place| last[place][at]).sum::<f32>() / 4.0)
        };
        let values = (0..half * half).map(mean).collect();
        laid.push(Field::from_values(half, half, values));
    }
    laid
}
