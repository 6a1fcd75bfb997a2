//! Paint of a picture: the same weighted means as those of its colours, of amounts in mm.

use graphics::field::Field;
use paint::layer::SLOTS;
use rayon::prelude::*;

use super::divided::Divide;
use super::gather::{Gather, Gathered, LOST, Sums, shown};
use super::lists::{Lists, SIDE};
use super::paint_tones::{Amounts, PaintTones};
use super::settings::OverlapSettings;
use super::splat::StrokeSplat;
use super::square::Square;

/// Sums of amounts at the pixels of a square.
type AmountSums = [[Amounts; SIDE]; SIDE];

/// Paint at each pixel in mm, thinner where strokes cover a pixel in part. Splats, depth and overlap
/// are those of the picture.
pub(super) fn amounts(
    depth: &Field<f32>,
    splats: &[StrokeSplat],
    divide: &Divide<'_>,
    paint: &PaintTones,
    overlap: &OverlapSettings,
) -> Field<Amounts> {
    let (width, height) = (depth.width(), depth.height());
    let lists = Lists::new(width, height, splats);
    let mut found = Field::filled(width, height, [0.0; SLOTS + 1]);
    let bands = found.values_mut().par_chunks_mut((SIDE * width).max(1)).enumerate();
    bands.for_each_init(Gathered::new, |gathered, (band, amounts)| {
        for column in 0..lists.across {
            let list = lists.of(band * lists.across + column);
            if list.is_empty() {
                continue;
            }
            let (x, y) = (column * SIDE, band * SIDE);
            let square = Square::new(depth, x, y);
            let (tones, furrow) = (divide.tones, 1.0 - overlap.ridges);
            let squarings = overlap.sharpness.max(1).ilog2();
            let (colored, into) = (false, &mut *gathered);
            let gather =
                Gather { square: &square, list, splats, tones, squarings, furrow, colored, into };
            pulp::Arch::new().dispatch(gather);
            let of = |sums: &Sums| {
                let mut found = [[[0.0; SLOTS + 1]; SIDE]; SIDE];
                shown(&square, splats, (tones, furrow), (&sums.parts, &sums.total), |part| {
                    let size = (part.splat.slice as usize, part.splat.halvings as usize);
                    let texel = paint.between(size, part.place, part.share);
                    let [row, column] = part.pixel;
                    let sums = found[row][column].iter_mut().zip(texel);
                    sums.for_each(|(sum, mm)| *sum += mm * part.weight);
                });
                found
            };
            let [on, before] = [of(&gathered.on), of(&gathered.before)];
            let columns = SIDE.min(width - x);
            for (row, amounts) in amounts.chunks_mut(width).enumerate() {
                for column in 0..columns {
                    let (covered, at) = (square.depths[row][column] < 1.0, (row, column));
                    let [over, rest] = divide.shares(gathered, covered, at);
                    let [on, before] =
                        [mean(&on, &gathered.on, at), mean(&before, &gathered.before, at)];
                    amounts[x + column] =
                        std::array::from_fn(|slot| before[slot] * over + on[slot] * rest);
                }
            }
        }
    });
    found
}

/// Sums of a surface at a pixel divided by their weight; zeros where it has no stroke.
fn mean(sums: &AmountSums, of: &Sums, (row, column): (usize, usize)) -> Amounts {
    let weight = of.weight[row][column];
    if weight <= LOST {
        return [0.0; SLOTS + 1];
    }
    sums[row][column].map(|sum| sum / weight)
}
