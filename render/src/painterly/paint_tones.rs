//! The paint of a map laid out for painting: a slice for each tone, at several sizes.

use artmap::map::{ArtMap, Between};
use artmap::sample::{PaintOfSamples, TexelPaint};
use graphics::field::Field;
use paint::layer::SLOTS;
use rayon::prelude::*;

use super::tones::{LEAST_SIZE, tone_tiles};

/// Pigments by slot, then vehicle, in mm.
pub type Amounts = [f32; SLOTS + 1];

/// Paint of all tones of a map, in the order and sizes of `Tones`.
#[derive(Debug, Clone)]
pub(super) struct PaintTones {
    pub(super) of: PaintOfSamples,
    /// Each slice with its sizes, the largest first.
    slices: Vec<Vec<Field<Amounts>>>,
}

impl PaintTones {
    /// Lays out the paint of a map; `None` for maps without.
    pub(super) fn new(map: &ArtMap, between: Between) -> Option<Self> {
        let of = map.paint.clone()?;
        let tiles = tone_tiles(map, between);
        let slices = tiles.into_par_iter().map(|tile| Some(sizes(&tile.paint?)));
        Some(Self { of, slices: slices.collect::<Option<_>>()? })
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

/// The sizes of a tile, each texel the mean of four of the size before.
fn sizes(paint: &Field<TexelPaint>) -> Vec<Field<Amounts>> {
    let amounts = |texel: &TexelPaint| {
        std::array::from_fn(|at| texel.pigments_mm.get(at).copied().unwrap_or(texel.vehicle_mm))
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
