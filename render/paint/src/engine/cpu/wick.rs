//! Flow of paint along the hair of a head, column by column.

use super::head_paint::HeadPaint;
use crate::layer::{Cell, SLOTS};
use crate::motion::wick::{UNIT_BITS, dealt, flowing, given_share, lack, mean};

const EMPTY: Cell = Cell { pigments: [0; SLOTS], vehicle: 0 };

/// Sums over one hair: a column of cells of the head and the column opposite to it.
#[derive(Debug, Clone, Copy)]
struct Hair {
    mean: u32,
    flowing: u32,
    lacks: u32,
    pot: Cell,
    rest: Cell,
    /// Index of the last cell that lacks paint.
    last: usize,
}

const BARE: Hair = Hair { mean: 0, flowing: 0, lacks: 0, pot: EMPTY, rest: EMPTY, last: 0 };

/// Lets paint flow along the hair. Holds its buffers, so that no sub-step allocates.
#[derive(Debug, Default)]
pub(super) struct Wick {
    hairs: Vec<Hair>,
}

impl Wick {
    /// Moves paint within each column of `head`; see [`crate::motion::wick`]. `wicking` is the
    /// share of each surplus that moves, in parts of 65536.
    #[inline(always)]
    pub(super) fn apply(&mut self, wicking: u32, head: &mut HeadPaint) {
        let HeadPaint { cells: brush, means } = head;
        let width = brush.width();
        if width == 0 {
            return;
        }
        let rows = brush.volume().len() / width;
        self.hairs.clear();
        self.hairs.resize(width.div_ceil(2), BARE);
        for volumes in brush.volume().chunks_exact(width) {
            for (column, &volume) in volumes.iter().enumerate() {
                self.hairs[hair_of(column, width)].mean += volume >> UNIT_BITS;
            }
        }
        for (column, hair) in self.hairs.iter_mut().enumerate() {
            let columns = if width - 1 - column == column { 1 } else { 2 };
            hair.mean = mean(hair.mean, columns * rows as u32);
        }
        for means in means.chunks_exact_mut(width) {
            for (column, mean) in means.iter_mut().enumerate() {
                *mean = self.hairs[hair_of(column, width)].mean << UNIT_BITS;
            }
        }
        for (row, volumes) in brush.volume().chunks_exact(width).enumerate() {
            for (column, &volume) in volumes.iter().enumerate() {
                let hair = &mut self.hairs[hair_of(column, width)];
                let lack = lack(volume, hair.mean);
                if lack > 0 {
                    hair.lacks += lack;
                    hair.last = row * width + column;
                }
            }
        }
        for hair in &mut self.hairs {
            hair.flowing = if hair.lacks > 0 { flowing(wicking, hair.lacks) } else { 0 };
        }
        for row in (0..width * rows).step_by(width) {
            for column in 0..width {
                let (at, hair) = (row + column, &mut self.hairs[hair_of(column, width)]);
                let share = given_share(brush.volume()[at], hair.mean, hair.flowing);
                if share > 0 {
                    let cell = brush.cell(at);
                    let given = cell.share_of_65536(share);
                    hair.pot = hair.pot.plus(&given);
                    brush.set_cell(at, cell.minus(&given));
                }
            }
        }
        for hair in &mut self.hairs {
            hair.rest = hair.pot;
        }
        for row in (0..width * rows).step_by(width) {
            for column in 0..width {
                let (at, hair) = (row + column, &mut self.hairs[hair_of(column, width)]);
                let lack = lack(brush.volume()[at], hair.mean);
                if lack > 0 && hair.lacks > 0 {
                    let last = at == hair.last;
                    let part = if last { hair.rest } else { dealt(&hair.pot, lack, hair.lacks) };
                    hair.rest = hair.rest.minus(&part);
                    brush.set_cell(at, brush.cell(at).plus(&part));
                }
            }
        }
    }
}

/// Index of the hair that a column of cells belongs to, in a head of `width` columns.
#[inline(always)]
fn hair_of(column: usize, width: usize) -> usize {
    column.min(width - 1 - column)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::amount::MAX_COLUMN;
    use crate::layer::Layer;

    /// A head of `width` x `height` cells with the paint that `cell` makes.
    fn head(width: usize, height: usize, mut cell: impl FnMut(usize) -> Cell) -> HeadPaint {
        let mut layer = Layer::empty(width, height);
        (0..width * height).for_each(|index| layer.set_cell(index, cell(index)));
        HeadPaint::new(layer)
    }

    /// Paint of each slot, vehicle last, on the hair of each column.
    fn by_hair(head: &HeadPaint, width: usize) -> Vec<[u64; SLOTS + 1]> {
        let mut hairs = vec![[0; SLOTS + 1]; width.div_ceil(2)];
        for index in 0..head.means.len() {
            let Cell { pigments, vehicle } = head.cells.cell(index);
            let hair = &mut hairs[hair_of(index % width, width)];
            for (sum, amount) in hair.iter_mut().zip(pigments.into_iter().chain([vehicle])) {
                *sum += u64::from(amount);
            }
        }
        hairs
    }

    #[test]
    fn paint_stays_on_its_hair_and_evens_out() {
        let random = &mut ChaCha8Rng::seed_from_u64(1);
        for (width, height) in [(6, 20), (7, 9), (1, 12), (2, 1)] {
            let mut paint = head(width, height, |index| {
                let full = index / width < height / 2 && random.random_range(0..5) > 0;
                let mut amount = || if full { random.random_range(0..9_000_000) } else { 0 };
                Cell { pigments: std::array::from_fn(|_| amount()), vehicle: amount() }
            });
            let before = by_hair(&paint, width);
            for _ in 0..40 {
                Wick::default().apply(30_000, &mut paint);
                assert_eq!(by_hair(&paint, width), before, "{width} x {height}");
            }
            for (index, (&volume, &mean)) in
                paint.cells.volume().iter().zip(&paint.means).enumerate()
            {
                let hair: u64 = before[hair_of(index % width, width)].iter().sum();
                let columns = if hair_of(index % width, width) * 2 + 1 == width { 1 } else { 2 };
                assert!((hair / (columns * height) as u64).abs_diff(u64::from(mean)) <= 2048);
                let near = volume.abs_diff(mean) <= mean / 1000 + 4096;
                assert!(near, "{width} x {height}: {volume} in cell {index}, not {mean}");
            }
        }
    }

    #[test]
    fn level_hair_does_not_mix() {
        let cell = |index: usize| {
            let mut cell = Cell::default();
            cell.pigments[index % SLOTS] = 5_000_000;
            cell
        };
        let mut paint = head(4, 30, cell);
        Wick::default().apply(65536, &mut paint);
        assert!((0..120).all(|index| paint.cells.cell(index) == cell(index)), "paint moved");
        assert!(paint.means.iter().all(|mean| mean.abs_diff(5_000_000) < 1024), "{paint:?}");
    }

    #[test]
    fn a_pot_never_overflows() {
        let full = Cell { vehicle: MAX_COLUMN, ..EMPTY };
        let mut paint = head(2, 200, |index| if index < 200 { full } else { EMPTY });
        let before = by_hair(&paint, 2);
        for _ in 0..300 {
            Wick::default().apply(65536, &mut paint);
            assert_eq!(by_hair(&paint, 2), before);
        }
        let lowest = paint.cells.volume().iter().min();
        assert!(lowest > Some(&(MAX_COLUMN / 4)), "{lowest:?}");
    }
}
