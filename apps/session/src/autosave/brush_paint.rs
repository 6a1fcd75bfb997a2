//! Paint of brushes as bytes.

use paint::layer::{Cell, Layer, SLOTS};

/// Numbers of a cell: each slot, then the vehicle.
const NUMBERS: usize = SLOTS + 1;

/// Most cells of a head that is read.
const MOST_CELLS: usize = 1 << 24;

/// All cells of a head, row by row; each number takes four bytes, the lowest first.
pub(super) fn bytes_of(paint: &Layer) -> Vec<u8> {
    let cells = (0..paint.width() * paint.height()).map(|index| paint.cell(index));
    let numbers = cells.flat_map(|Cell { pigments, vehicle }| {
        pigments.into_iter().chain([vehicle]).flat_map(u32::to_le_bytes)
    });
    numbers.collect()
}

/// The paint of a head of this width and height; `None` if the bytes do not belong to it.
pub(super) fn paint_of(width: usize, height: usize, bytes: &[u8]) -> Option<Layer> {
    let cells = width.checked_mul(height).filter(|&cells| cells <= MOST_CELLS)?;
    let (numbers, rest) = bytes.as_chunks::<4>();
    if numbers.len() != cells * NUMBERS || !rest.is_empty() {
        return None;
    }
    let mut paint = Layer::empty(width, height);
    for (index, cell) in numbers.as_chunks::<NUMBERS>().0.iter().enumerate() {
        let [pigments @ .., vehicle] = cell.map(u32::from_le_bytes);
        paint.set_cell(index, Cell { pigments, vehicle });
    }
    Some(paint)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paint_is_read_as_it_was_written() {
        let mut paint = Layer::empty(3, 2);
        paint.set_cell(4, Cell { pigments: [1, 2, 3, 4, 5, 6, 7, 1 << 30], vehicle: 9 });
        let bytes = bytes_of(&paint);
        assert_eq!(bytes.len(), 3 * 2 * 9 * 4);
        assert_eq!(paint_of(3, 2, &bytes), Some(paint));
        assert_eq!(paint_of(2, 2, &bytes), None);
        assert_eq!(paint_of(3, 2, &bytes[1..]), None);
        assert_eq!(paint_of(usize::MAX, 2, &bytes), None);
    }
}
