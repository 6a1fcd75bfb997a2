//! Controls that the window shows now, as a screen reader finds them.

use std::path::Path;

use eframe::egui::accesskit::{Action, Role};
use eframe::egui::{Pos2, Rect};
use egui_kittest::kittest::NodeT;

use crate::harness::Window;

/// Something with a name that can be clicked, dragged or typed into.
#[derive(Debug, Clone)]
pub(super) struct Control {
    pub(super) name: String,
    pub(super) role: Role,
    pub(super) rect: Rect,
}

impl Control {
    /// Whether text can be typed into it.
    pub(super) fn takes_text(&self) -> bool {
        matches!(self.role, Role::TextInput | Role::MultilineTextInput | Role::SpinButton)
    }

    /// Its middle.
    pub(super) fn middle(&self) -> Pos2 {
        self.rect.center()
    }
}

/// All controls whose middle is in the window.
pub(super) fn controls(window: &mut Window) -> Vec<Control> {
    let whole = window.whole();
    let root = window.harness().root();
    let mut found = Vec::new();
    for node in root.children_recursive() {
        let inner = node.accesskit_node();
        let touched = inner.data().supports_action(Action::Click) || inner.role() == Role::Slider;
        let Some(name) = inner.label().or_else(|| inner.value()) else { continue };
        let rect = node.rect();
        if touched && !inner.is_disabled() && whole.contains(rect.center()) {
            found.push(Control { name, role: inner.role(), rect });
        }
    }
    found
}

/// Whether a dialog lists a folder that is not below `home`.
pub(super) fn lists_elsewhere(window: &mut Window, home: &Path) -> bool {
    let root = window.harness().root();
    root.children_recursive().any(|node| {
        let inner = node.accesskit_node();
        let is_folder =
            inner.role() == Role::TextInput && inner.label().as_deref() == Some("Folder");
        is_folder && !inner.value().is_some_and(|folder| Path::new(&folder).starts_with(home))
    })
}

/// Cells of the canvas that the dialog of a new painting would begin, if it is open, in millions.
pub(super) fn million_new_cells(window: &mut Window) -> Option<f64> {
    let root = window.harness().root();
    root.children_recursive().find_map(|node| {
        let words = node.accesskit_node().label().or_else(|| node.accesskit_node().value())?;
        words.split_once(" cells, ")?.1.strip_suffix(" million")?.parse().ok()
    })
}
