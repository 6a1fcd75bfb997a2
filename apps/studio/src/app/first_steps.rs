//! The first steps: a few lines where the hand is, until the first stroke.

use eframe::egui::{Context, Pos2, Rect, Ui, pos2};

use super::callout::{Arrow, plate};
use super::intent::Intent;
use super::places::{self, Part};
use super::studio::Studio;
use crate::files::bottom_of_notices;
use crate::keymap::text;
use crate::language::{tr, tr_format};

/// Lines over the canvas, with the keys in use.
fn canvas_lines(context: &Context) -> [String; 3] {
    let dry = by_key(context, Intent::Dry, tr("Edit, Dry"));
    [
        tr("Press here and draw, with a pen, a mouse or a finger.").to_owned(),
        tr_format!("Alt + click tells a colour. {dry} dries the paint, to paint over it.", dry),
        tr("File, Sample painting opens one to try; Help, Guided tour shows more.").to_owned(),
    ]
}

/// Lines over the palette, with the keys in use.
fn palette_lines(context: &Context) -> [String; 2] {
    let wash = by_key(context, Intent::Wash, tr("Edit, Wash the brush"));
    [tr("Mix here with the brush.").to_owned(), tr_format!("{wash} washes it.", wash)]
}

/// The key of an intent, or its place in the menus if it has none.
fn by_key(context: &Context, intent: Intent, menu: &str) -> String {
    text(context, &intent.name()).filter(|key| !key.is_empty()).unwrap_or_else(|| menu.to_owned())
}

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
        // Messages stand at the top of the window, and would cover the lines.
        let covered = bottom_of_notices(ui.ctx()).unwrap_or(f32::MIN);
        let top = canvas.top().max(covered) + 14.0;
        let lines = canvas_lines(ui.ctx());
        plate(painter, pos2(canvas.center().x, top), Arrow::None, width, &lines);
        if !self.visible.palette || !self.visible.panels {
            return;
        }
        let above = |part: Rect| pos2(part.center().x, part.top());
        let palette = self.palette.rect();
        let mixing = palette_lines(ui.ctx());
        let mut arrows: Vec<(Pos2, f32, &[String])> =
            vec![(above(palette), palette.width(), &mixing)];
        let filling = TUBES.map(|line| tr(line).to_owned());
        if let Some(tubes) = places::rect(ui.ctx(), Part::Tubes) {
            arrows.push((above(tubes), tubes.width(), &filling));
        }
        for (tip, width, lines) in arrows {
            plate(painter, tip, Arrow::Down, width.min(WIDTH), lines);
        }
    }
}
