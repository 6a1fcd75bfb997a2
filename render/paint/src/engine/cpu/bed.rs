//! The surface of the paint before a stroke, block by block; see [`crate::motion::bed`].

use super::columns::Columns;
use crate::motion::bed::{BLOCK, NO_BED, between, block_height, weighted};
use graphics::field::Field;
use graphics::tile::Rect;

/// Heights of the bed of a stroke.
#[derive(Debug, Clone)]
pub(super) struct Bed {
    /// By block, in units of 256 quanta.
    blocks: Field<i32>,
}

impl Bed {
    /// A bed over `bounds` that was never noted.
    pub(super) fn unknown(bounds: Rect) -> Self {
        let width = bounds.width.div_ceil(BLOCK);
        let height = bounds.height.div_ceil(BLOCK);
        Self { blocks: Field::filled(width, height, NO_BED) }
    }

    /// Notes the surface of `rect`, whose corner lies at that of a block, as it is now.
    pub(super) fn note(&mut self, rect: Rect, floor: &Field<i32>, wet: &Columns) {
        for y in (rect.y..rect.y + rect.height).step_by(BLOCK) {
            for x in (rect.x..rect.x + rect.width).step_by(BLOCK) {
                let width = BLOCK.min(rect.x + rect.width - x);
                let rows = y..(y + BLOCK).min(rect.y + rect.height);
                let mut sum = 0;
                for row in rows.clone() {
                    let volume = &wet.volume()[row * floor.width() + x..][..width];
                    let tops = floor.row(row, x, width).iter().zip(volume);
                    sum += tops.map(|(&floor, &wet)| (floor + wet as i32) >> 8).sum::<i32>();
                }
                self.blocks[(x / BLOCK, y / BLOCK)] =
                    block_height(sum, (width * rows.len()) as i32);
            }
        }
    }

    /// Writes the heights in quanta of the cells of row `y` from `x` on to `out`.
    #[inline(always)]
    pub(super) fn row(&self, (mut x, y): (usize, usize), mut out: &mut [i32]) {
        let (upper, lower, down) = between(y, self.blocks.height());
        let row = |block: usize| self.blocks.row(block, 0, self.blocks.width());
        let upper = row(upper);
        let lower = row(lower);
        while !out.is_empty() {
            let (left, right, share) = between(x, upper.len());
            let column = |block: usize| weighted((upper[block], lower[block]), down);
            let columns = (column(left), column(right));
            // The cells up to the middle of the right block.
            let count = (BLOCK - (x + BLOCK / 2) % BLOCK).min(out.len());
            let (cells, rest) = out.split_at_mut(count);
            for (i, out) in (0..).zip(cells) {
                *out = weighted(columns, share + 2 * i);
            }
            (x, out) = (x + count, rest);
        }
    }

    /// Height in quanta at a cell.
    #[cfg(test)]
    pub(super) fn at(&self, cell: (usize, usize)) -> i32 {
        let mut height = [0];
        self.row(cell, &mut height);
        height[0]
    }
}
