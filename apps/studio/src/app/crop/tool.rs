//! Draws the crop over the canvas, and lets it be dragged.

use eframe::egui::{
    Button, Color32, ComboBox, Context, CursorIcon, Id, Key, Modifiers, PointerButton, Pos2, Rect,
    Response, RichText, Role, Sense, Shape, Stroke, StrokeKind, Ui, WidgetInfo, vec2,
};
use graphics::tile;

use super::frame::{CropFrame, HANDLES};
use crate::language::{tr, tr_format};
use crate::theme;
use crate::view::{Placement, SurfaceView};

/// Side of a handle as it is drawn, in points. In touch mode it is pressed in a larger square.
const HANDLE: f32 = 14.0;

/// Shapes that are offered: name, and width over height of the longer side over the shorter.
const SHAPES: [(&str, f64); 5] =
    [("1 : 1", 1.0), ("5 : 4", 1.25), ("4 : 3", 4.0 / 3.0), ("3 : 2", 1.5), ("16 : 9", 16.0 / 9.0)];

/// Decision of the painter about a crop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CropAnswer {
    /// Crops to these cells.
    Crop(tile::Rect),
    /// Leaves the painting as it is.
    Leave,
}

/// A crop that is being framed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CropTool {
    frame: CropFrame,
    cells: (usize, usize),
    /// Width over height, if it is kept.
    shape: Option<f64>,
}

impl CropTool {
    /// A crop that starts with all of a canvas of `cells`.
    #[must_use]
    pub fn new(cells: (usize, usize)) -> Self {
        Self { frame: CropFrame::whole(cells), cells, shape: None }
    }

    /// Whole cells that stay.
    #[must_use]
    pub fn rect(&self) -> tile::Rect {
        self.frame.cells(self.cells)
    }

    /// Draws the frame over `canvas`, whose `response` moves it. Enter and Escape decide.
    pub fn show(
        &mut self,
        ui: &Ui,
        canvas: &SurfaceView,
        response: &Response,
    ) -> Option<CropAnswer> {
        let placement = canvas.placement();
        self.drag(ui, response, &placement);
        self.draw(ui, canvas.rect(), &placement);
        self.keys(ui.ctx())
    }

    fn keys(&self, context: &Context) -> Option<CropAnswer> {
        let modal = context.memory(|memory| memory.top_modal_layer().is_some());
        if modal || context.egui_wants_keyboard_input() {
            return None;
        }
        let pressed = |key| context.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        if pressed(Key::Escape) {
            return Some(CropAnswer::Leave);
        }
        (pressed(Key::Enter) && self.changes()).then(|| CropAnswer::Crop(self.rect()))
    }

    /// Whether anything is cut off.
    fn changes(&self) -> bool {
        let rect = self.rect();
        (rect.width, rect.height) != self.cells
    }

    fn drag(&mut self, ui: &Ui, response: &Response, placement: &Placement) {
        let before = self.frame;
        if response.dragged_by(PointerButton::Primary) {
            let to = placement.cell(response.drag_delta().to_pos2());
            let from = placement.cell(Pos2::ZERO);
            self.frame = before.moved([to[0] - from[0], to[1] - from[1]], self.cells);
        }
        for (handle, name) in HANDLES {
            let name = tr(name);
            let at = placement.point(before.place(handle));
            let rect = Rect::from_center_size(at, theme::at_least(ui, vec2(HANDLE, HANDLE)));
            let response = ui.interact(rect, Id::unique(name), Sense::drag());
            response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
            // Movements just before the release may come in its frame.
            let held = response.dragged() || response.drag_stopped();
            if let Some(point) = response.interact_pointer_pos().filter(|_| held) {
                let to = placement.cell(point);
                self.frame = before.dragged(handle, to, self.shape, self.cells);
            }
            response.on_hover_cursor(CursorIcon::Crosshair);
        }
    }

    fn draw(&self, ui: &Ui, area: Rect, placement: &Placement) {
        let painter = ui.painter_at(area);
        let width = self.cells.0 as f64;
        let height = self.cells.1 as f64;
        let CropFrame { x: [left, right], y: [top, bottom] } = self.frame;
        let corners = |x: [f64; 2], y: [f64; 2]| {
            [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]].map(|at| placement.point(at))
        };
        for (x, y) in [
            ([0.0, width], [0.0, top]),
            ([0.0, width], [bottom, height]),
            ([0.0, left], [top, bottom]),
            ([right, width], [top, bottom]),
        ] {
            let shade = Color32::from_black_alpha(140);
            let cut = corners(x, y).to_vec();
            painter.add(Shape::convex_polygon(cut, shade, Stroke::NONE));
        }
        for (width, color) in [(3.0, Color32::from_black_alpha(110)), (1.0, Color32::WHITE)] {
            let frame = corners(self.frame.x, self.frame.y).to_vec();
            painter.add(Shape::closed_line(frame, Stroke::new(width, color)));
        }
        let colors = theme::colors(ui.ctx());
        for (handle, _) in HANDLES {
            let at = placement.point(self.frame.place(handle));
            let rect = Rect::from_center_size(at, vec2(HANDLE - 4.0, HANDLE - 4.0));
            let edge = Stroke::new(1.0, colors.strong);
            painter.rect(rect, 2.0, colors.panel, edge, StrokeKind::Inside);
        }
    }

    /// Draws the size that stays, its shape, and the buttons. Cells are `cell_mm` wide.
    pub fn bar(&mut self, ui: &mut Ui, cell_mm: f64) -> Option<CropAnswer> {
        let mut answer = None;
        let rect = self.rect();
        let mm = |cells: usize| cells as f64 * cell_mm;
        ui.horizontal_wrapped(|ui| {
            let width = mm(rect.width);
            let height = mm(rect.height);
            ui.label(RichText::new(format!("{width:.1} x {height:.1} mm")).strong());
            ui.weak(tr_format!(
                "{width} x {height} cells",
                width = rect.width,
                height = rect.height
            ));
            self.shapes(ui);
            let crop = ui.add_enabled(self.changes(), Button::new(tr("Crop")));
            if crop.on_hover_text(tr("Cuts off what is dark (Enter)")).clicked() {
                answer = Some(CropAnswer::Crop(rect));
            }
            let leave = ui.button(tr("Cancel"));
            if leave.on_hover_text(tr("Leaves the painting as it is (Esc)")).clicked() {
                answer = Some(CropAnswer::Leave);
            }
            let note = tr("Undo ends at a crop, and the brushes are clean after it; the palette \
                            keeps its paint.");
            ui.label(RichText::new(note).weak().small());
        });
        answer
    }

    /// Free or kept shape.
    fn shapes(&mut self, ui: &mut Ui) {
        let [width, height] = self.frame.size();
        let near = |shape: f64| self.shape.is_some_and(|own| (own - shape).abs() < 1e-6);
        let named = SHAPES.iter().find(|(_, shape)| near(*shape) || near(1.0 / shape));
        let shown = match (self.shape, named) {
            (None, _) => tr("Free"),
            (Some(_), Some((name, _))) => name,
            (Some(_), None) => tr("Kept"),
        };
        let combo = ComboBox::from_id_salt("crop shape").selected_text(shown).width(70.0);
        let combo = combo.show_ui(ui, |ui| {
            if ui.selectable_label(self.shape.is_none(), tr("Free")).clicked() {
                self.shape = None;
            }
            if ui.selectable_label(shown == tr("Kept"), tr("Kept")).clicked() {
                self.shape = Some(width / height);
            }
            for (name, shape) in SHAPES {
                if ui.selectable_label(shown == name, name).clicked() {
                    let shape = if height > width { 1.0 / shape } else { shape };
                    self.shape = Some(shape);
                    let to = [self.frame.x[1], self.frame.y[1]];
                    self.frame = self.frame.dragged([1, 1], to, self.shape, self.cells);
                }
            }
        });
        let tip = tr("Width over height of what stays: free, as it is now, or one of these");
        combo.response.accessible_name(tr("Shape of the crop")).on_hover_text(tip);
    }
}
