//! The window's set-up as data: gathered for autosaves, and applied after a recovery.

use super::studio::Studio;
use crate::files::{Desk, DeskReference, DeskView, ReferenceChange};
use crate::panels::Mode;
use crate::view::ViewState;

impl Studio {
    /// How the window is set up now.
    #[must_use]
    pub fn desk(&self) -> Desk {
        let ViewState { centre, zoom, rotation, mirror, fitted } = self.canvas.view;
        let reference = self.panels.reference.pinned();
        Desk {
            brush: Some(self.tools.brush.clone()),
            tool: Some(self.tools.mode.name().to_owned()),
            view: Some(DeskView { centre, zoom, rotation, mirror, fitted }),
            aids: Some(self.aids),
            reference: reference.map(|(path, drawings)| DeskReference::new(path, &drawings)),
        }
    }

    /// Sets the window up as `desk` says. What the painting does not have is left as it is.
    pub fn set_up(&mut self, desk: &Desk, context: &eframe::egui::Context) {
        let brushes = self.painting.iter().flat_map(|painting| &painting.brushes);
        let brush = brushes.map(|brush| &brush.name).find(|name| desk.brush.as_ref() == Some(name));
        if let Some(brush) = brush {
            self.tools.brush = brush.clone();
        }
        if let Some(mode) = desk.tool.as_deref().and_then(Mode::named) {
            self.tools.mode = mode;
        }
        if let Some(DeskView { centre, zoom, rotation, mirror, fitted }) = desk.view {
            self.canvas.view = ViewState { centre, zoom, rotation, mirror, fitted };
        }
        self.aids = desk.aids.unwrap_or(self.aids);
        if let Some(reference) = &desk.reference {
            let picture = reference.picture.clone();
            let drawings = reference.drawn();
            let restored = ReferenceChange::Restore { picture, drawings };
            if let Some(problem) = self.panels.reference.apply(restored, context) {
                self.files.report(problem);
            }
        }
    }
}
