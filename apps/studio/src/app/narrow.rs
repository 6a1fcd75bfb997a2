//! Narrow windows, as on a phone: the panels of both columns lie on a sheet that covers canvas and
//! palette, and is there only while it is asked for.

use eframe::egui::{Context, Id, Rect, Ui, UiBuilder, vec2};

use super::side::Drawn;
use super::studio::Studio;
use crate::arrangement::Side;
use crate::panels::PanelContext;
use crate::theme::is_narrow;

impl Studio {
    /// Whether the sheet of panels covers canvas and palette.
    pub(super) fn shows_sheet(&self, context: &Context) -> bool {
        self.visible.sheet && self.visible.panels && is_narrow(context)
    }

    /// Whether the panels are seen: in their columns, or on the sheet of a narrow window.
    pub(super) fn shows_panels(&self, context: &Context) -> bool {
        if is_narrow(context) { self.shows_sheet(context) } else { self.visible.panels }
    }

    /// Shows the panels, or hides them: in a narrow window those of the sheet alone.
    pub(super) fn toggle_panels(&mut self, context: &Context) {
        if is_narrow(context) && self.visible.panels {
            self.visible.sheet ^= true;
        } else {
            self.visible.panels ^= true;
        }
    }

    /// Draws the panels of both columns into the whole of `ui`, one column below the other.
    pub(super) fn draw_sheet(&mut self, ui: &mut Ui) {
        let Some(painting) = self.painting.clone() else { return };
        let sides = Side::ALL.into_iter().filter(|side| self.panels.has_column(*side));
        let sides: Vec<Side> = sides.collect();
        let whole = ui.available_rect_before_wrap();
        let size = vec2(whole.width(), whole.height() / sides.len().max(1) as f32);
        let mut drawn = Drawn::default();
        for (at, side) in sides.into_iter().enumerate() {
            let top = whole.min + vec2(0.0, at as f32 * size.y);
            let salt = Id::unique(("sheet", at));
            let place = UiBuilder::new().id_salt(salt).max_rect(Rect::from_min_size(top, size));
            let requests = &mut self.requests;
            let mut cx = PanelContext { painting: &painting, tools: &mut self.tools, requests };
            let part = &mut ui.new_child(place);
            self.panels.show(part, side, (&mut cx, &self.files), &mut drawn);
        }
        self.panels.drop_dragged(ui.ctx(), drawn, Rect::NOTHING);
    }
}
