//! The field of pressure under and around the head during one sub-step. This is steps 1 and 2 of
//! the specification in [`crate::motion`], row by row.
//!
//! A head that lies across the rows fills little of the rectangle around it, so we work on each row
//! only between its ends. The surface below the wet paint comes block by block from
//! [`crate::motion::bed`].

use std::ops::Range;

use graphics::field::Field;
use graphics::tile::Rect;

use super::columns::{Columns, HeadPaint};
use crate::contact::{Contact, Touch};
use crate::mask::Mask;
use crate::motion::MotionConstants;
use crate::motion::bed::{BLOCK, NO_BED, between, block_height, weighted};
use crate::motion::press::{
    CROWDED_VOLUME, Column, NO_CONTACT, avoid_crowded_columns, coat, flow, penetration, pressure,
};

/// Number of cells on every side of the reach that repeat its nearest cell, so that flows need not
/// check bounds.
const RIM: usize = 2;

/// Tops, penetrations and pressures in quanta over the reach of a contact and a rim around it. The
/// rim does not have contact.
#[derive(Debug, Default)]
pub(super) struct PenetrationMap {
    reach: Rect,
    tops: Vec<i32>,
    penetrations: Vec<i32>,
    pressures: Vec<i32>,
    contact: Spans,
    /// Columns that may move.
    moving: Spans,
    /// Columns that paint may leave or reach.
    changing: Spans,
    /// Columns with tops that we compute because flows depend on them.
    seen: Spans,
    /// Coat of each cell, in quanta: the thickness of the film that the head leaves there. The rows
    /// have a rim like the rows of `tops`. Only cells in contact have a valid coat.
    coats: Vec<u32>,
    /// Heights in quanta of the bed of one row of the contact.
    bed: Vec<i32>,
    /// Mean volumes of the hair above the cells of one row of the contact.
    means: Vec<u32>,
    /// Whether each column is crowded or covered by the mask. The rows have a rim like the rows of
    /// `tops`. If no column is, this is empty, which is nearly always so without a mask.
    crowded: Vec<bool>,
}

impl PenetrationMap {
    /// Step 1: computes the top of each cell of `reach` and the penetration of each cell of
    /// `contact`, which lies within `reach`.
    #[inline(always)]
    pub(super) fn measure(
        &mut self,
        motion: &MotionConstants,
        contact: &Contact,
        reach: Rect,
        below: Below<'_>,
        wet: &Columns,
        head: &HeadPaint,
    ) {
        self.clear();
        self.reach = reach;
        self.find_crowded(wet, below.mask);
        let cells = self.row_length() * (reach.height + 2 * RIM);
        self.tops.resize(self.tops.len().max(cells), 0);
        self.penetrations.resize(self.penetrations.len().max(cells), NO_CONTACT);
        self.pressures.resize(self.pressures.len().max(cells), NO_CONTACT);
        self.coats.resize(self.coats.len().max(cells), 0);
        self.bed.resize(self.bed.len().max(contact.rect.width), 0);
        self.means.resize(self.means.len().max(contact.rect.width), 0);
        for spans in [&mut self.contact, &mut self.moving, &mut self.changing, &mut self.seen] {
            spans.clear(reach);
        }
        self.press(motion, contact, below, wet, head);
        let moving = contact.rect.grown(1, below.floor.bounds());
        if motion.everywhere == 0 {
            self.moving.surround(&self.contact, moving);
        } else {
            self.moving.fill(moving);
        }
        self.changing.surround(&self.moving, reach);
        self.seen.surround(&self.changing, reach);
        self.find_tops(below.floor, wet);
    }

    /// Removes the contact of the sub-step before.
    #[inline(always)]
    fn clear(&mut self) {
        for y in self.contact.rows() {
            let columns = self.contact.of(y);
            let start = self.start(y) + columns.start.saturating_sub(self.reach.x);
            self.penetrations[start..][..columns.len()].fill(NO_CONTACT);
            self.pressures[start..][..columns.len()].fill(NO_CONTACT);
        }
    }

    /// Computes the penetration of each cell of `contact`, and the pressure there.
    #[inline(always)]
    fn press(
        &mut self,
        motion: &MotionConstants,
        contact: &Contact,
        below: Below<'_>,
        wet: &Columns,
        head: &HeadPaint,
    ) {
        // We copy this, so that the loop need not load it again after each store.
        let rect = contact.rect;
        let rates = contact.rates;
        let Below { floor, bed, mask } = below;
        for (y, touches) in (rect.y..).zip(contact.touches.chunks_exact(rect.width)) {
            let Some(from) = touches.iter().position(below_head) else { continue };
            let touches = &touches[from..];
            let count = touches.iter().rposition(below_head).map_or(0, |last| last + 1);
            let touches = &touches[..count];
            let x = rect.x + from;
            let first = y * floor.width() + x;
            let volume = &wet.volume()[first..][..count];
            let floor = floor.row(y, x, count);
            let paint = floor.iter().copied().zip(volume.iter().copied());
            let start = self.start(y) + x - self.reach.x;
            let heights = &mut self.bed[..count];
            bed.row((x, y), heights);
            let means = &mut self.means[..count];
            for (mean, touch) in means.iter_mut().zip(touches) {
                *mean = head.means.get(touch.brush_cell as usize).copied().unwrap_or_default();
            }
            let found = &mut self.penetrations[start..][..count];
            let coats = &mut self.coats[start..][..count];
            let inputs = touches.iter().zip(paint).zip(&*heights).zip(&*means);
            // This does not branch, so that the compiler makes vector instructions of it.
            for ((here, covered), (((&touch, paint), &bed), &mean)) in
                found.iter_mut().zip(coats).zip(inputs)
            {
                *covered = coat(&rates, touch, mean);
                *here = penetration(&rates, touch, paint, bed, *covered);
            }
            if let Some(mask) = mask {
                for (cell, here) in (first..).zip(&mut *found) {
                    *here = if mask.covers(cell) { NO_CONTACT } else { *here };
                }
            }
            let Some(first) = found.iter().position(touching) else { continue };
            let end = found.iter().rposition(touching).map_or(first, |last| last + 1);
            self.contact.set(y, x + first..x + end);
            let pressures = &mut self.pressures[start..][first..end];
            for (pressed, &penetration) in pressures.iter_mut().zip(&found[first..end]) {
                *pressed = pressure(motion, penetration);
            }
        }

        #[inline(always)]
        fn touching(penetration: &i32) -> bool {
            *penetration != NO_CONTACT
        }

        #[inline(always)]
        fn below_head(touch: &Touch) -> bool {
            touch.height != Touch::NONE.height
        }
    }

    /// Computes the tops of the columns that we need, and of the rim beside them.
    #[inline(always)]
    fn find_tops(&mut self, floor: &Field<i32>, wet: &Columns) {
        let reach = self.reach;
        let row = self.row_length();
        for y in self.seen.rows() {
            let columns = self.seen.of(y);
            let volume = &wet.volume()[y * floor.width()..][columns.clone()];
            let floor = floor.row(y, columns.start, columns.len());
            let start = self.start(y);
            let from = columns.start.saturating_sub(reach.x);
            let tops = &mut self.tops[start - RIM..][..row];
            let inner = &mut tops[RIM + from..][..columns.len()];
            for ((top, &floor), &volume) in inner.iter_mut().zip(floor).zip(volume) {
                *top = floor + volume as i32;
            }
            let first = tops[RIM];
            let last = tops[RIM + reach.width - 1];
            tops[..RIM].fill(first);
            tops[RIM + reach.width..].fill(last);
        }
        let first = RIM * row;
        let last = (RIM + reach.height - 1) * row;
        for i in 1..=RIM {
            self.tops.copy_within(first..first + row, first - i * row);
            self.tops.copy_within(last..last + row, last + i * row);
        }
    }

    /// Columns of row `y` that are in contact, with those between them.
    #[inline(always)]
    pub(super) fn in_contact(&self, y: usize) -> Range<usize> {
        self.contact.of(y)
    }

    /// Columns of row `y` that may move.
    #[inline(always)]
    pub(super) fn moving(&self, y: usize) -> Range<usize> {
        self.moving.of(y)
    }

    /// Columns of row `y` that paint may move to or from.
    #[inline(always)]
    pub(super) fn changing(&self, y: usize) -> Range<usize> {
        self.changing.of(y)
    }

    /// Columns of the rows `y - 1` and `y` that may move, and those between them.
    #[inline(always)]
    pub(super) fn moving_beside(&self, y: usize) -> Range<usize> {
        joined(&self.moving.of(y.wrapping_sub(1)), &self.moving.of(y))
    }

    /// Sets all bits of `found` for each cell of row `y` from `x` on that is in contact or has a
    /// neighbour in contact. For other cells this sets 0.
    #[inline(always)]
    pub(super) fn near_contact(&self, (x, y): (usize, usize), found: &mut [u32]) {
        let row = self.row_length();
        let count = found.len();
        let middle = self.start(y) + x - self.reach.x;
        // Nine rows of pressures. Those without contact are the lowest.
        let beside = |place: usize| {
            let at = |place: usize| &self.pressures[place..][..count];
            at(place - 1).iter().zip(at(place)).zip(at(place + 1))
        };
        let rows = beside(middle - row).zip(beside(middle)).zip(beside(middle + row));
        for (found, ((above, here), below)) in found.iter_mut().zip(rows) {
            let highest = highest(above).max(highest(here)).max(highest(below));
            *found = if highest == NO_CONTACT { 0 } else { u32::MAX };
        }

        #[inline(always)]
        fn highest(((&a, &b), &c): ((&i32, &i32), &i32)) -> i32 {
            a.max(b).max(c)
        }
    }

    /// Finds the columns that do not move and that nothing flows to. These are crowded or covered.
    #[inline(always)]
    fn find_crowded(&mut self, wet: &Columns, mask: Option<&Mask>) {
        let reach = self.reach;
        self.crowded.clear();
        let rows = reach.y..reach.y + reach.height;
        let volumes = |y: usize| &wet.volume()[y * wet.width() + reach.x..][..reach.width];
        let highest = rows.clone().map(|y| highest(volumes(y))).max().unwrap_or(0);
        if highest > CROWDED_VOLUME || mask.is_some() {
            self.crowded.resize(self.row_length() * (reach.height + 2 * RIM), false);
            for y in rows {
                let start = self.start(y);
                let first = y * wet.width() + reach.x;
                let columns = self.crowded[start..].iter_mut().zip(volumes(y));
                for (cell, (crowded, &volume)) in (first..).zip(columns) {
                    *crowded =
                        volume > CROWDED_VOLUME || mask.is_some_and(|mask| mask.covers(cell));
                }
            }
        }
    }

    /// Whether any column of the reach is crowded.
    #[inline(always)]
    pub(super) fn has_crowded(&self) -> bool {
        !self.crowded.is_empty()
    }

    /// Step 2: applies [`avoid_crowded_columns`] to the velocity of a cell. Use this only if some
    /// column is crowded.
    #[inline(always)]
    pub(super) fn avoid_crowded(&self, (x, y): (usize, usize), velocity: (i32, i32)) -> (i32, i32) {
        let row = self.row_length() as isize;
        let place = self.start(y) + x - self.reach.x;
        avoid_crowded_columns(velocity, |right, down| {
            self.crowded[place.wrapping_add_signed(down as isize * row + right as isize)]
        })
    }

    fn row_length(&self) -> usize {
        self.reach.width + 2 * RIM
    }

    /// Index of the reach's first cell in row `y`. You may also pass the rows of the rim.
    #[inline(always)]
    fn start(&self, y: usize) -> usize {
        (y + RIM - self.reach.y) * self.row_length() + RIM
    }

    /// Penetration of `width` cells of row `y` from `x` on, in quanta.
    #[inline(always)]
    pub(super) fn row(&self, y: usize, x: usize, width: usize) -> &[i32] {
        &self.penetrations[self.start(y) + x - self.reach.x..][..width]
    }

    /// Coat of `width` cells of row `y` from `x` on, in quanta, where they are in contact.
    #[inline(always)]
    pub(super) fn coats(&self, y: usize, x: usize, width: usize) -> &[u32] {
        &self.coats[self.start(y) + x - self.reach.x..][..width]
    }

    /// Step 2: flows over the left sides of the cells of row `y` from `x` on, one for each of
    /// `found`, in quanta.
    #[inline(always)]
    pub(super) fn flows_in_x(
        &self,
        motion: &MotionConstants,
        (x, y): (usize, usize),
        found: &mut [i32],
    ) {
        self.flows(motion, self.start(y) + x - self.reach.x, 1, found);
    }

    /// Step 2: flows over the upper sides of the cells of row `y` from `x` on, one for each of
    /// `found`, in quanta.
    #[inline(always)]
    pub(super) fn flows_in_y(
        &self,
        motion: &MotionConstants,
        (x, y): (usize, usize),
        found: &mut [i32],
    ) {
        self.flows(motion, self.start(y) + x - self.reach.x, self.row_length(), found);
    }

    /// Flows into the cells from index `place` on. Each comes from the cell `stride` indices
    /// before.
    #[inline(always)]
    fn flows(&self, motion: &MotionConstants, place: usize, stride: usize, found: &mut [i32]) {
        let motion = *motion;
        let count = found.len();
        let tops = |first: usize| &self.tops[first..][..count];
        let before = tops(place - 2 * stride).iter();
        let here = tops(place - stride).iter().zip(&self.pressures[place - stride..][..count]);
        let next = tops(place).iter().zip(&self.pressures[place..][..count]);
        let beyond = tops(place + stride);
        let columns = before.zip(here).zip(next).zip(beyond);
        for (found, (((&before, here), next), &beyond)) in found.iter_mut().zip(columns) {
            *found = flow(&motion, before, column(here), column(next), beyond);
        }

        #[inline(always)]
        fn column((&top, &pressure): (&i32, &i32)) -> Column {
            Column { top, pressure }
        }
    }
}

#[inline(always)]
fn highest(volumes: &[u32]) -> u32 {
    let mut highest = 0;
    for &volume in volumes {
        highest = highest.max(volume);
    }
    highest
}

/// One range of columns of the canvas for each row of a contact's reach. Empty where a row has
/// none.
#[derive(Debug, Default)]
pub(super) struct Spans {
    first: usize,
    ranges: Vec<Range<usize>>,
}

impl Spans {
    /// Makes the spans of the rows of `reach` empty.
    pub(super) fn clear(&mut self, reach: Rect) {
        self.first = reach.y;
        self.ranges.clear();
        self.ranges.resize(reach.height, 0..0);
    }

    pub(super) fn rows(&self) -> Range<usize> {
        self.first..self.first + self.ranges.len()
    }

    /// Columns of row `y`. Empty for rows beyond the reach.
    #[inline(always)]
    pub(super) fn of(&self, y: usize) -> Range<usize> {
        let row = y.checked_sub(self.first).and_then(|row| self.ranges.get(row));
        row.cloned().unwrap_or_default()
    }

    /// Sets the columns of row `y`, which must be a row of the reach.
    #[inline(always)]
    pub(super) fn set(&mut self, y: usize, columns: Range<usize>) {
        self.ranges[y - self.first] = columns;
    }

    /// Sets the columns of the rows of `rect` to the columns of `rect`.
    pub(super) fn fill(&mut self, rect: Rect) {
        for y in rect.y..rect.y + rect.height {
            self.set(y, rect.x..rect.x + rect.width);
        }
    }

    /// Sets each span to the columns within `limit` that have a neighbour in `inner` (beside,
    /// above, below or diagonal), and to the columns between them.
    pub(super) fn surround(&mut self, inner: &Self, limit: Rect) {
        for y in limit.y..limit.y + limit.height {
            let near =
                joined(&joined(&inner.of(y.wrapping_sub(1)), &inner.of(y)), &inner.of(y + 1));
            if !near.is_empty() {
                let start = near.start.saturating_sub(1).max(limit.x);
                self.set(y, start..(near.end + 1).min(limit.x + limit.width));
            }
        }
    }
}

/// The columns of both ranges and those between them.
#[inline(always)]
pub(super) fn joined(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    if a.is_empty() {
        b.clone()
    } else if b.is_empty() {
        a.clone()
    } else {
        a.start.min(b.start)..a.end.max(b.end)
    }
}

/// Heights of the bed of a stroke.
#[derive(Debug, Clone)]
pub(super) struct Bed {
    /// Height of each block, in units of 256 quanta.
    blocks: Field<i32>,
    /// For each block, a bit for each cell: 1 if there was wet paint. Each row of a block is a byte, its
    /// left cell the lowest bit.
    painted: Field<u64>,
}

impl Bed {
    /// A bed over `bounds` of which you have not recorded any block.
    pub(super) fn unknown(bounds: Rect) -> Self {
        let width = bounds.width.div_ceil(BLOCK);
        let height = bounds.height.div_ceil(BLOCK);
        Self {
            blocks: Field::filled(width, height, NO_BED),
            painted: Field::filled(width, height, 0),
        }
    }

    /// Records the current surface height under `rect` (corner aligned to a block). Returns whether
    /// there is wet paint.
    pub(super) fn note(&mut self, rect: Rect, floor: &Field<i32>, wet: &Columns) -> bool {
        let mut any = 0;
        for y in (rect.y..rect.y + rect.height).step_by(BLOCK) {
            for x in (rect.x..rect.x + rect.width).step_by(BLOCK) {
                let width = BLOCK.min(rect.x + rect.width - x);
                let rows = y..(y + BLOCK).min(rect.y + rect.height);
                let mut sum = 0;
                let mut painted = 0_u64;
                for row in rows.clone() {
                    let volume = &wet.volume()[row * floor.width() + x..][..width];
                    let tops = floor.row(row, x, width).iter().zip(volume);
                    sum += tops.map(|(&floor, &wet)| (floor + wet as i32) >> 8).sum::<i32>();
                    for (column, &volume) in volume.iter().enumerate() {
                        let bit = (row % BLOCK) * BLOCK + column;
                        painted |= u64::from(volume > 0) << bit;
                    }
                }
                self.blocks[(x / BLOCK, y / BLOCK)] =
                    block_height(sum, (width * rows.len()) as i32);
                self.painted[(x / BLOCK, y / BLOCK)] = painted;
                any |= painted;
            }
        }
        any > 0
    }

    /// Writes whether there was wet paint on the cells of row `y` from `x` on. Returns whether there was
    /// any.
    #[inline(always)]
    pub(super) fn painted_row(&self, (x, y): (usize, usize), out: &mut [bool]) -> bool {
        let blocks = self.painted.row(y / BLOCK, 0, self.painted.width());
        let mut any = 0;
        for (column, out) in (x..).zip(out) {
            let bit = blocks[column / BLOCK] >> ((y % BLOCK) * BLOCK + column % BLOCK) & 1;
            *out = bit == 1;
            any |= bit;
        }
        any == 1
    }

    /// Writes the heights in quanta of the cells of row `y` from `x` on to `out`.
    #[inline(always)]
    pub(super) fn row(&self, (mut x, y): (usize, usize), mut out: &mut [i32]) {
        let (upper, lower, down) = between(y, self.blocks.height());
        let [upper, lower] =
            [upper, lower].map(|block| self.blocks.row(block, 0, self.blocks.width()));
        while !out.is_empty() {
            let (left, right, share) = between(x, upper.len());
            let [left, right] =
                [left, right].map(|block| weighted((upper[block], lower[block]), down));
            // The cells up to the middle of the right block.
            let count = (BLOCK - (x + BLOCK / 2) % BLOCK).min(out.len());
            let (cells, rest) = out.split_at_mut(count);
            for (i, out) in (0..).zip(cells) {
                *out = weighted((left, right), share + 2 * i);
            }
            (x, out) = (x + count, rest);
        }
    }

    #[cfg(test)]
    pub(super) fn painted_at(&self, cell: (usize, usize)) -> bool {
        self.painted_row(cell, &mut [false])
    }

    #[cfg(test)]
    pub(super) fn at(&self, cell: (usize, usize)) -> i32 {
        let mut height = [0];
        self.row(cell, &mut height);
        height[0]
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Below<'a> {
    /// Height of ground and dry paint in quanta.
    pub(super) floor: &'a Field<i32>,
    pub(super) bed: &'a Bed,
    pub(super) mask: Option<&'a Mask>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_around_spans_hold_all_neighbours_within_the_limit() {
        let reach = Rect { x: 3, y: 10, width: 20, height: 6 };
        let mut inner = Spans::default();
        let mut around = Spans::default();
        inner.clear(reach);
        inner.set(12, 5..7);
        inner.set(13, 20..23);
        around.clear(reach);
        around.surround(&inner, reach);
        let found: Vec<_> = around.rows().map(|y| around.of(y)).collect();
        assert_eq!(found, [0..0, 4..8, 4..23, 4..23, 19..23, 0..0]);
        assert_eq!([around.of(9), around.of(16)], [0..0, 0..0]);
    }
}
