//! A layer of paint made of amounts in mm.

use graphics::field::Field;
use paint::amount::quanta_from_mm;
use paint::layer::{Layer, SLOTS};
use rayon::prelude::*;

use super::paint_tones::Amounts;

/// Cells that share the work of one thread at least.
const CELLS: usize = 4096;

/// The layer with the amounts of each cell, rounded to whole quanta. Cells are `cell_mm` wide.
#[must_use]
pub fn paint_layer(amounts: &Field<Amounts>, cell_mm: f64) -> Layer {
    let width = amounts.width();
    let height = amounts.height();
    let mut layer = Layer::empty(width, height);
    let cells = layer.pigments.values_mut().par_iter_mut().zip(layer.vehicle.values_mut());
    let laid = cells.zip(amounts.values()).with_min_len(CELLS);
    laid.for_each(|((pigments, vehicle), amounts)| {
        // Most slots of most cells are empty.
        let quanta = |mm: f32| if mm > 0.0 { quanta_from_mm(f64::from(mm), cell_mm) } else { 0 };
        *pigments = std::array::from_fn(|slot| quanta(amounts[slot]));
        *vehicle = quanta(amounts[SLOTS]);
    });
    layer
}

#[cfg(test)]
mod tests {
    use paint::amount::mm_from_quanta;
    use paint::layer::Cell;

    use super::*;

    #[test]
    fn cells_have_the_nearest_whole_quanta_of_their_amounts() {
        let amounts = Field::from_values(
            7,
            3,
            (0..21)
                .map(|at: usize| std::array::from_fn(|slot| 0.001 * (at * slot) as f32 - 0.002))
                .collect(),
        );
        let layer = paint_layer(&amounts, 0.2);
        for (index, amounts) in amounts.values().iter().enumerate() {
            let Cell { pigments, vehicle } = layer.cell(index);
            let all = pigments.into_iter().chain([vehicle]).zip(amounts);
            for (quanta, mm) in all {
                let found = mm_from_quanta(quanta, 0.2);
                let wanted = f64::from(mm.max(0.0));
                let half = 0.5001 * mm_from_quanta(1, 0.2);
                assert!((found - wanted).abs() <= half, "{found} {wanted}");
            }
        }
        assert!(layer.cell(20).vehicle > 0 && layer.cell(20).pigments[7] > 0);
    }
}
