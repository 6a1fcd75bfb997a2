//! The row of the dialog for presets.

use eframe::egui::{Button, ComboBox, Ui};

use super::dialog::NewDialog;
use crate::files::new_canvas::KeptCanvases;
use crate::language::tr;
use crate::theme;

impl NewDialog {
    /// Adds the choice of a preset, and keeping and removing one.
    pub(super) fn preset_row(&mut self, ui: &mut Ui, kept: &mut KeptCanvases) {
        let chosen = kept.preset(&self.preset).is_some();
        let shown = if chosen { self.preset.as_str() } else { tr("Presets") };
        let mut wanted = None;
        ui.add_enabled_ui(!kept.presets.is_empty(), |ui| {
            let combo = ComboBox::from_id_salt("presets").selected_text(shown).width(150.0);
            let combo = combo.show_ui(ui, |ui| {
                for preset in &kept.presets {
                    let own = preset.name == self.preset;
                    if ui.selectable_label(own, &preset.name).clicked() {
                        wanted = Some(preset.clone());
                    }
                }
            });
            combo
                .response
                .accessible_name(tr("Presets"))
                .on_hover_text(tr("Canvases kept under a name"));
        });
        if let Some(preset) = wanted {
            (self.preset, self.new) = (preset.name, preset.canvas);
        }
        let edit = theme::text_field(&mut self.preset).hint_text(tr("Name")).desired_width(120.0);
        let edit = ui.add(edit).accessible_name(tr("Name of the preset"));
        edit.on_hover_text(tr("Name under which these settings are kept"));
        let named = !self.preset.trim().is_empty();
        let keep = ui.add_enabled(named, Button::new(tr("Keep")));
        if keep.on_hover_text(tr("Keeps these settings under the name")).clicked() {
            self.preset = self.preset.trim().to_owned();
            kept.keep(&self.preset, self.new.clone());
        }
        let remove = ui.add_enabled(chosen, Button::new(tr("Remove preset")));
        if remove.on_hover_text(tr("Removes the preset of this name")).clicked() {
            kept.remove(&self.preset);
            self.preset.clear();
        }
    }
}
