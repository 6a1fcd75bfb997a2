//! Heights of the surface of a painting, with a margin around the canvas.

use std::ops::Range;

use rayon::prelude::*;

/// Width in cells of the margin on both sides of every row: how far shading may look.
pub const MARGIN: usize = 32;

/// Height of the surface at every cell, in quanta. Beyond the edges of the canvas the surface
/// goes on level.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tops {
    width: usize,
    height: usize,
    /// Rows of `MARGIN + width + MARGIN` heights.
    values: Vec<i32>,
}

impl Tops {
    /// A level surface over `width` x `height` cells.
    #[must_use]
    pub fn level(width: usize, height: usize) -> Self {
        Self { width, height, values: vec![0; (width + 2 * MARGIN) * height] }
    }

    /// Number of columns and rows of the canvas.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Height at a cell in quanta.
    ///
    /// # Panics
    /// If the cell lies outside the canvas.
    #[must_use]
    pub fn at(&self, cell: (usize, usize)) -> i32 {
        self.row(cell, [0, 0], 1)[0]
    }

    /// Sets the heights of the columns `spans(y)` of each row y in `rows` to `top(x, y)`, on all
    /// cores.
    ///
    /// # Panics
    /// If rows or spans reach beyond the canvas.
    pub fn set<'a>(
        &mut self,
        rows: Range<usize>,
        spans: impl Fn(usize) -> &'a [Range<usize>] + Sync,
        top: impl Fn(usize, usize) -> i32 + Sync,
    ) {
        let (width, stride) = (self.width, self.width + 2 * MARGIN);
        let first = rows.start;
        let values = &mut self.values[rows.start * stride..rows.end * stride];
        values.par_chunks_mut(stride).enumerate().for_each(|(row, values)| {
            let y = first + row;
            for span in spans(y) {
                let inside = &mut values[MARGIN..][..width][span.clone()];
                for (x, value) in span.clone().zip(inside) {
                    *value = top(x, y);
                }
            }
            let left = values[MARGIN];
            let right = values[MARGIN + width - 1];
            values[..MARGIN].fill(left);
            values[MARGIN + width..].fill(right);
        });
    }

    /// Sets all heights to `top(x, y)`, on all cores.
    pub fn set_all(&mut self, top: impl Fn(usize, usize) -> i32 + Sync) {
        if self.width > 0 {
            let row = 0..self.width;
            self.set(0..self.height, |_| std::slice::from_ref(&row), top);
        }
    }

    /// Heights of `count` cells from (`x`, `y`) on, moved by `offset` in x and y.
    ///
    /// # Panics
    /// If the offset along x exceeds [`MARGIN`], or cells of the canvas are none.
    #[inline(always)]
    pub(super) fn row(&self, (x, y): (usize, usize), offset: [i32; 2], count: usize) -> &[i32] {
        let [along, down] = offset;
        let row = y.saturating_add_signed(down as isize).min(self.height - 1);
        let first = (x + MARGIN).wrapping_add_signed(along as isize);
        &self.values[row * (self.width + 2 * MARGIN)..][first..][..count]
    }
}
