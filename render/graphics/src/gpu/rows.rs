//! Rows of values in a buffer.

use crate::tile::Rect;

/// Largest transfer between processor and device at a time, in bytes.
pub(super) const CHUNK: u64 = 64 << 20;

/// A set of values in a buffer: rows of equal length at equal distances. All members count
/// values, not bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rows {
    /// Offset of the first row.
    pub first: usize,
    /// Distance from the start of one row to that of the next.
    pub stride: usize,
    /// Number of values per row.
    pub length: usize,
    /// Number of rows.
    pub count: usize,
}

impl Rows {
    /// The first `count` values of a buffer.
    #[must_use]
    pub fn start(count: usize) -> Self {
        Self { first: 0, stride: count, length: count, count: 1 }
    }

    /// The cells of `rect` in a field that is `width` cells wide.
    #[must_use]
    pub fn of(rect: Rect, width: usize) -> Self {
        let first = rect.y * width + rect.x;
        match rect.width == width {
            true => Self { first, ..Self::start(width * rect.height) },
            false => Self { first, stride: width, length: rect.width, count: rect.height },
        }
    }

    /// Offset and length in bytes of each piece to transfer, for values of `bytes` each. Rows
    /// longer than [`CHUNK`] are cut into several pieces.
    pub(super) fn pieces(self, bytes: usize) -> impl Iterator<Item = (u64, u64)> {
        let row = (self.length * bytes) as u64;
        let stride = (self.stride * bytes) as u64;
        let first = (self.first * bytes) as u64;
        (0..self.count as u64).flat_map(move |y| {
            let cuts = (0..row.div_ceil(CHUNK)).map(|cut| cut * CHUNK);
            cuts.map(move |cut| (first + y * stride + cut, CHUNK.min(row - cut)))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_a_rectangle_are_its_cells_and_no_piece_passes_a_chunk() {
        let rect = Rect { x: 3, y: 2, width: 4, height: 2 };
        let pieces: Vec<_> = Rows::of(rect, 10).pieces(16).collect();
        assert_eq!(pieces, [(23 * 16, 64), (33 * 16, 64)]);
        let whole = Rect { x: 0, y: 1, width: 10, height: 5 };
        assert_eq!(Rows::of(whole, 10).pieces(4).collect::<Vec<_>>(), [(40, 200)]);
        let long = Rows { first: 1, stride: 1 << 25, length: (1 << 24) + 1, count: 1 };
        let pieces: Vec<_> = long.pieces(4).collect();
        assert_eq!(pieces, [(4, CHUNK), (4 + CHUNK, 4)]);
        assert_eq!(Rows::start(0).pieces(4).count(), 0);
    }
}
