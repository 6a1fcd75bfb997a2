//! Tools of the pointer on the reference picture: drawing marks and guides, and picking colours.
//!
//! The picture can also lie over the canvas, so that you can draw after it. It is never painted,
//! saved or exported.

use eframe::egui::epaint::{Mesh, Vertex};
use eframe::egui::{
    Button, Color32, CursorIcon, Id, Painter, PointerButton, Pos2, Rect, Response, Role, Sense,
    Shape, Slider, Stroke, TextureId, Ui, WidgetInfo, pos2, vec2,
};
use spectra::color::Rgb;

use super::super::context::PanelContext;
use super::picture::{OverlayPlace, PictureView, ReferenceMode};
use super::samples::traced;
use super::state::{Drawn, Overlay, Reference, screen_color};
use crate::keymap::hint;
use crate::language::{tr, tr_format};
use crate::theme;
use crate::view::{Placement, SurfaceView};

/// Side of a drawn handle, in points. In touch mode you press in a larger square.
const HANDLE: f32 = 14.0;

/// Corners of a picture in shares of its sides, clockwise.
const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

impl Reference {
    /// Whether the picture is shown over the canvas.
    #[must_use]
    pub fn is_over_canvas(&self) -> bool {
        self.over.shown && self.picture.is_some()
    }

    /// Lays the picture over the canvas, or removes it.
    pub fn toggle_over_canvas(&mut self) {
        self.over.shown ^= true;
        self.over.moving &= self.over.shown;
    }

    /// Whether the pointer moves the picture over the canvas instead of painting.
    #[must_use]
    pub fn takes_pointer(&self) -> bool {
        self.is_over_canvas() && self.over.moving
    }

    /// Draws the buttons of the picture over the canvas.
    pub(super) fn over_controls(&mut self, ui: &mut Ui) {
        ui.horizontal_wrapped(|ui| {
            let loaded = self.picture.is_some();
            let over =
                ui.add_enabled(loaded, Button::selectable(self.over.shown, tr("Over canvas")));
            let key = hint(ui.ctx(), "reference-over");
            let tip = tr_format!(
                "Lays the picture over the canvas, to draw after{key}. It is never painted",
                key
            );
            if over.on_hover_text(tip).clicked() {
                self.toggle_over_canvas();
            }
            if !self.is_over_canvas() {
                return;
            }
            let mut percent = self.over.opacity * 100.0;
            ui.spacing_mut().slider_width = 80.0;
            let slider = Slider::new(&mut percent, 0.0..=100.0).fixed_decimals(0).suffix(" %");
            let slider = ui.add(slider).accessible_name(tr("Opacity over the canvas"));
            if slider.on_hover_text(tr("How much the picture hides the painting")).changed() {
                self.over.opacity = percent / 100.0;
            }
            let moving = ui.add(Button::selectable(self.over.moving, tr("Move")));
            let tip =
                tr("Drag the picture, its corners and the handle above it; while this is off it \
                       is locked, and the pen paints");
            if moving.on_hover_text(tip).clicked() {
                self.over.moving ^= true;
            }
            let fit = ui.button(tr("Fit to canvas"));
            if fit.on_hover_text(tr("Fits the whole picture into the canvas")).clicked() {
                self.over.place = None;
            }
        });
    }

    /// Draws the picture over `canvas`. While moving is on, `response` moves it. Cells are
    /// `cell_mm` wide.
    pub fn show_over(&mut self, ui: &Ui, canvas: &SurfaceView, response: &Response, cell_mm: f64) {
        if !self.is_over_canvas() {
            return;
        }
        let Some([width, height]) = self.picture.as_ref().map(|picture| picture.file_size()) else {
            return;
        };
        let Some(texture) = self.texture(ui.ctx()) else { return };
        let aspect = width as f64 / height as f64;
        let (columns, rows) = canvas.cells();
        let canvas_mm = [columns as f64 * cell_mm, rows as f64 * cell_mm];
        let mut place = self.over.place.unwrap_or_else(|| OverlayPlace::fitted(canvas_mm, aspect));
        let on_canvas = OnCanvas { placement: canvas.placement(), cell_mm };
        let painter = ui.painter_at(canvas.rect());
        if self.over.moving {
            let moved = self.drag(ui, response, &on_canvas, place, aspect);
            if moved != place {
                (place, self.over.place) = (moved, Some(moved));
            }
        }
        let corners = CORNERS.map(|corner| on_canvas.point(place.point(corner, aspect)));
        draw(&painter, texture, corners, self.flipped, self.over.opacity);
        if self.over.moving {
            draw_frame(&painter, ui, corners, turn_handle(&on_canvas, &place, aspect));
        }
    }

    /// Place of the picture after the drags of this frame.
    fn drag(
        &self,
        ui: &Ui,
        response: &Response,
        on_canvas: &OnCanvas,
        place: OverlayPlace,
        aspect: f64,
    ) -> OverlayPlace {
        let mut moved = place;
        if response.dragged_by(PointerButton::Primary) {
            let [from, to] = [Pos2::ZERO, response.drag_delta().to_pos2()].map(|p| on_canvas.mm(p));
            moved = moved.moved([to[0] - from[0], to[1] - from[1]]);
        }
        let handle = |at: Pos2, name: &str| {
            let rect = Rect::from_center_size(at, theme::at_least(ui, vec2(HANDLE, HANDLE)));
            let response = ui.interact(rect, Id::unique(("over canvas", name)), Sense::drag());
            response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
            let to = response.interact_pointer_pos().filter(|_| response.dragged());
            (to.map(|point| on_canvas.mm(point)), response)
        };
        let names = [tr("upper left"), tr("upper right"), tr("lower right"), tr("lower left")];
        for (corner, name) in CORNERS.into_iter().zip(names) {
            let at = on_canvas.point(place.point(corner, aspect));
            let (to, response) = handle(at, &tr_format!("Scale by the {name} corner", name));
            response.on_hover_cursor(CursorIcon::ResizeNwSe);
            if let Some(to) = to {
                moved = place.scaled_to(to, aspect);
            }
        }
        let (to, response) = handle(turn_handle(on_canvas, &place, aspect), tr("Turn the picture"));
        response.on_hover_cursor(CursorIcon::Alias);
        if let Some(to) = to {
            moved = place.turned_to(to);
        }
        moved
    }

    /// Handles the pointer's movements over the picture in this frame.
    pub(super) fn sketch(&mut self, ui: &Ui, response: &Response, view: PictureView) {
        let Some(drawn) = self.line.update(ui, response) else { return };
        let Some(size) = self.picture.as_ref().map(|picture| picture.file_size()) else { return };
        let place = |point: Pos2| {
            let place = view.place(response.rect, point);
            [f64::from(place.x), f64::from(place.y)]
        };
        let tolerance = f64::from(TOLERANCE_PX.max(TOLERANCE_POINTS / view.zoom));
        let shift = ui.input(|input| input.modifiers.shift);
        match (self.mode, drawn) {
            (ReferenceMode::Pick, _) => {}
            (ReferenceMode::Mark, drawn) if self.spacing || shift => {
                self.sketch_spacing(drawn, place, size);
            }
            (mode, Drawn::Line(points)) => {
                let points: Vec<[f64; 2]> = points.into_iter().map(place).collect();
                let line = traced(&points, size, tolerance);
                if line.len() < 2 {
                    return;
                }
                match mode {
                    ReferenceMode::Mark => self.samples.add(line, size),
                    _ => self.combing.add(line),
                }
            }
            (mode, Drawn::Click(point)) => {
                let at = place(point);
                let reach = f64::from(REACH / view.zoom);
                match mode {
                    ReferenceMode::Mark => {
                        let nearest = self.samples.nearest(at, reach);
                        self.samples.selected = nearest.unwrap_or(self.samples.selected);
                    }
                    _ => {
                        let nearest = self.combing.nearest(at, reach);
                        self.combing.selected = nearest.unwrap_or(self.combing.selected);
                    }
                }
            }
        }
    }

    /// Sets the distance between strokes. You give it by a line from one stroke to the next, or by
    /// a click on each of the two.
    fn sketch_spacing(&mut self, drawn: Drawn, place: impl Fn(Pos2) -> [f64; 2], size: [usize; 2]) {
        let (from, to) = match drawn {
            Drawn::Line(points) => match points[..] {
                [first, .., last] => (place(first), place(last)),
                _ => return,
            },
            Drawn::Click(point) => match self.first_place {
                Some(first) => (first, place(point)),
                None => {
                    let at = place(point);
                    self.first_place = at
                        .into_iter()
                        .zip(size)
                        .all(|(at, side)| (0.0..side as f64).contains(&at))
                        .then_some(at);
                    return;
                }
            },
        };
        if let [from, .., to] = traced(&[from, to], size, f64::INFINITY)[..] {
            self.first_place = None;
            self.samples.set_spacing([from, to], size);
        }
    }

    pub(super) fn draw_sketches(&self, ui: &Ui, panel: Rect, view: PictureView) {
        let point = |[x, y]: [f64; 2]| view.point(panel, vec2(x as f32, y as f32));
        let overlay = Overlay { painter: ui.painter_at(panel), point: &point, zoom: view.zoom };
        let color = match self.mode {
            ReferenceMode::Pick => return,
            ReferenceMode::Mark => {
                let marks = self.samples.marks();
                for (index, mark) in marks.iter().enumerate() {
                    overlay.mark(index, mark, index == self.samples.selected);
                }
                screen_color(marks.len())
            }
            ReferenceMode::Comb => {
                for (index, line) in self.combing.combed().lines.iter().enumerate() {
                    overlay.guide(index + 1, line, index == self.combing.selected);
                }
                Color32::WHITE
            }
        };
        let shift = ui.input(|input| input.modifiers.shift);
        let between_strokes = self.mode == ReferenceMode::Mark && (self.spacing || shift);
        let selected = screen_color(self.samples.selected);
        match (between_strokes, self.line.points()) {
            (true, [first, .., last]) => overlay.spacing([*first, *last], selected),
            (false, points) => overlay.unfinished(points, color),
            _ => {}
        }
        if let (Some(first), Some(pointer)) = (self.first_place, ui.ctx().pointer_latest_pos()) {
            overlay.spacing([point(first), pointer], selected);
        }
    }

    /// Shows the colour at the pointer while you hold the primary button, and picks it when you
    /// release this.
    pub(super) fn pick(
        &self,
        ui: &Ui,
        response: &Response,
        view: PictureView,
        cx: &mut PanelContext<'_>,
    ) {
        let first = ui.input(|input| {
            input.pointer.button_down(PointerButton::Primary)
                || input.pointer.button_released(PointerButton::Primary)
        });
        let (Some(pointer), Some(picture)) = (response.interact_pointer_pos(), &self.picture)
        else {
            return;
        };
        let place = view.place(response.rect, pointer);
        let Some(color) =
            picture.mean([place.x, place.y], self.radius, self.exposure).filter(|_| first)
        else {
            return;
        };
        if response.drag_stopped() || response.clicked() {
            cx.tools.reference_color = Some(color);
        } else {
            let reach = view.zoom * self.radius.max(0.5);
            loupe(ui, response.rect, pointer, reach, Rgb(color));
        }
    }
}

struct OnCanvas {
    placement: Placement,
    cell_mm: f64,
}

impl OnCanvas {
    fn point(&self, mm: [f64; 2]) -> Pos2 {
        self.placement.point(mm.map(|mm| mm / self.cell_mm))
    }

    fn mm(&self, point: Pos2) -> [f64; 2] {
        self.placement.cell(point).map(|cells| cells * self.cell_mm)
    }
}

/// The point of the handle that turns the picture, above the middle of its upper edge.
fn turn_handle(on_canvas: &OnCanvas, place: &OverlayPlace, aspect: f64) -> Pos2 {
    let edge = on_canvas.point(place.point([0.5, 0.0], aspect));
    let middle = on_canvas.point(place.center);
    edge + (edge - middle).normalized() * 26.0
}

fn draw(painter: &Painter, texture: TextureId, corners: [Pos2; 4], flipped: bool, opacity: f32) {
    let color = Color32::WHITE.gamma_multiply(opacity);
    let mut mesh = Mesh::with_texture(texture);
    for (pos, [across, down]) in corners.into_iter().zip(CORNERS) {
        let across = if flipped { 1.0 - across } else { across };
        mesh.vertices.push(Vertex { pos, uv: pos2(across as f32, down as f32), color });
    }
    mesh.add_triangle(0, 1, 2);
    mesh.add_triangle(0, 2, 3);
    painter.add(Shape::mesh(mesh));
}

fn draw_frame(painter: &Painter, ui: &Ui, corners: [Pos2; 4], turn: Pos2) {
    let colors = theme::colors(ui.ctx());
    let top = corners[0].lerp(corners[1], 0.5);
    for (width, color) in [(3.0, Color32::from_black_alpha(110)), (1.0, Color32::WHITE)] {
        let stroke = Stroke::new(width, color);
        painter.add(Shape::closed_line(corners.to_vec(), stroke));
        painter.line_segment([top, turn], stroke);
    }
    let edge = Stroke::new(1.0, colors.strong);
    for corner in corners {
        let rect = Rect::from_center_size(corner, vec2(HANDLE - 4.0, HANDLE - 4.0));
        painter.rect(rect, 2.0, colors.panel, edge, eframe::egui::StrokeKind::Inside);
    }
    painter.circle(turn, 0.5 * HANDLE - 1.0, colors.panel, edge);
}

/// A click selects a line within this distance, in points.
const REACH: f32 = 8.0;

/// We drop bends of a line below this size: the larger of this in pixels of the picture and
/// [`TOLERANCE_POINTS`] in points of the window.
const TOLERANCE_PX: f32 = 0.5;
const TOLERANCE_POINTS: f32 = 0.75;

/// Draws the colour beside the pointer, and the disc that we average.
fn loupe(ui: &Ui, panel: Rect, pointer: Pos2, reach: f32, linear: Rgb) {
    let [red, green, blue] = linear.encoded().to_bytes();
    let painter = ui.painter_at(panel);
    painter.circle_stroke(pointer, reach.max(3.0), Stroke::new(1.5, Color32::WHITE));
    painter.circle_stroke(pointer, reach.max(3.0) + 1.0, Stroke::new(1.0, Color32::BLACK));
    let patch = Rect::from_center_size(pointer - vec2(0.0, 44.0), vec2(44.0, 44.0));
    painter.rect_filled(patch.expand(1.0), 0.0, Color32::BLACK);
    painter.rect_filled(patch, 0.0, Color32::from_rgb(red, green, blue));
}
