//! How much paint lies at the tip of a brush, or on the edge of a blade.

use crate::amount::mm_from_quanta;
use crate::layer::{Layer, SLOTS};

/// The last 1 / `TIP` of the head counts as its tip: about as much as lies on the canvas at middle
/// pressure.
const TIP: usize = 3;

/// Paint at the tip of a brush: the third of the head that lies on the canvas, all around.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipLoad {
    /// Mean height of each slot and, last, of the vehicle, in mm.
    pub amounts_mm: [f64; SLOTS + 1],
}

impl TipLoad {
    /// The tip of a head. `paint` covers the whole head, but only its last `rows` rows hold paint.
    /// Cells of the canvas are `cell_mm` mm wide. `paint_cell_area` is the area of a cell of the
    /// head, in cells of the canvas.
    #[must_use]
    pub fn of(paint: &Layer, rows: usize, cell_mm: f64, paint_cell_area: f64) -> Self {
        let width = paint.width();
        let height = paint.height();
        let rows = rows.min(height.div_ceil(TIP));
        let mut quanta = [0_u64; SLOTS + 1];
        for index in (height - rows) * width..height * width {
            let cell = paint.cell(index);
            let slots = cell.pigments.iter().chain([&cell.vehicle]);
            for (sum, &found) in quanta.iter_mut().zip(slots) {
                *sum += u64::from(found);
            }
        }
        let area = (rows * width).max(1) as f64 * paint_cell_area;
        let mm = mm_from_quanta(1, cell_mm) / area;
        Self { amounts_mm: quanta.map(|sum| sum as f64 * mm) }
    }

    /// Mean height of all paint at the tip, in mm.
    #[must_use]
    pub fn thickness_mm(&self) -> f64 {
        self.amounts_mm.iter().sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amount::quanta_from_mm;
    use crate::layer::Cell;

    #[test]
    fn the_last_third_of_the_rows_counts() {
        let mut paint = Layer::empty(6, 9);
        for index in 0..54 {
            paint.set_cell(index, if index < 36 { cell(0, 1.0) } else { cell(1, 0.2) });
        }
        // Half of one of the three rows is dry.
        for index in 36..39 {
            paint.set_cell(index, Cell::default());
        }
        let tip = TipLoad::of(&paint, 9, 0.1, 1.0);
        assert_eq!(tip.amounts_mm[0], 0.0);
        assert!((tip.thickness_mm() - 0.2 * 15.0 / 18.0).abs() < 1e-6, "{tip:?}");
        let spread = TipLoad::of(&paint, 9, 0.1, 1.25);
        assert!((spread.thickness_mm() * 1.25 - tip.thickness_mm()).abs() < 1e-9, "{spread:?}");
        assert_eq!(TipLoad::of(&Layer::empty(3, 1), 1, 0.1, 1.0).thickness_mm(), 0.0);
    }

    fn cell(slot: usize, mm: f64) -> Cell {
        let mut cell = Cell::default();
        cell.pigments[slot] = quanta_from_mm(mm, 0.1);
        cell
    }
}
