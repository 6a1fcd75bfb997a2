//! The paint of a tile kept for undo, without the pigments that it does not have: a stroke rarely
//! meets more than two or three of eight.

use crate::layer::{Cell, Layer, SLOTS};

/// Paint of a tile, one list of amounts for each slot and, last, for the vehicle; a list without
/// paint is left out.
#[derive(Debug, Clone)]
pub(super) struct SavedTile {
    width: usize,
    height: usize,
    amounts: [Option<Box<[u32]>>; SLOTS + 1],
}

impl SavedTile {
    /// Keeps the paint of a tile.
    pub(super) fn of(paint: &Layer) -> Self {
        let totals = paint.totals();
        let amounts = std::array::from_fn(|slot| {
            (totals[slot] > 0).then(|| match slot {
                SLOTS => paint.vehicle.values().into(),
                _ => paint.pigments.values().iter().map(|cell| cell[slot]).collect(),
            })
        });
        Self { width: paint.width(), height: paint.height(), amounts }
    }

    /// Columns and rows of cells.
    pub(super) fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// The paint in the cell with this index, counted row by row.
    pub(super) fn cell(&self, index: usize) -> Cell {
        let amount = |slot: usize| self.amounts[slot].as_ref().map_or(0, |list| list[index]);
        Cell { pigments: std::array::from_fn(amount), vehicle: amount(SLOTS) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_saved_tile_has_every_amount_and_no_list_without_paint() {
        let mut paint = Layer::empty(5, 3);
        for index in 0..15 {
            let mut cell = Cell { vehicle: index as u32, ..Cell::default() };
            cell.pigments[2] = 7 * index as u32;
            cell.pigments[7] = u32::from(index == 14);
            paint.set_cell(index, cell);
        }
        let saved = SavedTile::of(&paint);
        assert_eq!(saved.size(), (5, 3));
        for index in 0..15 {
            assert_eq!(saved.cell(index), paint.cell(index), "cell {index}");
        }
        let lists = saved.amounts.iter().filter(|list| list.is_some()).count();
        assert_eq!(lists, 3, "two pigments and the vehicle");
    }
}
