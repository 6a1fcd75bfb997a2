//! Paint of a picture: the same weighted means as those of its colours, of amounts in mm.

use graphics::field::Field;
use paint::layer::SLOTS;
use pulp::Simd;
use rayon::prelude::*;

use super::divided::Divide;
use super::gather::{Gather, Gathered, LOST, Sums, shown};
use super::lists::{Lists, SIDE};
use super::paint_tones::{Amounts, PackedSums, PaintTones};
use super::settings::OverlapSettings;
use super::splat::StrokeSplat;
use super::square::Square;
use super::tones::Tones;

/// Sums of packed amounts at the pixels of a square, times weights.
type SquareSums = [[PackedSums; SIDE]; SIDE];

/// Paint at each pixel in mm, thinner where strokes cover a pixel in part. Splats, depth and overlap
/// are those of the picture.
pub(super) fn amounts(
    depth: &Field<f32>,
    splats: &[StrokeSplat],
    divide: &Divide<'_>,
    paint: &PaintTones,
    overlap: &OverlapSettings,
) -> Field<Amounts> {
    let width = depth.width();
    let height = depth.height();
    let lists = Lists::new(width, height, splats);
    let mut found = Field::filled(width, height, [0.0; SLOTS + 1]);
    let bands = found.values_mut().par_chunks_mut((SIDE * width).max(1)).enumerate();
    bands.for_each_init(
        || (Gathered::new(), [SquareSums::default(); 2]),
        |(gathered, sums), (band, amounts)| {
            for column in 0..lists.across {
                let list = lists.of(band * lists.across + column);
                if list.is_empty() {
                    continue;
                }
                let x = column * SIDE;
                let y = band * SIDE;
                let square = Square::new(depth, x, y);
                let tones = divide.tones;
                let furrow = 1.0 - overlap.ridges;
                let squarings = overlap.sharpness.max(1).ilog2();
                graphics::lanes::vectorized(Gather {
                    square: &square,
                    list,
                    splats,
                    tones,
                    squarings,
                    furrow,
                    colored: false,
                    textured: false,
                    into: &mut *gathered,
                });
                let surfaces = [&mut gathered.on, &mut gathered.before];
                for (surface, sums) in surfaces.into_iter().zip(&mut *sums) {
                    if surface.any() {
                        let square = &square;
                        let sum = Sum { square, splats, tones, furrow, paint, surface, sums };
                        graphics::lanes::vectorized(sum);
                    }
                }
                let columns = SIDE.min(width - x);
                for (row, amounts) in amounts.chunks_mut(width).enumerate() {
                    for column in 0..columns {
                        let covered = square.depths[row][column] < 1.0;
                        let at = (row, column);
                        let [over, rest] = divide.shares(gathered, covered, at);
                        let of = |share: f32, sums: &SquareSums, surface: &Sums| {
                            let weight = surface.weight[row][column];
                            (share > 0.0 && weight > LOST)
                                .then(|| paint.amounts(&sums[row][column], weight / share))
                        };
                        let before = of(over, &sums[1], &gathered.before);
                        let on = of(rest, &sums[0], &gathered.on);
                        let own = &mut amounts[x + column];
                        for part in [before, on].into_iter().flatten() {
                            own.iter_mut().zip(part).for_each(|(own, mm)| *own += mm);
                        }
                    }
                }
            }
        },
    );
    found
}

/// Sums what the strokes of one surface show in a square: paint, and the height that tells ridges
/// from furrows.
struct Sum<'a> {
    square: &'a Square,
    splats: &'a [StrokeSplat],
    tones: &'a Tones,
    furrow: f32,
    paint: &'a PaintTones,
    surface: &'a mut Sums,
    sums: &'a mut SquareSums,
}

impl pulp::WithSimd for Sum<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { square, splats, tones, furrow, paint, surface, sums } = self;
        *sums = SquareSums::default();
        let Sums { bytes, weight: weights, total, parts, .. } = surface;
        shown(square, splats, (tones, furrow), (parts, total), |part| {
            let size = (part.splat.slice as usize, part.splat.halvings as usize);
            let [row, column] = part.pixel;
            paint.add(&mut sums[row][column], size, part.place, part.share, part.weight);
            let all = bytes[row][column].iter_mut().zip(part.texel);
            all.for_each(|(sum, value)| *sum += value * part.weight);
            weights[row][column] += part.weight;
        });
    }
}
