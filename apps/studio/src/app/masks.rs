//! Draws the mask of the canvas, and the polygon of a new one.

use std::time::Duration;

use eframe::egui::{Color32, CursorIcon, Painter, PointerButton, Pos2, Response, Stroke, Ui, pos2};
use paint::strokes::{Action, MaskChange};

use super::dashes::DASH;
use super::studio::Studio;
use crate::panels::Mode;
use crate::view::Placement;
use session::{Command, MaskState};

/// Distance in points by which the pen moves for another point of a polygon.
const STEP: f32 = 3.0;

/// Width of the outline, in points.
const WIDTH: f32 = 1.2;

/// Most points of a polygon, within the limit of a script.
const MOST_POINTS: usize = 4000;

impl Studio {
    /// Draws the outline of the mask, and takes the points of the polygon that the pen draws in the
    /// mode of masks.
    pub(super) fn draw_mask(&mut self, ui: &Ui, response: &Response, mode: Mode) {
        let Some(painting) = self.painting.clone() else { return };
        let painter = ui.painter_at(self.canvas.rect());
        let placement = self.canvas.placement();
        let (now, happens) = ui.input(|input| (input.time, !input.events.is_empty()));
        let (phase, moves) = self.mask_dashes.phase(now, happens);
        if let Some(mask) = &painting.mask {
            draw_outline(&painter, &placement, mask, phase);
            if moves {
                ui.ctx().request_repaint_after(Duration::from_millis(120));
            }
        }
        if mode != Mode::Mask {
            self.mask_points.clear();
            return;
        }
        self.take_points(ui, response, &placement);
        let points: Vec<Pos2> = self.mask_points.iter().map(|&at| placement.point(at)).collect();
        for pair in points.windows(2) {
            march(&painter, [pair[0], pair[1]], phase);
        }
        if response.drag_stopped_by(PointerButton::Primary) {
            let polygon: Vec<[f64; 2]> = std::mem::take(&mut self.mask_points)
                .into_iter()
                .map(|point| point.map(|cells| cells * painting.cell_mm))
                .collect();
            if polygon.len() >= 3 {
                self.ask(Command::Apply(Action::Mask(MaskChange::PolygonMm(polygon))));
            }
        }
    }

    /// Takes the point under the pointer; with shift, the points are the corners of a rectangle.
    fn take_points(&mut self, ui: &Ui, response: &Response, placement: &Placement) {
        if response.drag_started_by(PointerButton::Primary) {
            let start = ui.input(|input| input.pointer.press_origin());
            self.mask_points = start.map(|start| placement.cell(start)).into_iter().collect();
        }
        let held = response.dragged_by(PointerButton::Primary).then_some(());
        let Some(now) = held.and_then(|()| response.interact_pointer_pos()) else { return };
        let Some(&first) = self.mask_points.first() else { return };
        if ui.input(|input| input.modifiers.shift) {
            let from = placement.point(first);
            let to = now;
            let corners = [from, pos2(to.x, from.y), to, pos2(from.x, to.y), from];
            self.mask_points = corners.map(|corner| placement.cell(corner)).to_vec();
            self.mask_points[0] = first;
        } else if let Some(&last) = self.mask_points.last()
            && placement.point(last).distance(now) >= STEP
            && self.mask_points.len() < MOST_POINTS
        {
            self.mask_points.push(placement.cell(now));
        }
    }

    /// Shows a cross over the canvas.
    pub(super) fn draw_mask_cursor(&self, ui: &Ui) {
        let over = ui.input(|input| input.pointer.hover_pos());
        if over.is_some_and(|point| self.canvas.position(point).is_some()) {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
    }
}

/// Draws the outline of a mask as dashes that have moved by `phase` points.
fn draw_outline(painter: &Painter, placement: &Placement, mask: &MaskState, phase: f32) {
    let seen = painter.clip_rect().expand(2.0);
    for line in &mask.outline {
        let ends = line.map(|(x, y)| placement.point([f64::from(x), f64::from(y)]));
        if seen.intersects(eframe::egui::Rect::from_two_pos(ends[0], ends[1])) {
            march(painter, ends, phase);
        }
    }
}

/// Draws a line in dashes of black and white. Their place depends on the place in the window, so
/// that the dashes of joined lines follow each other.
fn march(painter: &Painter, [from, to]: [Pos2; 2], phase: f32) {
    let way = to - from;
    // The stairs of an outline are shorter than the line is wide: longer ends close their corners.
    let cap = 0.5 * WIDTH * way.normalized();
    let along = |point: Pos2| point.x + point.y + phase;
    let start = along(from);
    let end = along(to);
    let run = end - start;
    if run.abs() < 0.01 {
        painter.line_segment([from, to], Stroke::new(WIDTH, Color32::WHITE));
        return;
    }
    let low = start.min(end);
    let high = start.max(end);
    let mut at = low;
    while at < high - 0.001 {
        let dash = (at / DASH).floor();
        let next = ((dash + 1.0) * DASH).min(high).max(at + 0.01);
        let color = if dash.rem_euclid(2.0) < 0.5 { Color32::BLACK } else { Color32::WHITE };
        let place = |value: f32| from + way * ((value - start) / run);
        painter.line_segment([place(at) - cap, place(next) + cap], Stroke::new(WIDTH, color));
        at = next;
    }
}
