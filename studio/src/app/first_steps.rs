//! The first steps: a few lines where the hand is, until the first stroke.

use eframe::egui::{Pos2, Rect, Ui, pos2};

use super::callout::{Arrow, plate};
use super::places::{self, Part};
use super::studio::Studio;

/// Lines over the canvas.
const CANVAS: [&str; 3] = [
    "Press here and draw, with a pen, a mouse or a finger.",
    "Alt + click tells a colour. D dries the paint, to paint over it.",
    "File, Sample painting opens one to try; Help, Guided tour shows more.",
];

/// Lines over the palette.
const PALETTE: [&str; 2] = ["Mix here with the brush.", "W washes it."];

/// Lines over the tubes.
const TUBES: [&str; 2] =
    ["Double click a tube: its paint is on the brush.", "Click, then click the palette: a heap."];

/// Largest width of the lines over the canvas, in points.
const WIDTH: f32 = 440.0;

impl Studio {
    /// Draws the lines over canvas, palette and tubes. They take no clicks.
    pub(super) fn draw_first_steps(&self, ui: &Ui) {
        let busy = self.tour.is_running() || self.crop.is_some();
        if !self.visible.first_steps || self.painting.is_none() || busy {
            return;
        }
        let painter = ui.painter();
        let canvas = self.canvas.rect();
        let width = WIDTH.min(canvas.width() - 16.0);
        plate(
            painter,
            canvas.center_top() + 14.0 * eframe::egui::Vec2::Y,
            Arrow::None,
            width,
            &CANVAS,
        );
        if !self.visible.palette || !self.visible.panels {
            return;
        }
        let above = |part: Rect| pos2(part.center().x, part.top());
        let palette = self.palette.rect();
        let mut arrows: Vec<(Pos2, f32, &[&str])> =
            vec![(above(palette), palette.width(), &PALETTE)];
        if let Some(tubes) = places::rect(ui.ctx(), Part::Tubes) {
            arrows.push((above(tubes), tubes.width(), &TUBES));
        }
        for (tip, width, lines) in arrows {
            plate(painter, tip, Arrow::Down, width.min(WIDTH), lines);
        }
    }
}
