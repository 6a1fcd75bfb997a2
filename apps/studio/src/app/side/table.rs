//! Table of the panels in the columns. A new panel is one line here, and its [`Tab`].

use eframe::egui::Ui;

use super::panels::{Panels, Tab};
use crate::arrangement::Arrangement;
use crate::files::Files;
use crate::panels::{PanelContext, revisions};

/// Draws a panel.
type Show = fn(&mut Panels, &mut Ui, &mut PanelContext<'_>, &Files);

/// A panel of the columns.
pub(super) struct SidePanel {
    pub(super) tab: Tab,
    /// Name in the preferences, which never changes.
    pub(super) key: &'static str,
    /// Name on the tab.
    pub(super) name: &'static str,
    pub(super) description: &'static str,
    /// Index of its group in the standard layout.
    group: usize,
    pub(super) show: Show,
}

const fn panel(
    (tab, group): (Tab, usize),
    key: &'static str,
    (name, description): (&'static str, &'static str),
    show: Show,
) -> SidePanel {
    SidePanel { tab, key, name, description, group, show }
}

/// All panels. Those of the first group are needed while painting, those of the second are
/// looked at occasionally.
#[rustfmt::skip]
pub(super) const PANELS: [SidePanel; 8] = [
    panel((Tab::Brush, 0), "brush", ("Brush", "List of brushes, head and paint of the selected brush"), |panels, ui, cx, _| panels.brushes.show(ui, cx)),
    panel((Tab::Layers, 0), "layers", ("Layers", "Wet and dry paint"), |panels, ui, cx, _| panels.layers.show(ui, cx)),
    panel((Tab::Light, 1), "light", ("Light", "The light, the gloss, and a second light to compare"), |panels, ui, cx, _| panels.light.show(ui, cx)),
    panel((Tab::Color, 1), "colour", ("Colour", "Colour and paint picked by the eyedropper, and recipes for a colour"), |panels, ui, cx, _| panels.eyedropper.show(ui, cx)),
    panel((Tab::Wheel, 1), "wheel", ("Wheel", "Colours that the tubes on the palette can mix, and recipes for them"), |panels, ui, cx, _| panels.wheel.show(ui, cx, panels.eyedropper.target())),
    panel((Tab::Swatches, 1), "swatches", ("Swatches", "Mixtures that are kept"), |panels, ui, cx, files| panels.swatches.show(ui, cx, files.swatches())),
    panel((Tab::History, 1), "history", ("History", "List of actions, to undo and redo"), |panels, ui, cx, _| panels.history.show(ui, cx)),
    panel((Tab::Files, 1), "files", ("Files", "Numbered revisions of the painting"), |_, ui, cx, files| revisions::show(ui, cx, &files.revisions)),
];

impl SidePanel {
    /// Whether all of it should be seen, because it is needed while painting.
    pub(super) fn is_whole(&self) -> bool {
        self.group == 0
    }

    /// The panel of a tab.
    pub(super) fn of(tab: Tab) -> Option<&'static Self> {
        PANELS.iter().find(|panel| panel.tab == tab)
    }

    /// The panel with a key.
    pub(super) fn with_key(key: &str) -> Option<&'static Self> {
        PANELS.iter().find(|panel| panel.key == key)
    }
}

impl Tab {
    /// Name on the tab.
    #[must_use]
    pub fn name(self) -> &'static str {
        SidePanel::of(self).map_or("", |panel| panel.name)
    }
}

/// The standard layout: two groups at the right.
pub(super) fn standard() -> Arrangement {
    let keys = |group: usize| -> Vec<&str> {
        PANELS.iter().filter(|panel| panel.group == group).map(|panel| panel.key).collect()
    };
    let groups: Vec<Vec<&str>> = (0..).map(keys).take_while(|keys| !keys.is_empty()).collect();
    let groups: Vec<&[&str]> = groups.iter().map(Vec::as_slice).collect();
    Arrangement::in_right_column(&groups)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_panel_has_its_own_key_and_a_place_in_the_standard_layout() {
        let standard = standard();
        for panel in &PANELS {
            assert!(standard.position(panel.key).is_some(), "{} has no place", panel.name);
            assert_eq!(SidePanel::with_key(panel.key).map(|found| found.tab), Some(panel.tab));
            assert_eq!(SidePanel::of(panel.tab).map(|found| found.key), Some(panel.key));
        }
    }
}
