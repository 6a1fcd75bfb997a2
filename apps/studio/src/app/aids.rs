//! Draws the drawing aids over the canvas, and lets their handles be dragged.

use eframe::egui::{
    Color32, CursorIcon, Id, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo,
};

use super::studio::Studio;
use crate::language::tr;
use crate::panels::aids;
use crate::pen::{AidHandle, AidLines, DrawingAids, GuideKind};
use crate::theme;
use crate::view::Placement;
use session::PaintingState;

/// Diameter of a handle, in points.
const HANDLE: f32 = 14.0;

/// Distance of a handle from the edge of the view beyond which its place is, in points.
const EDGE: f32 = 12.0;

/// The canvas on the screen.
#[derive(Debug, Clone, Copy)]
struct OnCanvas {
    placement: Placement,
    cell_mm: f64,
    /// The part of the window that shows it.
    view: Rect,
}

impl OnCanvas {
    fn point(&self, mm: [f64; 2]) -> Pos2 {
        self.placement.point(mm.map(|mm| mm / self.cell_mm))
    }

    fn mm(&self, point: Pos2) -> [f64; 2] {
        self.placement.cell(point).map(|cells| cells * self.cell_mm)
    }

    /// Rectangle in which a handle is touched: at the edge of the view if its place is beyond.
    fn handle(&self, place: [f64; 2], size: Vec2) -> Rect {
        let room = self.view.shrink(EDGE);
        let point = self.point(place);
        Rect::from_center_size(if room.is_positive() { room.clamp(point) } else { point }, size)
    }
}

impl Studio {
    /// Width and height of the canvas in mm.
    fn canvas_mm(painting: &PaintingState) -> [f64; 2] {
        let (columns, rows) = painting.canvas_cells;
        [columns, rows].map(|cells| cells as f64 * painting.cell_mm)
    }

    /// Shows or takes away a guide, and says so.
    pub(super) fn toggle_guide(&mut self, kind: GuideKind) {
        self.aids.toggle(kind);
        let text = match (kind, self.aids.guide.is_some(), self.aids.snaps) {
            (GuideKind::Ruler, false, _) => tr("the ruler is off"),
            (GuideKind::Ruler, true, true) => tr("strokes follow the ruler"),
            (GuideKind::Ruler, true, false) => tr("the ruler is shown"),
            (GuideKind::Perspective, false, _) => tr("the perspective guide is off"),
            (GuideKind::Perspective, true, true) => tr("strokes follow the perspective guide"),
            (GuideKind::Perspective, true, false) => tr("the perspective guide is shown"),
        };
        self.say_of_aids(text.to_owned());
    }

    /// Lets strokes follow the guide or not, and says so.
    pub(super) fn toggle_snapping(&mut self) {
        self.aids.snaps ^= true;
        let text = match (self.aids.snaps, self.aids.guide) {
            (true, Some(_)) => tr("strokes follow the guide"),
            (true, None) => tr("strokes follow the guide once one is shown"),
            (false, _) => tr("strokes are free"),
        };
        self.say_of_aids(text.to_owned());
    }

    /// Turns symmetry on or off, and says so.
    pub(super) fn toggle_symmetry(&mut self) {
        self.aids.symmetry.on ^= true;
        let text = match self.aids.symmetry.on {
            true => tr("strokes are repeated by symmetry when they end"),
            false => tr("symmetry is off"),
        };
        self.say_of_aids(text.to_owned());
    }

    fn say_of_aids(&mut self, text: String) {
        let hint = tr("Tools, Drawing aids has handles and settings").to_owned();
        self.show_message(text, Some(hint), false);
    }

    /// Draws the window of the drawing aids, if it is open.
    pub(super) fn draw_aids_window(&mut self, context: &eframe::egui::Context) {
        aids::show(context, &mut self.visible.aids, &mut self.aids);
    }

    /// Draws the aids over the canvas, and their handles while their window is open.
    pub(super) fn draw_aids(&mut self, ui: &Ui) {
        self.aid_handles.clear();
        let Some(painting) = self.painting.clone() else { return };
        self.aids.fit(Self::canvas_mm(&painting));
        let placement = self.canvas.placement();
        let view = self.canvas.rect();
        let on_canvas = OnCanvas { placement, cell_mm: painting.cell_mm, view };
        let painter = ui.painter_at(view);
        draw_lines(&painter, &on_canvas, &self.aids.lines());
        if let Some(twins) = &self.twins {
            twins.draw(&painter, &placement, painting.cell_mm);
        }
        if !self.visible.aids || self.is_framing() {
            return;
        }
        for handle in self.aids.handles() {
            let rect = on_canvas.handle(self.aids.place_of(handle), handle_size(ui));
            self.drag_aid(ui, &on_canvas, handle, rect);
            self.aid_handles.push(rect);
        }
        draw_handles(&painter, ui, &on_canvas, &self.aids);
    }

    fn drag_aid(&mut self, ui: &Ui, on_canvas: &OnCanvas, handle: AidHandle, rect: Rect) {
        let name = handle.name();
        let response = ui.interact(rect, Id::unique(("drawing aid", &name)), Sense::drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
        let place = self.aids.place_of(handle);
        if response.drag_started()
            && let Some(from) = ui.input(|input| input.pointer.press_origin())
        {
            let from = on_canvas.mm(from);
            self.aid_grabbed = [place[0] - from[0], place[1] - from[1]];
        }
        if let Some(point) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            let to = on_canvas.mm(point);
            let [right, down] = self.aid_grabbed;
            self.aids.move_to(handle, [to[0] + right, to[1] + down]);
        }
        response.on_hover_cursor(CursorIcon::Grab).on_hover_text(name);
    }
}

/// Size in which a handle is touched.
fn handle_size(ui: &Ui) -> Vec2 {
    theme::at_least(ui, Vec2::splat(HANDLE + 4.0))
}

/// Draws lines that show on every paint: dark with a light core.
fn draw_lines(painter: &Painter, on_canvas: &OnCanvas, lines: &AidLines) {
    for (lines, dark, light) in [(&lines.faint, 28, 60), (&lines.main, 90, 170)] {
        for line in lines {
            let points: Vec<Pos2> = line.iter().map(|&place| on_canvas.point(place)).collect();
            for (width, color) in
                [(2.5, Color32::from_black_alpha(dark)), (1.0, Color32::from_white_alpha(light))]
            {
                painter.add(Shape::line(points.clone(), Stroke::new(width, color)));
            }
        }
    }
}

fn draw_handles(painter: &Painter, ui: &Ui, on_canvas: &OnCanvas, aids: &DrawingAids) {
    let colors = theme::colors(ui.ctx());
    let edge = Stroke::new(1.0, colors.strong);
    for handle in aids.handles() {
        let at = on_canvas.handle(aids.place_of(handle), Vec2::splat(HANDLE)).center();
        painter.circle_filled(at, 0.5 * HANDLE + 1.0, Color32::from_black_alpha(110));
        painter.circle(at, 0.5 * HANDLE - 1.0, colors.panel, edge);
    }
}
