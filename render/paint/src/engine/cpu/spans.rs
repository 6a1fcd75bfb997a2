//! The part of each row that a sub-step works on. A head that lies across the rows fills little
//! of the rectangle around it.

use std::ops::Range;

use graphics::tile::Rect;

/// One range of columns of the canvas for each row of a contact's reach; empty where a row has
/// none.
#[derive(Debug, Default)]
pub(super) struct Spans {
    /// First row.
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

    /// The rows.
    pub(super) fn rows(&self) -> Range<usize> {
        self.first..self.first + self.ranges.len()
    }

    /// Columns of row `y`; none of rows beyond the reach.
    #[inline(always)]
    pub(super) fn of(&self, y: usize) -> Range<usize> {
        let row = y.checked_sub(self.first).and_then(|row| self.ranges.get(row));
        row.cloned().unwrap_or_default()
    }

    /// Sets the columns of row `y`, which is one of the reach.
    #[inline(always)]
    pub(super) fn set(&mut self, y: usize, columns: Range<usize>) {
        self.ranges[y - self.first] = columns;
    }

    /// Sets the columns of the rows of `rect` to those of `rect`.
    pub(super) fn fill(&mut self, rect: Rect) {
        for y in rect.y..rect.y + rect.height {
            self.set(y, rect.x..rect.x + rect.width);
        }
    }

    /// Sets each span to the columns within `limit` that have a neighbour in `inner`, be it aside,
    /// above, below or diagonal, and those between them.
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
