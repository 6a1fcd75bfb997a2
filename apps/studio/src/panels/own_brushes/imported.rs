//! The list of settings of a brush of MyPaint, with what became of each.

use eframe::egui::{CollapsingHeader, ScrollArea, Ui};
use session::brushes::ImportedBrush;

use crate::language::tr_format;

/// Lists the settings that were taken over, and those without a meaning here.
pub(super) fn show(ui: &mut Ui, imported: &ImportedBrush) {
    let title = tr_format!("Taken over from MyPaint: {name}", name = imported.preset.name);
    CollapsingHeader::new(title).id_salt("imported").default_open(true).show(ui, |ui| {
        ScrollArea::vertical().max_height(160.0).auto_shrink([false, true]).show(ui, |ui| {
            for line in &imported.taken {
                ui.label(line);
            }
            if !imported.meaningless.is_empty() {
                ui.weak(tr_format!(
                    "has no meaning here: {names}",
                    names = imported.meaningless.join(", ")
                ));
            }
        });
    });
}
