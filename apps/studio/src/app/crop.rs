//! Cropping: the rectangle of cells that stays, as data, and the tool that draws it over the canvas
//! and lets you drag it.

use eframe::egui::{
    Button, Color32, ComboBox, Context, CursorIcon, Id, Key, Modifiers, PointerButton, Pos2,
    Rect as ScreenRect, Response, RichText, Role, Sense, Shape, Stroke, StrokeKind, Ui, WidgetInfo,
    vec2,
};
use graphics::tile::Rect;

use crate::language::{tr, tr_format};
use crate::theme;
use crate::view::{Placement, SurfaceView};

const LEAST: f64 = 8.0;

/// One of the eight handles: -1, 0 or 1 for left, middle and right, and for top, middle and bottom.
type Handle = [i8; 2];

const HANDLES: [(Handle, &str); 8] = [
    ([-1, -1], "Crop upper left"),
    ([0, -1], "Crop top"),
    ([1, -1], "Crop upper right"),
    ([1, 0], "Crop right"),
    ([1, 1], "Crop lower right"),
    ([0, 1], "Crop bottom"),
    ([-1, 1], "Crop lower left"),
    ([-1, 0], "Crop left"),
];

/// Edges of a rectangle on a canvas: left and right, top and bottom, in cells.
#[derive(Debug, Clone, Copy, PartialEq)]
struct CropFrame {
    x: [f64; 2],
    y: [f64; 2],
}

impl CropFrame {
    /// The whole canvas.
    fn whole_canvas((width, height): (usize, usize)) -> Self {
        Self { x: [0.0, width as f64], y: [0.0, height as f64] }
    }

    fn size(&self) -> [f64; 2] {
        [self.x[1] - self.x[0], self.y[1] - self.y[0]]
    }

    fn place(&self, [across, down]: Handle) -> [f64; 2] {
        fn at([low, high]: [f64; 2], side: i8) -> f64 {
            match side {
                ..0 => low,
                0 => 0.5 * (low + high),
                1.. => high,
            }
        }
        [at(self.x, across), at(self.y, down)]
    }

    /// The frame moved by `by` cells, as far as the canvas allows.
    fn moved(self, by: [f64; 2], (width, height): (usize, usize)) -> Self {
        fn shift([low, high]: [f64; 2], by: f64, most: usize) -> [f64; 2] {
            let by = by.clamp(-low, most as f64 - high);
            [low + by, high + by]
        }
        Self { x: shift(self.x, by[0], width), y: shift(self.y, by[1], height) }
    }

    /// The frame after you drag a handle to `to`, on a canvas of `cells`. `shape` fixes width over
    /// height. The opposite corner stays.
    fn dragged(
        self,
        [across, down]: Handle,
        to: [f64; 2],
        shape: Option<f64>,
        (width, height): (usize, usize),
    ) -> Self {
        if let Some(shape) = shape {
            return self.dragged_in_shape([across, down], to, shape, (width, height));
        }
        fn edge([low, high]: [f64; 2], side: i8, to: f64, most: usize) -> [f64; 2] {
            let most = most as f64;
            match side {
                ..0 => [to.clamp(0.0, (high - LEAST).max(0.0)), high],
                0 => [low, high],
                1.. => [low, to.clamp((low + LEAST).min(most), most)],
            }
        }
        Self { x: edge(self.x, across, to[0], width), y: edge(self.y, down, to[1], height) }
    }

    fn dragged_in_shape(
        self,
        [across, down]: Handle,
        to: [f64; 2],
        shape: f64,
        (width, height): (usize, usize),
    ) -> Self {
        // A handle in the middle of an edge grows the frame to the right and downwards.
        let [right, lower] = [across >= 0, down >= 0];
        let fixed = [self.x[usize::from(!right)], self.y[usize::from(!lower)]];
        fn room(forward: bool, fixed: f64, most: usize) -> f64 {
            if forward { most as f64 - fixed } else { fixed }
        }
        let room = [room(right, fixed[0], width), room(lower, fixed[1], height)];
        let reach = [0, 1].map(|axis: usize| (to[axis] - fixed[axis]).abs());
        let wanted = match (across, down) {
            (0, _) => reach[1] * shape,
            (_, 0) => reach[0],
            _ => reach[0].max(reach[1] * shape),
        };
        let most = room[0].min(room[1] * shape);
        let least = LEAST.max(LEAST * shape).min(most);
        let width = wanted.clamp(least, most);
        fn side(forward: bool, fixed: f64, length: f64) -> [f64; 2] {
            if forward { [fixed, fixed + length] } else { [fixed - length, fixed] }
        }
        Self { x: side(right, fixed[0], width), y: side(lower, fixed[1], width / shape) }
    }

    /// Whole cells of the frame on a canvas of `cells`.
    fn cells(&self, (width, height): (usize, usize)) -> Rect {
        fn whole_cells([low, high]: [f64; 2], most: usize) -> (usize, usize) {
            let low = (low.round().max(0.0) as usize).min(most.saturating_sub(1));
            let high = (high.round().max(0.0) as usize).clamp(low + 1, most);
            (low, high - low)
        }
        let (x, width) = whole_cells(self.x, width);
        let (y, height) = whole_cells(self.y, height);
        Rect { x, y, width, height }
    }
}

/// Side of a drawn handle, in points. In touch mode you press in a larger square.
const HANDLE: f32 = 14.0;

/// Shapes to choose from: name, and the ratio of the longer to the shorter side.
const SHAPES: [(&str, f64); 5] =
    [("1 : 1", 1.0), ("5 : 4", 1.25), ("4 : 3", 4.0 / 3.0), ("3 : 2", 1.5), ("16 : 9", 16.0 / 9.0)];

/// Your decision about a crop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CropAnswer {
    /// Crops to these cells.
    Crop(Rect),
    /// Leaves the painting as it is.
    Leave,
}

/// A crop that you are framing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CropTool {
    frame: CropFrame,
    cells: (usize, usize),
    /// Width over height, if fixed.
    shape: Option<f64>,
}

impl CropTool {
    /// A crop that starts with all of a canvas of `cells`.
    #[must_use]
    pub fn new(cells: (usize, usize)) -> Self {
        Self { frame: CropFrame::whole_canvas(cells), cells, shape: None }
    }

    /// Whole cells that stay.
    #[must_use]
    pub fn rect(&self) -> Rect {
        self.frame.cells(self.cells)
    }

    /// Draws the frame over `canvas`. `response` moves it. Enter and Escape decide.
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
            let rect = ScreenRect::from_center_size(at, theme::at_least(ui, vec2(HANDLE, HANDLE)));
            let response = ui.interact(rect, Id::unique(name), Sense::drag());
            response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
            // The last movements may come in the frame of the release.
            let held = response.dragged() || response.drag_stopped();
            if let Some(point) = response.interact_pointer_pos().filter(|_| held) {
                let to = placement.cell(point);
                self.frame = before.dragged(handle, to, self.shape, self.cells);
            }
            response.on_hover_cursor(CursorIcon::Crosshair);
        }
    }

    fn draw(&self, ui: &Ui, area: ScreenRect, placement: &Placement) {
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
            let rect = ScreenRect::from_center_size(at, vec2(HANDLE - 4.0, HANDLE - 4.0));
            let edge = Stroke::new(1.0, colors.strong);
            painter.rect(rect, 2.0, colors.panel, edge, StrokeKind::Inside);
        }
    }

    /// Draws the remaining size, its shape, and the buttons. Cells are `cell_mm` wide.
    pub fn bar(&mut self, ui: &mut Ui, cell_mm: f64) -> Option<CropAnswer> {
        let mut answer = None;
        let rect = self.rect();
        ui.horizontal_wrapped(|ui| {
            let [width, height] = [rect.width, rect.height].map(|cells| cells as f64 * cell_mm);
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

#[cfg(test)]
mod tests {
    use super::*;

    const CELLS: (usize, usize) = (200, 100);

    #[test]
    fn handles_move_their_edges_and_stay_on_the_canvas() {
        let whole = CropFrame::whole_canvas(CELLS);
        let frame = whole.dragged([-1, -1], [20.4, 10.0], None, CELLS);
        assert_eq!(frame.cells(CELLS), Rect { x: 20, y: 10, width: 180, height: 90 });
        let frame = frame.dragged([1, 0], [150.0, 3.0], None, CELLS);
        assert_eq!(frame.cells(CELLS), Rect { x: 20, y: 10, width: 130, height: 90 });
        let out = frame.dragged([-1, 1], [-50.0, 500.0], None, CELLS);
        assert_eq!(out.cells(CELLS), Rect { x: 0, y: 10, width: 150, height: 90 });
        let shut = frame.dragged([-1, 0], [190.0, 0.0], None, CELLS);
        assert_eq!(shut.size()[0], LEAST, "it does not turn inside out");
    }

    #[test]
    fn a_kept_shape_stays_within_the_canvas() {
        let whole = CropFrame::whole_canvas(CELLS);
        for (handle, to) in [
            ([1, 1], [120.0, 20.0]),
            ([-1, -1], [150.0, 90.0]),
            ([1, -1], [900.0, -900.0]),
            ([0, 1], [0.0, 40.0]),
            ([-1, 0], [130.0, 0.0]),
        ] {
            let frame = whole.dragged(handle, to, Some(1.5), CELLS);
            let [width, height] = frame.size();
            assert!((width / height - 1.5).abs() < 1e-9, "{handle:?}: {frame:?}");
            assert!(frame.x[0] >= -1e-9 && frame.x[1] <= 200.0 + 1e-9, "{handle:?}: {frame:?}");
            assert!(frame.y[0] >= -1e-9 && frame.y[1] <= 100.0 + 1e-9, "{handle:?}: {frame:?}");
        }
        let frame = whole.dragged([1, 1], [120.0, 20.0], Some(1.5), CELLS);
        assert_eq!((frame.x, frame.y), ([0.0, 120.0], [0.0, 80.0]), "the upper left is still");
    }

    #[test]
    fn a_frame_moves_as_far_as_the_canvas() {
        let frame = CropFrame { x: [20.0, 60.0], y: [10.0, 50.0] };
        assert_eq!(frame.moved([5.0, 5.0], CELLS), CropFrame { x: [25.0, 65.0], y: [15.0, 55.0] });
        assert_eq!(
            frame.moved([-90.0, 90.0], CELLS),
            CropFrame { x: [0.0, 40.0], y: [60.0, 100.0] }
        );
        assert_eq!(frame.place([0, 1]), [40.0, 50.0]);
    }
}
