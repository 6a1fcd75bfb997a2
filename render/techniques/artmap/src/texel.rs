//! Paint of texels, and the pigments that it is made of.

use std::sync::Arc;

use paint::layer::{SLOTS, Slots};
use pigment::library::PigmentLibrary;

/// Paint in one texel, in mm of height.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TexelPaint {
    /// Paint of each pigment, by slot of [`PaintOfSamples::slots`].
    pub pigments_mm: [f32; SLOTS],
    /// Transparent vehicle.
    pub vehicle_mm: f32,
}

/// Pigments that the samples of a set, or the tiles of a map, were painted with.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintOfSamples {
    /// Library of the pigments.
    pub library: Arc<PigmentLibrary>,
    /// Pigments of the samples by slot.
    pub slots: Slots,
}

impl PaintOfSamples {
    /// Names of the pigments, in the order of their slots.
    #[must_use]
    pub fn pigment_names(&self) -> Vec<String> {
        let used = self.slots.iter().flatten();
        used.map(|&pigment| self.library[pigment].name.clone()).collect()
    }
}
