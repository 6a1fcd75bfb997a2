//! The command that goes on with a drawing, to be copied.

use eframe::egui::{Label, RichText, Ui};

use super::super::controls::named_button;
use crate::language::tr;

/// Draws a command with a button that copies it; `tip` tells what it does.
pub(super) fn next_step(ui: &mut Ui, tip: &str, command: &str) {
    ui.horizontal(|ui| {
        if named_button(ui, tr("Copy"), tr("Copy command"), tr("Copies the command"), None) {
            ui.ctx().copy_text(command.to_owned());
        }
        let text = RichText::new(command).monospace().size(11.0);
        ui.add(Label::new(text).truncate()).on_hover_text(format!("{tip}: {command}"));
    });
}
