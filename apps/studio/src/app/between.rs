//! Changes by a stroke of a stylus between two frames of the window: paint, and the head over it.
//!
//! A page in a browser shows it by itself, as its frames take long where there is no graphics card.

use web_time::{Duration, Instant};

use eframe::egui::{Context, Order, Rect};
use paint::strokes::SurfaceId;

use super::studio::Studio;
use crate::language::speak;
use crate::pace;
use crate::view::{HeadLines, Patch};

/// Least time between two frames of the whole window during such a stroke; the panels' figures change
/// as often.
const RARE: Duration = Duration::from_millis(500);

/// The time instead of [`RARE`] while the paint is behind the pen.
const RARE_BEHIND: Duration = Duration::from_millis(1500);

/// The part of the window that a stroke has changed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Between {
    /// Its pixels without the head; without extent if nothing changed.
    pub patch: Patch,
    /// The head over them, which lies within them.
    pub head: HeadLines,
}

impl Studio {
    /// Passes on what the stylus reported, without waiting for a frame. Returns whether its stroke is
    /// one that [`Studio::between`] shows; if not, nothing is done, and a frame is needed.
    pub fn take_stylus(&mut self, context: &Context) -> bool {
        let shown = self.is_shown_between(context);
        if shown {
            speak(self.files.preferences.language);
            let mode = self.keys.mode(self.tools.mode);
            self.update_pen(context, &[], mode);
            self.send_requests();
        }
        shown
    }

    /// Changes by the open stroke since the last call or frame. `None` if a frame of the whole window
    /// must show them; such a frame is asked for if there was none for a while. Must not be called
    /// during a frame.
    pub fn between(&mut self, context: &Context) -> Option<Between> {
        if !self.take_stylus(context) {
            self.end_between(context);
            return None;
        }
        self.handle_events();
        let rare = if self.figures.paint_is_behind { RARE_BEHIND } else { RARE };
        pace::set_rare(context, Some(rare));
        let canvas = self.head.as_deref().filter(|head| head.surface == SurfaceId::Canvas);
        let head = canvas.map(|head| self.canvas.head_lines(head, self.head_paint()));
        let head = head.unwrap_or_default();
        let rect = head.bounds();
        let fresh = self.canvas.take_fresh();
        if fresh.is_none() && rect == self.head_rect {
            return Some(Between::default());
        }
        let before = std::mem::replace(&mut self.head_rect, rect);
        let parts = [fresh, before, rect].into_iter().flatten();
        let region = parts.fold(Rect::NOTHING, |all, part| all.union(part));
        if is_covered(context, region) {
            self.end_between(context);
            return None;
        }
        self.frames.begin(Instant::now(), None);
        Some(Between { patch: self.canvas.patch(region), head })
    }

    /// Whether the open stroke changes nothing but paint and head on the canvas.
    fn is_shown_between(&self, context: &Context) -> bool {
        let one_light = self
            .painting
            .as_ref()
            .is_some_and(|painting| painting.second_lighting.is_none() && painting.mask.is_none());
        let aided = self.aids.guide.is_some() || self.aids.symmetry.on;
        self.pen.stylus_on() == Some(SurfaceId::Canvas)
            && one_light
            && !aided
            && !self.tools.figures
            && !self.shows_volumes
            && !self.is_framing()
            && self.quick.is_none()
            && !self.panels.reference.is_over_canvas()
            && self.pen.string_line().is_none()
            && !self.files.has_dialog()
            && !self.shows_sheet(context)
    }

    /// Lets frames be as frequent as ever.
    fn end_between(&self, context: &Context) {
        if pace::set_rare(context, None) {
            context.request_repaint();
        }
    }
}

/// Whether a floating window or a message lies over a part of the window.
fn is_covered(context: &Context, region: Rect) -> bool {
    context.memory(|memory| {
        memory.areas().visible_layer_ids().iter().any(|layer| {
            let rect = memory.area_rect(layer.id).unwrap_or(Rect::NOTHING);
            layer.order != Order::Background && rect.height() > 1.0 && rect.intersects(region)
        })
    })
}
