//! The mask of a canvas as bytes.

use graphics::tile::Rect;
use paint::mask::Mask;

/// Most cells of a mask that is read.
const MOST_CELLS: usize = 1 << 30;

/// A bit a cell, row by row, the first in the lowest bit of the first byte; 1 is covered.
pub(super) fn bits_of(mask: &Mask) -> Vec<u8> {
    let cells = mask.bounds().width * mask.bounds().height;
    let bytes = (0..cells).step_by(8).map(|first| {
        let bits = (first..cells.min(first + 8)).enumerate();
        bits.fold(0, |bits, (bit, cell)| bits | u8::from(mask.covers(cell)) << bit)
    });
    bytes.collect()
}

/// The mask of a canvas of this width and height in cells; `None` if the bytes do not belong to it.
pub(super) fn mask_of(width: usize, height: usize, bytes: &[u8]) -> Option<Mask> {
    let cells = width.checked_mul(height).filter(|&cells| cells <= MOST_CELLS)?;
    let bounds = Rect { x: 0, y: 0, width, height };
    (bytes.len() == cells.div_ceil(8))
        .then(|| Mask::with_open(bounds, |cell: usize| bytes[cell / 8] >> (cell % 8) & 1 == 0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mask_is_read_as_it_was_written() {
        let bounds = Rect { x: 0, y: 0, width: 7, height: 3 };
        let mask = Mask::with_open(bounds, |cell| cell % 3 == 1);
        let bits = bits_of(&mask);
        assert_eq!(bits.len(), 3, "21 cells");
        assert_eq!(mask_of(7, 3, &bits), Some(mask));
        assert_eq!(mask_of(9, 3, &bits), None);
        assert_eq!(mask_of(7, 3, &bits[1..]), None);
        assert_eq!(mask_of(usize::MAX, 3, &bits), None);
    }
}
