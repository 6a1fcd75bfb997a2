//! Conversion of quanta to 32-bit floats in mm and back.

use crate::amount::QUANTA_PER_CELL;

/// Least amount, in quanta, at which a float in mm no longer distinguishes neighbouring
/// quanta: its rounding, 2^-24 of the value, reaches half a quantum.
pub(super) const INEXACT_FROM: u32 = 1 << 23;

/// Conversion for cells of one size.
#[derive(Debug, Clone, Copy)]
pub(super) struct Millimetres {
    quantum_mm: f64,
}

impl Millimetres {
    pub(super) fn new(cell_mm: f64) -> Self {
        Self { quantum_mm: cell_mm / f64::from(QUANTA_PER_CELL) }
    }

    /// Height in mm, rounded to a float.
    pub(super) fn mm(self, quanta: f64) -> f32 {
        (quanta * self.quantum_mm) as f32
    }

    /// Rounding residue of [`Self::mm`], in mm.
    pub(super) fn residue(self, quanta: f64) -> f32 {
        let exact = quanta * self.quantum_mm;
        (exact - f64::from(exact as f32)) as f32
    }

    /// Nearest whole number of quanta, as f64.
    pub(super) fn quanta(self, mm: f32, residue: f32) -> f64 {
        ((f64::from(mm) + f64::from(residue)) / self.quantum_mm).round()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amount::MAX_COLUMN;

    #[test]
    fn quanta_come_back_without_residue_below_the_limit_and_with_it_above() {
        for cell_mm in [0.1, 0.25, 0.0317, 1.0] {
            let scale = Millimetres::new(cell_mm);
            let back = |q: f64| scale.quanta(scale.mm(q), 0.0);
            let near = (0..1000)
                .flat_map(|i| [i, INEXACT_FROM - 1 - i, i.wrapping_mul(8_388_593) % INEXACT_FROM]);
            for quanta in near.map(f64::from) {
                assert_eq!(back(quanta), quanta, "{cell_mm}");
                assert_eq!(back(-quanta), -quanta, "{cell_mm}");
            }
            let high = (0..100_000_u32).map(|i| MAX_COLUMN - i * 10_737);
            for quanta in high.filter(|q| *q >= INEXACT_FROM).map(f64::from) {
                let residue = scale.residue(quanta);
                assert_eq!(scale.quanta(scale.mm(quanta), residue), quanta, "{cell_mm}");
            }
        }
    }

    #[test]
    fn a_float_alone_would_lose_quanta_of_thick_paint() {
        let scale = Millimetres::new(0.1);
        // With cells of 0.1 mm, floats become coarser than a quantum at 0.5 mm; with other
        // cells this may already happen at `INEXACT_FROM`.
        let thick = 3 * INEXACT_FROM / 2;
        let lost =
            (thick..thick + 1000).map(f64::from).filter(|&q| scale.quanta(scale.mm(q), 0.0) != q);
        assert!(lost.count() > 0, "no residue channel would be needed");
    }
}
