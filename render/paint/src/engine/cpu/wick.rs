//! Flow of paint over a head, along its hairs and between them.

use super::head_paint::HeadPaint;
use crate::contact::Wicking;
use crate::layer::{Cell, SLOTS};
use crate::motion::wick::{UNIT_BITS, dealt, flowing, given_share, lack, mean};

const EMPTY: Cell = Cell { pigments: [0; SLOTS], vehicle: 0 };

/// Sums over a group of hairs.
#[derive(Debug, Clone, Copy)]
struct Group {
    columns: u32,
    mean: u32,
    flowing: u32,
    lacks: u32,
    pot: Cell,
    rest: Cell,
    /// Index of the last cell that lacks paint.
    last: usize,
}

const BARE: Group =
    Group { columns: 0, mean: 0, flowing: 0, lacks: 0, pot: EMPTY, rest: EMPTY, last: 0 };

/// Lets paint flow along and between hairs. Holds its buffers, so that no sub-step allocates.
#[derive(Debug, Default)]
pub(super) struct Wick {
    groups: Vec<Group>,
    /// Columns of cells that take part, with the index of their group.
    columns: Vec<(usize, usize)>,
}

impl Wick {
    /// Moves paint within each group of hairs of `head`; see [`crate::motion::wick`].
    #[inline(always)]
    pub(super) fn apply(&mut self, wicking: Wicking, head: &mut HeadPaint) {
        let HeadPaint { cells: brush, means } = head;
        let width = brush.width();
        if width == 0 {
            return;
        }
        let first = wicking.first_row as usize * width;
        let Some(rows) = brush.volume().len().checked_sub(first).map(|cells| cells / width) else {
            return;
        };
        self.divide(wicking, width);
        let Self { groups, columns } = self;
        let cells = || (first..).step_by(width).take(rows);
        for row in cells() {
            let volumes = &brush.volume()[row..][..width];
            for &(column, group) in &*columns {
                groups[group].mean += volumes[column] >> UNIT_BITS;
            }
        }
        for group in &mut *groups {
            group.mean = mean(group.mean, group.columns * rows as u32);
        }
        for row in cells() {
            let means = &mut means[row..][..width];
            for &(column, group) in &*columns {
                means[column] = groups[group].mean << UNIT_BITS;
            }
        }
        for row in cells() {
            let volumes = &brush.volume()[row..][..width];
            for &(column, group) in &*columns {
                let group = &mut groups[group];
                let lack = lack(volumes[column], group.mean);
                if lack > 0 {
                    group.lacks += lack;
                    group.last = row + column;
                }
            }
        }
        for group in &mut *groups {
            group.flowing = if group.lacks > 0 { flowing(wicking.share, group.lacks) } else { 0 };
        }
        for row in cells() {
            for &(column, group) in &*columns {
                let (at, group) = (row + column, &mut groups[group]);
                let share = given_share(brush.volume()[at], group.mean, group.flowing);
                if share > 0 {
                    let cell = brush.cell(at);
                    let given = cell.share_of_65536(share);
                    group.pot = group.pot.plus(&given);
                    brush.set_cell(at, cell.minus(&given));
                }
            }
        }
        for group in &mut *groups {
            group.rest = group.pot;
        }
        for row in cells() {
            for &(column, group) in &*columns {
                let (at, group) = (row + column, &mut groups[group]);
                let lack = lack(brush.volume()[at], group.mean);
                if lack > 0 && group.lacks > 0 {
                    let last = at == group.last;
                    let part = if last { group.rest } else { dealt(&group.pot, lack, group.lacks) };
                    group.rest = group.rest.minus(&part);
                    brush.set_cell(at, brush.cell(at).plus(&part));
                }
            }
        }
    }

    /// Divides the hairs of a head of `width` columns into groups.
    #[inline(always)]
    fn divide(&mut self, wicking: Wicking, width: usize) {
        let (hairs, shift) = (wicking.hairs.max(1) as usize, wicking.shift as usize);
        let (turns, turn) = (wicking.turns.max(1) as usize, wicking.turn as usize);
        self.groups.clear();
        self.groups.resize((width.div_ceil(2) + shift).div_ceil(hairs).div_ceil(turns), BARE);
        self.columns.clear();
        for column in 0..width {
            let group = (hair_of(column, width) + shift) / hairs;
            if group % turns == turn {
                let group = group / turns;
                self.groups[group].columns += 1;
                self.columns.push((column, group));
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
    use graphics::tile::Rect;

    /// A head of `width` x `height` cells with the paint that `cell` makes.
    fn head(width: usize, height: usize, mut cell: impl FnMut(usize) -> Cell) -> HeadPaint {
        let mut layer = Layer::empty(width, height);
        (0..width * height).for_each(|index| layer.set_cell(index, cell(index)));
        HeadPaint::new(layer)
    }

    /// Each hair levels alone.
    fn along(share: u32) -> Wicking {
        Wicking { share, ..Wicking::default() }
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
                Wick::default().apply(along(30_000), &mut paint);
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
        Wick::default().apply(along(65536), &mut paint);
        assert!((0..120).all(|index| paint.cells.cell(index) == cell(index)), "paint moved");
        assert!(paint.means.iter().all(|mean| mean.abs_diff(5_000_000) < 1024), "{paint:?}");
    }

    #[test]
    fn a_pot_never_overflows() {
        let full = Cell { vehicle: MAX_COLUMN, ..EMPTY };
        let mut paint = head(2, 200, |index| if index < 200 { full } else { EMPTY });
        let before = by_hair(&paint, 2);
        for _ in 0..300 {
            Wick::default().apply(along(65536), &mut paint);
            assert_eq!(by_hair(&paint, 2), before);
        }
        let lowest = paint.cells.volume().iter().min();
        assert!(lowest > Some(&(MAX_COLUMN / 4)), "{lowest:?}");
    }

    #[test]
    fn groups_that_shift_spread_paint_across_the_rows_that_take_part() {
        let full = Cell { vehicle: 6_000_000, ..EMPTY };
        let mut paint = head(40, 10, |index| if index % 40 == 3 { full } else { EMPTY });
        let (above, total) =
            (paint.cells.layer().part(Rect { x: 0, y: 0, width: 40, height: 4 }), {
                paint.cells.layer().totals()
            });
        let wicking = Wicking { share: 65536, first_row: 4, hairs: 4, ..Wicking::default() };
        for step in 0..60 {
            let shift = if step % 2 == 0 { 0 } else { 2 };
            Wick::default().apply(Wicking { shift, ..wicking }, &mut paint);
            assert_eq!(paint.cells.layer().totals(), total);
        }
        let layer = paint.cells.layer();
        assert!(layer.part(Rect { x: 0, y: 0, width: 40, height: 4 }) == above, "upper rows moved");
        let volumes = &paint.cells.volume()[4 * 40..];
        let (low, high) = (volumes.iter().min().unwrap(), volumes.iter().max().unwrap());
        assert!(*low > 100_000 && *high < 200_000, "{low} to {high}");
    }

    #[test]
    fn hairs_flow_in_turns() {
        let full = |index: usize| Cell { vehicle: 6_000_000 * (index / 12) as u32, ..EMPTY };
        let mut paint = head(12, 5, full);
        let volumes = |paint: &HeadPaint| paint.cells.volume().to_vec();
        let mut whole = paint.clone();
        Wick::default().apply(along(9000), &mut whole);
        for turn in 0..4 {
            let before = volumes(&paint);
            Wick::default().apply(Wicking { turns: 4, turn, ..along(9000) }, &mut paint);
            for (index, (before, after)) in before.iter().zip(volumes(&paint)).enumerate() {
                let flows = hair_of(index % 12, 12) as u32 % 4 == turn;
                // The middle row holds the mean.
                assert_eq!(*before != after, flows && index / 12 != 2, "turn {turn}, {index}");
            }
        }
        assert_eq!(volumes(&paint), volumes(&whole));
    }
}
