//! Opens the quick palette and carries out what was chosen in it.

use eframe::egui::{Context, Popup, Pos2};

use super::intent::Intent;
use super::quick::{QuickAnswer, QuickChoice, QuickPalette, quick_choices};
use super::studio::Studio;
use crate::keymap;
use crate::panels::{Mode, tubes};

impl Studio {
    /// Opens the quick palette at the pointer, or in the middle of the canvas if the pointer is over
    /// no surface; closes it if it is open. Never opens over a dialog or during a stroke.
    pub(super) fn toggle_quick_palette(&mut self, context: &Context) {
        if self.quick.take().is_some() {
            return;
        }
        let pointer = context.input(|input| input.pointer.hover_pos());
        let over = |point: &Pos2| {
            self.visible_surfaces().into_iter().any(|one| self.view(one).rect().contains(*point))
        };
        let point = pointer.filter(over).unwrap_or_else(|| self.canvas.rect().center());
        self.open_quick_palette(context, point, false);
    }

    /// Opens the quick palette around a point, unless something else has the painter's attention.
    pub(super) fn open_quick_palette(&mut self, context: &Context, point: Pos2, by_button: bool) {
        let Some(painting) = self.painting.clone() else { return };
        let busy = self.files.has_dialog()
            || self.visible.keys
            || painting.stroke_open
            || context.input(|input| input.pointer.primary_down())
            || context.memory(|memory| memory.top_modal_layer().is_some());
        if busy {
            return;
        }
        Popup::close_all(context);
        let choices = quick_choices(&painting, &self.tools, self.files.swatches());
        let brush = painting.brushes.iter().find(|brush| brush.name == self.tools.brush);
        let held = brush.and_then(|brush| brush.color);
        self.quick = Some(QuickPalette::at(context, point, by_button, choices, held));
        context.request_repaint();
    }

    /// Draws the quick palette if it is open, and carries out the answer.
    pub(super) fn show_quick_palette(&mut self, context: &Context) {
        let Some(quick) = &self.quick else { return };
        let Some(answer) =
            quick.show(context, &keymap::keys(context, &Intent::QuickPalette.name()))
        else {
            return;
        };
        self.quick = None;
        if let QuickAnswer::Chosen(choice) = answer {
            self.with_panels(|panels, cx| match choice {
                QuickChoice::Tube { slot, .. } => {
                    cx.tools.tube = slot;
                    tubes::load(cx, slot);
                }
                QuickChoice::Mixture { recipe, vehicle, .. } => cx.load(recipe, vehicle),
                QuickChoice::Size(size_mm) => {
                    panels.brushes.set_size(size_mm, cx);
                    cx.tools.mode = Mode::Paint;
                }
            });
        }
    }
}
