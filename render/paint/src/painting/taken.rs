//! Paint that a stroke took off its surface.

use crate::amount::mm_from_quanta;
use crate::layer::{Layer, SLOTS};

/// Paint that a tool took off a surface: what went onto the clean head and was wiped off it. It is
/// exactly what the surface has lost. None for a stroke that paints.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TakenPaint {
    /// Quanta of each slot and, last, of the vehicle, summed over cells; see [`crate::amount`].
    pub quanta: [u64; SLOTS + 1],
}

impl TakenPaint {
    /// Volume in mm3 of each slot and, last, of the vehicle, on cells of `cell_mm` mm.
    #[must_use]
    pub fn volumes_mm3(&self, cell_mm: f64) -> [f64; SLOTS + 1] {
        let mm3 = mm_from_quanta(1, cell_mm) * cell_mm * cell_mm;
        self.quanta.map(|quanta| quanta as f64 * mm3)
    }

    /// Volume in mm3 of all of it, on cells of `cell_mm` mm.
    #[must_use]
    pub fn volume_mm3(&self, cell_mm: f64) -> f64 {
        self.volumes_mm3(cell_mm).iter().sum()
    }

    /// Adds the paint of a head.
    pub(super) fn add(&mut self, paint: &Layer) {
        for (sum, more) in self.quanta.iter_mut().zip(paint.totals()) {
            *sum += more;
        }
    }
}
