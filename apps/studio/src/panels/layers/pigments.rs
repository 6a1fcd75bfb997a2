//! Patches of the pigments of a layer.

use eframe::egui::{Sense, Ui, vec2};
use paint::document::Slots;

use crate::panels::controls::patch;
use crate::panels::pigments::Catalogue;

/// Draws a patch of each pigment's masstone.
pub(super) fn pigments(ui: &mut Ui, catalogue: &Catalogue, slots: &Slots) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for &pigment in slots.iter().flatten() {
            let (rect, response) = ui.allocate_exact_size(vec2(13.0, 13.0), Sense::hover());
            patch(ui.painter(), rect.shrink(1.0), Some(catalogue.colors(pigment).masstone_srgb));
            response.on_hover_text(catalogue.name(pigment));
        }
    });
}
