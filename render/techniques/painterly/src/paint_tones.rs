//! The paint of one or several maps in common slots, laid out for painting as a packed slice for
//! each tone, at several sizes. You can also make a layer of paint from amounts in mm here.

use artmap::map::{ArtMap, Between};
use artmap::sample::{PaintOfSamples, TexelPaint};
use documents::hint::Explain;
use graphics::field::Field;
use paint::amount::quanta_from_mm;
use paint::layer::{Layer, SLOTS};
use rayon::prelude::*;

use super::tones::{LEAST_SIZE, tone_tiles};

/// Pigments by slot, then vehicle, in mm.
pub type Amounts = [f32; SLOTS + 1];

/// Channels that are summed together.
const LANES: usize = 4;

/// Most groups of channels: eight pigments and vehicle.
const GROUPS: usize = (SLOTS + 1).div_ceil(LANES);

/// Sums of packed amounts, a group after the other.
pub(super) type PackedSums = [[f32; LANES]; GROUPS];

/// Paint of all tones of some maps, in the order and sizes of `Tones`. We store only the channels
/// that some texel has, in 65,535 steps, so that the mean of many texels is the mean of their
/// amounts.
#[derive(Debug, Clone)]
pub(super) struct PaintTones {
    pub(super) of: PaintOfSamples,
    /// Indices in [`Amounts`] of the channels in use, rising.
    channels: Vec<usize>,
    /// Number of groups of channels in a texel.
    groups: usize,
    /// Width of a step in mm, for each channel of [`Amounts`].
    step: Amounts,
    /// Each slice in several sizes, the largest first.
    slices: Vec<Vec<Packed>>,
}

/// The paint of one tone at one size.
#[derive(Debug, Clone)]
struct Packed {
    size: usize,
    /// The groups of each texel, one texel after the other. The last group is filled with zeros.
    texels: Vec<[u16; LANES]>,
}

impl PaintTones {
    /// Lays out the paint of maps, `None` if one of them has none.
    ///
    /// # Errors
    /// [`PaintOfMapsError`] for maps with pigments of several libraries, or with more than eight.
    pub(super) fn new(
        maps: &[&ArtMap],
        between: Between,
    ) -> Result<Option<Self>, PaintOfMapsError> {
        let paints: Option<Vec<&PaintOfSamples>> =
            maps.iter().map(|map| map.paint.as_ref()).collect();
        let Some(paints) = paints else { return Ok(None) };
        let (of, moves) = joined(&paints)?;
        let mut most: Amounts = [0.0; SLOTS + 1];
        for (map, moves) in maps.iter().zip(&moves) {
            let paints = map.keys.iter().filter_map(|key| key.tile.paint.as_ref());
            for texel in paints.flat_map(|paint| paint.values()) {
                let all = most.iter_mut().zip(amounts(texel, moves));
                all.for_each(|(most, mm)| *most = most.max(mm));
            }
        }
        let channels: Vec<usize> = (0..=SLOTS).filter(|&at| most[at] > 0.0).collect();
        let groups = channels.len().div_ceil(LANES);
        let step = most.map(|most| most / f32::from(u16::MAX));
        let mut laid = Self { of, channels, groups, step, slices: Vec::new() };
        for (map, moves) in maps.iter().zip(&moves) {
            let tiles = tone_tiles(map, between).into_par_iter();
            let slices = tiles.map(|tile| Some(laid.sizes(&tile.paint?, moves)));
            let Some(slices) = slices.collect::<Option<Vec<_>>>() else { return Ok(None) };
            laid.slices.extend(slices);
        }
        Ok(Some(laid))
    }

    /// Adds to packed sums, times a weight, the paint between four texels of a slice at a size. You
    /// give the texel to the upper left by `place`, and the shares of its neighbours to the right
    /// and below in 256ths.
    #[inline(always)]
    pub(super) fn add(
        &self,
        sums: &mut PackedSums,
        (slice, halvings): (usize, usize),
        [u, v]: [usize; 2],
        share: [u32; 2],
        weight: f32,
    ) {
        let Packed { size, texels } = &self.slices[slice][halvings];
        let [across, down] = share.map(|share| share as f32 / 256.0);
        let right = if u + 1 == *size { 0 } else { u + 1 };
        let below = if v + 1 == *size { 0 } else { v + 1 };
        let [above, under] = [weight * (1.0 - down), weight * down];
        let corners = [
            (v * size + u, above * (1.0 - across)),
            (v * size + right, above * across),
            (below * size + u, under * (1.0 - across)),
            (below * size + right, under * across),
        ];
        for (at, weight) in corners {
            let texel = &texels[at * self.groups..][..self.groups];
            for (sums, group) in sums.iter_mut().zip(texel) {
                for lane in 0..LANES {
                    sums[lane] += f32::from(group[lane]) * weight;
                }
            }
        }
    }

    /// Amounts of packed sums that are divided by `weight`.
    #[inline(always)]
    pub(super) fn amounts(&self, sums: &PackedSums, weight: f32) -> Amounts {
        let mut amounts = [0.0; SLOTS + 1];
        for (at, &channel) in self.channels.iter().enumerate() {
            amounts[channel] = self.step[channel] * (sums[at / LANES][at % LANES] / weight);
        }
        amounts
    }

    /// The sizes of a tile, each texel the mean of four of the size before.
    fn sizes(&self, paint: &Field<TexelPaint>, moves: &[usize; SLOTS]) -> Vec<Packed> {
        let first = paint.values().iter().map(|texel| amounts(texel, moves)).collect();
        let mut last = Field::from_values(paint.width(), paint.height(), first);
        let mut laid = vec![self.packed(&last)];
        while last.width().is_multiple_of(2) && last.width() >= 2 * LEAST_SIZE {
            last = halved(&last);
            laid.push(self.packed(&last));
        }
        laid
    }

    fn packed(&self, paint: &Field<Amounts>) -> Packed {
        let mut texels = vec![[0; LANES]; self.groups * paint.values().len()];
        if self.groups > 0 {
            for (texel, amounts) in texels.chunks_exact_mut(self.groups).zip(paint.values()) {
                for (at, &channel) in self.channels.iter().enumerate() {
                    let steps = amounts[channel] / self.step[channel];
                    texel[at / LANES][at % LANES] = (steps + 0.5) as u16;
                }
            }
        }
        Packed { size: paint.width(), texels }
    }
}

/// The amounts of a texel in common slots.
fn amounts(texel: &TexelPaint, moves: &[usize; SLOTS]) -> Amounts {
    let mut amounts = [0.0; SLOTS + 1];
    for (slot, mm) in moves.iter().zip(texel.pigments_mm) {
        amounts[*slot] += mm;
    }
    amounts[SLOTS] = texel.vehicle_mm;
    amounts
}

fn halved(paint: &Field<Amounts>) -> Field<Amounts> {
    let half = paint.width() / 2;
    Field::from_values(
        half,
        half,
        (0..half * half)
            .map(|index: usize| -> Amounts {
                let x = 2 * (index % half);
                let y = 2 * (index / half);
                let four = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
                std::array::from_fn(|at| {
                    four.iter().map(|&place| paint[place][at]).sum::<f32>() / 4.0
                })
            })
            .collect(),
    )
}

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
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error, Explain)]
pub enum PaintOfMapsError {
    /// The pigments come from several libraries.
    #[error("the maps have pigments of different libraries")]
    #[hint("make all maps of samples with the same pigment library")]
    Libraries,
    /// There are too many pigments.
    #[error("the maps have more than {SLOTS} pigments together")]
    #[hint("make all maps of samples with the same pigments")]
    Pigments,
}

/// Least number of cells that a thread computes.
const CELLS: usize = 4096;

/// The layer with the amounts of each cell, rounded to whole quanta. Cells are `cell_mm` wide.
#[must_use]
pub fn paint_layer(amounts: &Field<Amounts>, cell_mm: f64) -> Layer {
    let width = amounts.width();
    let height = amounts.height();
    let mut layer = Layer::empty(width, height);
    let cells = layer.pigments.values_mut().par_iter_mut().zip(layer.vehicle.values_mut());
    let laid = cells.zip(amounts.values()).with_min_len(CELLS);
    laid.for_each(|((pigments, vehicle), amounts)| {
        // Most slots of most cells are empty.
        fn quanta(mm: f32, cell_mm: f64) -> u32 {
            if mm > 0.0 { quanta_from_mm(f64::from(mm), cell_mm) } else { 0 }
        }
        *pigments = std::array::from_fn(|slot| quanta(amounts[slot], cell_mm));
        *vehicle = quanta(amounts[SLOTS], cell_mm);
    });
    layer
}

#[cfg(test)]
mod tests {
    use super::super::test_scenes::{SIZE, map};
    use super::*;
    use paint::amount::mm_from_quanta;
    use paint::layer::{Cell, Slots};
    use pigment::{PigmentId, PigmentLibrary};
    use std::sync::Arc;

    /// The common slots if there is one map only: its own slots.
    const SAME: [usize; SLOTS] = [0, 1, 2, 3, 4, 5, 6, 7];

    /// Pigments of every second slot, some of them rare, and vehicle.
    fn painted_map() -> ArtMap {
        let mut map = map(2);
        for key in &mut map.keys {
            let heights = key.tile.height_mm.as_ref().unwrap();
            let texels = heights
                .values()
                .iter()
                .enumerate()
                .map(|(index, mm): (usize, &f32)| {
                    let mut pigments_mm = [0.0; SLOTS];
                    for slot in (1..SLOTS).step_by(2) {
                        pigments_mm[slot] = mm * (1.0 + ((index * slot) % 97) as f32);
                    }
                    TexelPaint { pigments_mm, vehicle_mm: 0.01 + mm / 3.0 }
                })
                .collect();
            key.tile.paint = Some(Field::from_values(SIZE, SIZE, texels));
        }
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        map.paint = Some(PaintOfSamples { library, slots: Slots::default() });
        map
    }

    #[test]
    fn totals_of_all_sizes_are_those_of_the_tile() {
        let map = painted_map();
        let tones = PaintTones::new(&[&map], Between::Dissolve).unwrap().unwrap();
        assert_eq!(tones.channels, [1, 3, 5, 7, 8]);
        let paint = map.keys[0].tile.paint.as_ref().unwrap();
        for halvings in 0..tones.slices[0].len() {
            let size = SIZE >> halvings;
            let mut sums = [0.0_f64; SLOTS + 1];
            for at in 0..size * size {
                let mut packed = PackedSums::default();
                tones.add(&mut packed, (0, halvings), [at % size, at / size], [0, 0], 2.0);
                let found = tones.amounts(&packed, 2.0);
                sums.iter_mut().zip(found).for_each(|(sum, mm)| *sum += f64::from(mm));
            }
            for (channel, sum) in sums.iter().enumerate() {
                let all =
                    paint.values().iter().map(|texel| f64::from(amounts(texel, &SAME)[channel]));
                let wanted = all.sum::<f64>() / f64::from(1 << (2 * halvings));
                assert!((sum - wanted).abs() <= 1e-4 * wanted, "{channel}: {sum} {wanted}");
            }
        }
    }

    #[test]
    fn paint_between_texels_is_their_mean_and_repeats() {
        let map = painted_map();
        let tones = PaintTones::new(&[&map], Between::Dissolve).unwrap().unwrap();
        fn at(place: [usize; 2], share: [u32; 2], tones: &PaintTones) -> [f32; 9] {
            let mut sums = PackedSums::default();
            tones.add(&mut sums, (0, 0), place, share, 1.0);
            tones.amounts(&sums, 1.0)
        }
        let last = SIZE - 1;
        let corners =
            [[last, last], [0, last], [last, 0], [0, 0]].map(|place| at(place, [0, 0], &tones));
        let between = at([last, last], [64, 192], &tones);
        let paint = map.keys[0].tile.paint.as_ref().unwrap();
        for channel in [1, 3, 5, 7, 8] {
            let shares = [0.75 * 0.25, 0.25 * 0.25, 0.75 * 0.75, 0.25 * 0.75];
            let pairs = corners.iter().zip(shares);
            let wanted: f32 = pairs.map(|(corner, share)| share * corner[channel]).sum();
            assert!((between[channel] - wanted).abs() < 1e-5 * wanted.max(0.1));
            let texel = amounts(&paint[(0, 0)], &SAME)[channel];
            assert!((corners[3][channel] - texel).abs() <= 0.51 * tones.step[channel]);
        }
        assert!(between[0] == 0.0 && between[1] > 0.0);
    }

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

    #[test]
    fn cells_have_the_nearest_whole_quanta_of_their_amounts() {
        let amounts = Field::from_values(
            7,
            3,
            (0..21)
                .map(|at: usize| std::array::from_fn(|slot| 0.001 * (at * slot) as f32 - 0.002))
                .collect(),
        );
        let layer = paint_layer(&amounts, 0.2);
        for (index, amounts) in amounts.values().iter().enumerate() {
            let Cell { pigments, vehicle } = layer.cell(index);
            let all = pigments.into_iter().chain([vehicle]).zip(amounts);
            for (quanta, mm) in all {
                let found = mm_from_quanta(quanta, 0.2);
                let wanted = f64::from(mm.max(0.0));
                let half = 0.5001 * mm_from_quanta(1, 0.2);
                assert!((found - wanted).abs() <= half, "{found} {wanted}");
            }
        }
        assert!(layer.cell(20).vehicle > 0 && layer.cell(20).pigments[7] > 0);
    }
}
