//! Flow of paint over a head, along its hairs and between them.

use super::columns::{Columns as Paint, HeadPaint};
use crate::contact::Wicking;
use crate::layer::{Cell, SLOTS};
use crate::motion::wick::{UNIT_BITS, dealt_share, flowing, given_share, lack, mean};

const EMPTY: Cell = Cell { pigments: [0; SLOTS], vehicle: 0 };

/// Mean, lack and pot of a group of hairs.
#[derive(Debug, Clone, Copy)]
struct Group {
    columns: u32,
    mean: u32,
    lacks: u32,
    pot: Cell,
    rest: Cell,
    /// Index of the last cell that lacks paint.
    last: usize,
}

const BARE: Group = Group { columns: 0, mean: 0, lacks: 0, pot: EMPTY, rest: EMPTY, last: 0 };

/// Figures of the columns of cells that take part, by column. Their loops do not branch, so that
/// the compiler makes vector instructions of them.
#[derive(Debug, Default)]
struct Columns {
    /// Index of the column within a row of cells.
    places: Vec<usize>,
    group_of: Vec<usize>,
    /// Sum over the column's cells of their volumes, or of the volumes that they lack, in units
    /// (see [`UNIT_BITS`]).
    sums: Vec<u32>,
    /// Index of the last row with a cell that lacks paint.
    last: Vec<u32>,
    /// Mean of the column's group. `flowing` and `lacks` are values of the group as well.
    means: Vec<u32>,
    flowing: Vec<u32>,
    lacks: Vec<u32>,
    /// Volumes in quanta of all cells, row by row.
    volumes: Vec<u32>,
    /// For the cells of one row, in parts of 65536: the share that a cell gives, or the share of
    /// the pot that it gets.
    shares: Vec<u32>,
}

/// Lets paint flow along and between hairs. This holds its buffers, so that sub-steps do not
/// allocate.
#[derive(Debug, Default)]
pub(super) struct Wick {
    groups: Vec<Group>,
    columns: Columns,
}

impl Wick {
    /// Moves paint within each group of hairs of `head`. See [`crate::motion::wick`].
    #[inline(always)]
    pub(super) fn apply(&mut self, wicking: Wicking, head: &mut HeadPaint) {
        let width = head.cells.width();
        if width == 0 {
            return;
        }
        let first = wicking.first_row as usize * width;
        let cells = head.means.len();
        self.divide(wicking, width);
        if first >= cells || self.columns.places.is_empty() {
            return;
        }
        let rows = (first..cells).step_by(width);
        self.level(rows.clone(), head);
        self.find_lacks(rows.clone());
        self.give(wicking, rows.clone(), &mut head.cells);
        self.deal(rows, &mut head.cells);
    }

    /// Finds the mean of each group, and stores it for the coat. `rows` are the indices of the
    /// first cells of the rows.
    #[inline(always)]
    fn level(&mut self, rows: impl Iterator<Item = usize> + Clone, head: &mut HeadPaint) {
        let Self { groups, columns } = self;
        let Columns { places, group_of, sums, means, volumes, .. } = columns;
        volumes.clear();
        sums.clear();
        sums.resize(places.len(), 0);
        let mut count = 0;
        for row in rows.clone() {
            let cells = &head.cells.volume()[row..][..head.cells.width()];
            let begin = volumes.len();
            volumes.resize(begin + places.len(), 0);
            let found = &mut volumes[begin..];
            for (volume, &place) in found.iter_mut().zip(&*places) {
                *volume = cells[place];
            }
            for (sum, &mut volume) in sums.iter_mut().zip(found) {
                *sum += volume >> UNIT_BITS;
            }
            count += 1;
        }
        for (&sum, &group) in sums.iter().zip(&*group_of) {
            groups[group].mean += sum;
        }
        for group in &mut *groups {
            group.mean = mean(group.mean, group.columns * count);
        }
        means.clear();
        means.extend(group_of.iter().map(|&group| groups[group].mean));
        for row in rows {
            let out = &mut head.means[row..][..head.cells.width()];
            for (&place, &mean) in places.iter().zip(&*means) {
                out[place] = mean << UNIT_BITS;
            }
        }
    }

    /// Finds what each group lacks, and its last cell that lacks paint.
    #[inline(always)]
    fn find_lacks(&mut self, rows: impl Iterator<Item = usize>) {
        let Self { groups, columns } = self;
        let Columns { places, group_of, sums, last, means, lacks, volumes, .. } = columns;
        for buffer in [&mut *sums, &mut *last] {
            buffer.clear();
            buffer.resize(places.len(), 0);
        }
        for (row, volumes) in rows.zip(volumes.chunks_exact(places.len())) {
            let found = sums.iter_mut().zip(&mut *last);
            for ((sum, last), (&volume, &mean)) in found.zip(volumes.iter().zip(&*means)) {
                let lack = lack(volume, mean);
                *sum += lack;
                *last = if lack > 0 { row as u32 } else { *last };
            }
        }
        let found = sums.iter().zip(&*last).zip(&*places);
        for (((&sum, &row), &place), &group) in found.zip(&*group_of) {
            let group = &mut groups[group];
            group.lacks += sum;
            group.last = if sum > 0 { group.last.max(row as usize + place) } else { group.last };
        }
        lacks.clear();
        lacks.extend(group_of.iter().map(|&group| groups[group].lacks));
    }

    /// Where cells have more than the mean, this moves a share of the surplus to the pots of their
    /// groups.
    #[inline(always)]
    fn give(&mut self, wicking: Wicking, rows: impl Iterator<Item = usize>, brush: &mut Paint) {
        let Self { groups, columns } = self;
        let Columns { places, group_of, means, flowing, lacks, volumes, shares, .. } = columns;
        flowing.clear();
        flowing.extend(lacks.iter().map(|&lacks| match lacks {
            0 => 0,
            lacks => self::flowing(wicking.share, lacks),
        }));
        shares.resize(places.len(), 0);
        for (row, volumes) in rows.zip(volumes.chunks_exact(places.len())) {
            let inputs = volumes.iter().zip(&*means).zip(&*flowing);
            for (share, ((&volume, &mean), &flowing)) in shares.iter_mut().zip(inputs) {
                *share = given_share(volume, mean, flowing);
            }
            for ((&share, &place), &group) in shares.iter().zip(&*places).zip(&*group_of) {
                if share > 0 {
                    let cell = brush.cell(row + place);
                    let given = cell.share_of_65536(share);
                    groups[group].pot = groups[group].pot.plus(&given);
                    brush.set_cell(row + place, cell.minus(&given));
                }
            }
        }
    }

    /// Divides the pots among the cells that lack paint.
    #[inline(always)]
    fn deal(&mut self, rows: impl Iterator<Item = usize>, brush: &mut Paint) {
        let Self { groups, columns } = self;
        let Columns { places, group_of, means, lacks, volumes, shares, .. } = columns;
        for group in &mut *groups {
            group.rest = group.pot;
        }
        for (row, volumes) in rows.zip(volumes.chunks_exact(places.len())) {
            let inputs = volumes.iter().zip(&*means).zip(&*lacks);
            for (share, ((&volume, &mean), &lacks)) in shares.iter_mut().zip(inputs) {
                *share = dealt_share(lack(volume, mean), lacks);
            }
            let cells = volumes.iter().zip(&*means).zip(&*shares);
            for (((&volume, &mean), &share), (&place, &group)) in
                cells.zip(places.iter().zip(&*group_of))
            {
                if volume >> UNIT_BITS < mean {
                    let at = row + place;
                    let group = &mut groups[group];
                    let last = at == group.last;
                    let part = if last { group.rest } else { group.pot.share_of_65536(share) };
                    group.rest = group.rest.minus(&part);
                    brush.set_cell(at, brush.cell(at).plus(&part));
                }
            }
        }
    }

    /// Divides the hairs of a head of `width` columns into groups.
    #[inline(always)]
    fn divide(&mut self, wicking: Wicking, width: usize) {
        let hairs = wicking.hairs.max(1) as usize;
        let shift = wicking.shift as usize;
        let turns = wicking.turns.max(1) as usize;
        let turn = wicking.turn as usize;
        self.groups.clear();
        self.groups.resize((width.div_ceil(2) + shift).div_ceil(hairs).div_ceil(turns), BARE);
        let Columns { places, group_of, .. } = &mut self.columns;
        places.clear();
        group_of.clear();
        for place in 0..width {
            let group = (hair_of(place, width) + shift) / hairs;
            if group % turns == turn {
                self.groups[group / turns].columns += 1;
                places.push(place);
                group_of.push(group / turns);
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
                let amounts = [full; SLOTS + 1];
                let [pigments @ .., vehicle] =
                    amounts.map(|full| if full { random.random_range(0..9_000_000) } else { 0 });
                Cell { pigments, vehicle }
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

    fn cell(index: usize) -> Cell {
        let mut cell = Cell::default();
        cell.pigments[index % SLOTS] = 5_000_000;
        cell
    }

    #[test]
    fn groups_that_shift_spread_paint_across_the_rows_that_take_part() {
        let full = Cell { vehicle: 6_000_000, ..EMPTY };
        let mut paint = head(40, 10, |index| if index % 40 == 3 { full } else { EMPTY });
        let above = paint.cells.layer().part(Rect { x: 0, y: 0, width: 40, height: 4 });
        let total = { paint.cells.layer().totals() };
        let wicking = Wicking { share: 65536, first_row: 4, hairs: 4, ..Wicking::default() };
        for step in 0..60 {
            let shift = if step % 2 == 0 { 0 } else { 2 };
            Wick::default().apply(Wicking { shift, ..wicking }, &mut paint);
            assert_eq!(paint.cells.layer().totals(), total);
        }
        let layer = paint.cells.layer();
        assert!(layer.part(Rect { x: 0, y: 0, width: 40, height: 4 }) == above, "upper rows moved");
        let volumes = &paint.cells.volume()[4 * 40..];
        let low = volumes.iter().min().unwrap();
        let high = volumes.iter().max().unwrap();
        assert!(*low > 100_000 && *high < 200_000, "{low} to {high}");
    }

    #[test]
    fn hairs_flow_in_turns() {
        let mut paint =
            head(12, 5, |index: usize| Cell { vehicle: 6_000_000 * (index / 12) as u32, ..EMPTY });
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

    fn volumes(paint: &HeadPaint) -> Vec<u32> {
        paint.cells.volume().to_vec()
    }
}
