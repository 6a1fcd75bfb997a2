//! A surface in the window: zoom and pan, its pictures, and the line between two lights.
//!
//! A [`Patch`] is a rectangle of its pixels, computed on the processor. A page in a browser shows
//! a stroke by patches between its frames: without a graphics card, a browser takes 60 ms for a
//! frame, and 8 ms for a patch.
//!
//! On a palette, a line between the lights would show each heap under only one of them. To mix,
//! you must see the same heap under both, so a switch shows the whole palette under the first or
//! the second light.

use eframe::egui::{
    Align2, Button, Color32, CursorIcon, FontId, Frame, Id, Margin, MouseWheelSource,
    PointerButton, Pos2, Rect, Response, Role, Sense, Stroke, Ui, UiBuilder, WidgetInfo, lerp,
    pos2, vec2,
};
use session::{HeadOnCanvas, TilePixels};

use super::outline::{HeadLines, Outline, SHADE, SHADOW};
use super::picture::{DrawnPart, Picture, Shown};
use super::transform::{Placement, ViewState};
use crate::language::{tr, tr_format};
use crate::theme;

/// Scrolling by these points zooms by a factor of e. One notch of a wheel is 50 points (chosen by
/// eye).
const WHEEL_POINTS: f32 = 220.0;

/// Effect of a drag with the primary button on the view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DragMode {
    /// No effect, the pointer paints.
    #[default]
    None,
    /// Pans the view.
    Pan,
    /// Rotates about the middle of the view.
    Rotate,
    /// Zooms. You drag upwards to zoom in.
    Zoom,
}

/// The line between the pictures under two lights.
#[derive(Debug)]
pub struct Split<'a> {
    /// Position of the line, as a fraction of the surface's width.
    pub at: &'a mut f32,
    /// Names of the lights left and right of the line.
    pub lights: [&'a str; 2],
}

/// A surface in the window.
#[derive(Debug)]
pub struct SurfaceView {
    /// Zoom, pan and rotation.
    pub view: ViewState,
    name: &'static str,
    outline: Outline,
    margin: f32,
    first: Picture,
    second: Option<Picture>,
    rect: Rect,
    density: f32,
    drag: DragMode,
    split_handle: Option<Rect>,
    /// Whether the switch is set to the second light.
    pub(super) shows_second: bool,
    pub(super) light_switch: Option<Rect>,
}

impl SurfaceView {
    /// A surface without a picture, fitted into its rectangle with `margin` points around it.
    #[must_use]
    pub fn new(name: &'static str, outline: Outline, margin: f32) -> Self {
        Self {
            view: ViewState::default(),
            name,
            outline,
            margin,
            first: Picture::new(name, (1, 1)),
            second: None,
            rect: Rect::NOTHING,
            density: 1.0,
            drag: DragMode::None,
            split_handle: None,
            shows_second: false,
            light_switch: None,
        }
    }

    /// Replaces the surface by an empty one of `cells` columns and rows, and fits it into
    /// the view.
    pub fn open(&mut self, cells: (usize, usize)) {
        self.first = Picture::new(self.name, cells);
        self.second = None;
        self.view = ViewState { mirror: self.view.mirror, ..ViewState::default() };
    }

    /// Adds or removes the picture under a second light.
    pub fn set_second(&mut self, there: bool) {
        if there && self.second.is_none() {
            self.second = Some(Picture::new(self.name, self.cells()));
        } else if !there {
            (self.second, self.shows_second) = (None, false);
        }
    }

    /// Writes part of the first or the second picture.
    pub fn write(&mut self, second: bool, tile: &TilePixels) {
        let name = self.name;
        let cells = self.cells();
        let picture = if second {
            // The first tiles may arrive before the state that names the light.
            self.second.get_or_insert_with(|| Picture::new(name, cells))
        } else {
            &mut self.first
        };
        picture.write(tile);
    }

    /// Columns and rows of cells.
    #[must_use]
    pub fn cells(&self) -> (usize, usize) {
        self.first.cells()
    }

    /// The picture under the first or the second light.
    #[must_use]
    pub fn picture(&self, second: bool) -> Option<&Picture> {
        if second { self.second.as_ref() } else { Some(&self.first) }
    }

    /// Rectangle that last showed the surface, in points.
    #[must_use]
    pub fn rect(&self) -> Rect {
        self.rect
    }

    /// Rectangle of the handle that moves the line between two lights, if there are two.
    #[must_use]
    pub fn split_handle(&self) -> Option<Rect> {
        self.split_handle
    }

    /// Mapping from cells to points of the window.
    #[must_use]
    pub fn placement(&self) -> Placement {
        self.view.placement(self.rect, self.density)
    }

    /// Position in cells at a point of the window, if it is on the surface.
    #[must_use]
    pub fn position(&self, point: Pos2) -> Option<[f64; 2]> {
        let position = self.placement().cell(point);
        let on = self.rect.contains(point) && self.outline.contains(position, self.cells());
        on.then_some(position)
    }

    /// Fits the whole surface into its rectangle.
    pub fn fit(&mut self) {
        self.view.fit(self.cells(), self.rect, self.margin, self.density);
    }

    /// Shows the surface in a rectangle of the window. `mode` says what a drag with the primary
    /// button does if it begins now. The middle button always pans.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        rect: Rect,
        mode: DragMode,
        split: Option<Split>,
    ) -> Response {
        self.rect = rect;
        self.density = ui.ctx().pixels_per_point();
        let id = Id::unique(("surface", self.name));
        let response = ui.interact(rect, id, Sense::click_and_drag());
        let name = tr(self.name);
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, name));
        self.navigate(ui, &response, mode);
        if self.view.fitted {
            self.fit();
        }
        let placement = self.placement();
        let painter = ui.painter_at(rect);
        (self.split_handle, self.light_switch) = (None, None);
        self.outline.draw_shadow(&painter, &placement, self.cells());
        match (&mut self.second, split) {
            (Some(second), Some(split)) => {
                let column = f64::from(*split.at) * self.first.cells().0 as f64;
                self.first.draw(&painter, &placement, DrawnPart::LeftOf(column));
                second.draw(&painter, &placement, DrawnPart::RightOf(column));
                self.outline.draw_edge(&painter, &placement, self.first.cells());
                self.split_line(ui, &placement, split);
            }
            (second, _) => {
                let shown = second.as_mut().filter(|_| self.shows_second);
                shown.unwrap_or(&mut self.first).draw(&painter, &placement, DrawnPart::Whole);
                self.outline.draw_edge(&painter, &placement, self.first.cells());
            }
        }
        response
    }

    /// Draws a brush head over the surface, with the colour of its paint. Returns the rectangle
    /// that it covers.
    pub fn show_head(&self, ui: &Ui, over: &HeadOnCanvas, paint: Option<[u8; 3]>) -> Option<Rect> {
        let lines = self.head_lines(over, paint);
        lines.draw(&ui.painter_at(self.rect));
        lines.bounds()
    }

    /// The lines of a brush head over the surface, with the colour of its paint.
    #[must_use]
    pub fn head_lines(&self, over: &HeadOnCanvas, paint: Option<[u8; 3]>) -> HeadLines {
        HeadLines::of(&self.placement(), over, paint)
    }

    /// The part of the window with changes since the last call or frame, in points.
    pub fn take_fresh(&mut self) -> Option<Rect> {
        let cells = self.first.take_fresh()?;
        let left = cells.x as f64;
        let top = cells.y as f64;
        let right = left + cells.width as f64;
        let bottom = top + cells.height as f64;
        let placement = self.placement();
        let corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
        let points = corners.map(|corner| placement.point(corner));
        // Interpolated pixels depend on the cells beside them. At reduced levels these reach some
        // cells far.
        let margin = 2.0 * (1.0 + placement.scale() as f32);
        Some(Rect::from_points(&points).expand(margin))
    }

    /// Pixels of a rectangle of the window, given in points, where this shows the surface.
    #[must_use]
    pub fn patch(&self, rect: Rect) -> Patch {
        Patch::of(&self.first, &self.placement(), rect.intersect(self.rect), self.density)
    }

    /// Applies drags, wheel and touch gestures to the view.
    fn navigate(&mut self, ui: &Ui, response: &Response, mode: DragMode) {
        let rect = self.rect;
        let density = self.density;
        if response.drag_started_by(PointerButton::Middle) {
            self.drag = DragMode::Pan;
        } else if response.drag_started_by(PointerButton::Primary) {
            self.drag = mode;
        }
        let delta = response.drag_delta();
        match (self.drag, response.interact_pointer_pos()) {
            (DragMode::Pan, Some(_)) => self.view.pan(delta, density),
            (DragMode::Rotate, Some(now)) => {
                let [after, before] =
                    [now, now - delta].map(|point| (point - rect.center()).angle());
                self.view.rotate(f64::from(after - before));
                self.view.fitted = false;
            }
            (DragMode::Zoom, Some(now)) => {
                let start = ui.input(|input| input.pointer.press_origin()).unwrap_or(now);
                self.view.zoom_by(f64::from(-delta.y / 120.0).exp(), start, rect, density);
            }
            _ => {}
        }
        if !response.dragged() {
            self.drag = DragMode::None;
        }
        let cursor = match (self.drag, mode) {
            (DragMode::Pan, _) => Some(CursorIcon::Grabbing),
            (DragMode::None, DragMode::Pan) => Some(CursorIcon::Grab),
            (DragMode::Rotate, _) | (_, DragMode::Rotate) => Some(CursorIcon::Alias),
            (DragMode::Zoom, _) | (_, DragMode::Zoom) => Some(CursorIcon::ZoomIn),
            _ => None,
        };
        if let Some(cursor) = cursor.filter(|_| response.contains_pointer() || response.dragged()) {
            ui.ctx().set_cursor_icon(cursor);
        }
        if !response.contains_pointer() {
            return;
        }
        let touch = ui.input(|input| input.multi_touch());
        if let Some(touch) = touch {
            let centre = touch.center_pos;
            self.view.pan(touch.translation_delta, density);
            self.view.zoom_by(f64::from(touch.zoom_delta), centre, rect, density);
            self.view.rotate_about(f64::from(touch.rotation_delta), centre, rect, density);
            return;
        }
        let (scroll, zoom, source, pointer) = ui.input(|input| {
            let source = input.scroll_source();
            (input.smooth_scroll_delta(), input.zoom_delta(), source, input.pointer.hover_pos())
        });
        let Some(pointer) = pointer else { return };
        let fingers =
            matches!(source, Some(MouseWheelSource::Trackpad | MouseWheelSource::Momentum));
        if fingers && scroll != vec2(0.0, 0.0) {
            self.view.pan(scroll, density);
        }
        let wheel = if fingers { 0.0 } else { scroll.y };
        let factor = zoom * (wheel / WHEEL_POINTS).exp();
        if factor != 1.0 {
            self.view.zoom_by(f64::from(factor), pointer, rect, density);
        }
    }

    /// Draws the line between two lights, which you can drag.
    fn split_line(&mut self, ui: &mut Ui, placement: &Placement, split: Split) {
        let width = self.cells().0 as f64;
        let height = self.cells().1 as f64;
        let ends = |at: f32| {
            let column = f64::from(at) * width;
            [placement.point([column, 0.0]), placement.point([column, height])]
        };
        let middle = |at: f32| self.rect.shrink(16.0).clamp(ends(at)[0].lerp(ends(at)[1], 0.5));
        let split_handle =
            Rect::from_center_size(middle(*split.at), theme::at_least(ui, vec2(22.0, 22.0)));
        self.split_handle = Some(split_handle);
        let response = ui.interact(split_handle, Id::unique(("split", self.name)), Sense::drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, tr("Split of two lights")));
        if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            *split.at = (placement.cell(pointer)[0] / width).clamp(0.0, 1.0) as f32;
        }
        let painter = ui.painter_at(self.rect);
        painter.line_segment(ends(*split.at), Stroke::new(3.0, Color32::from_black_alpha(90)));
        painter.line_segment(ends(*split.at), Stroke::new(1.0, theme::colors(ui.ctx()).strong));
        let centre = middle(*split.at);
        let fill = if response.hovered() {
            theme::colors(ui.ctx()).chosen
        } else {
            theme::colors(ui.ctx()).panel
        };
        painter.circle(centre, 10.0, fill, Stroke::new(1.0, theme::colors(ui.ctx()).strong));
        // The arrows lie along the rows of the surface, even if you rotate it.
        let along = placement.direction([1.0, 0.0]).normalized();
        for side in [-1.0, 1.0] {
            let tip = centre + along * (6.0 * side);
            let wing = along.rot90() * 3.0;
            let back = tip - along * (3.0 * side);
            painter
                .line_segment([back + wing, tip], Stroke::new(1.2, theme::colors(ui.ctx()).strong));
            painter
                .line_segment([back - wing, tip], Stroke::new(1.2, theme::colors(ui.ctx()).strong));
        }
        for (light, side) in split.lights.into_iter().zip([-1.0, 1.0]) {
            let at = centre + along * (16.0 * side) + vec2(0.0, 24.0);
            let align =
                if along.x * side < 0.0 { Align2::RIGHT_CENTER } else { Align2::LEFT_CENTER };
            draw_label(&painter, at, align, light);
        }
        response.on_hover_cursor(CursorIcon::ResizeHorizontal).on_hover_text(tr(
            "The first light is left of the line, the second one right of it. Drag to compare.",
        ));
    }

    /// Shows the switch in the upper left corner of the surface. `lights` are the names of the
    /// first and the second light.
    pub fn show_light_switch(&mut self, ui: &mut Ui, lights: [&str; 2]) {
        let corner = self.rect().min + vec2(6.0, 6.0);
        let room = Rect::from_min_size(corner, self.rect().size());
        let mut ui = ui.new_child(UiBuilder::new().max_rect(room));
        let fill = theme::colors(ui.ctx()).panel;
        let frame = Frame::new().fill(fill).corner_radius(4).inner_margin(Margin::same(2));
        let shown = frame.show(&mut ui, |ui| {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0;
                for (light, second) in lights.into_iter().zip([false, true]) {
                    ui.scope(|ui| {
                        ui.set_max_width(NAME_WIDTH);
                        let chosen = self.shows_second == second;
                        let button = Button::selectable(chosen, light).truncate().small();
                        let name = if second { tr("second") } else { tr("first") };
                        let tip = tr_format!(
                            "Shows the palette under the {name} light, {light}",
                            name,
                            light
                        );
                        let button = ui.add(button).on_hover_text(&tip);
                        if button.accessible_name(&tip).clicked() {
                            self.shows_second = second;
                        }
                    });
                }
            });
        });
        self.light_switch = Some(shown.response.rect);
    }

    /// Whether the switch shows the whole surface under the second light.
    #[must_use]
    pub fn shows_second_light(&self) -> bool {
        self.shows_second && self.picture(true).is_some()
    }

    /// Rectangle of the switch between the lights, if there is one.
    #[must_use]
    pub fn light_switch(&self) -> Option<Rect> {
        self.light_switch
    }
}

/// Draws a label over the picture.
fn draw_label(painter: &eframe::egui::Painter, at: Pos2, align: Align2, text: &str) {
    let font = FontId::proportional(11.0);
    let galley = painter.layout_no_wrap(text.to_owned(), font, theme::BOARD_TEXT);
    let rect = align.anchor_size(at, galley.size());
    painter.rect_filled(rect.expand2(vec2(5.0, 2.0)), 3.0, theme::BOARD);
    painter.galley(pos2(rect.left(), rect.top()), galley, theme::BOARD_TEXT);
}

/// Colour of the line at the edge of a surface.
const EDGE: u8 = 76;

/// A rectangle of physical pixels of the window.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Patch {
    /// First column of the window.
    pub left: usize,
    /// First row of the window.
    pub top: usize,
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// 8-bit sRGB and 255, row by row: `4 * width * height` bytes.
    pub rgba: Vec<u8>,
}

impl Patch {
    /// Pixels of a rectangle in points, at `density` physical pixels per point. They show the
    /// picture, its shadow and the surround.
    pub(super) fn of(picture: &Picture, placement: &Placement, rect: Rect, density: f32) -> Self {
        if !rect.is_positive() {
            return Self::default();
        }
        let [left, top] =
            [rect.min.x, rect.min.y].map(|at| (at * density).max(0.0).floor() as usize);
        let [right, bottom] =
            [rect.max.x, rect.max.y].map(|at| (at * density).max(0.0).ceil() as usize);
        let width = right - left;
        let height = bottom - top;
        let x = left as f32 + 0.5;
        let y = top as f32 + 0.5;
        let [from, right, down] = [(x, y), (x + 1.0, y), (x, y + 1.0)]
            .map(|(x, y)| placement.cell(pos2(x / density, y / density)));
        let [right, down] =
            [right, down].map(|to| [(to[0] - from[0]) as f32, (to[1] - from[1]) as f32]);
        let cells = Cells::new(picture, placement, density);
        let mut rgba = Vec::with_capacity(4 * width * height);
        for row in 0..height {
            let first = [0, 1].map(|axis: usize| from[axis] as f32 + row as f32 * down[axis]);
            for column in 0..width {
                let at = [0, 1].map(|axis: usize| first[axis] + column as f32 * right[axis]);
                rgba.extend(cells.color(at).to_array());
            }
        }
        Self { left, top, width, height, rgba }
    }
}

struct Cells<'a> {
    size: [f32; 2],
    /// Number of cells of the picture in a cell of this level, along each side.
    scale: f32,
    columns: usize,
    rows: usize,
    pixels: &'a [Color32],
    interpolate: bool,
    /// Number of points of the window per cell of the picture.
    points: f32,
}

impl<'a> Cells<'a> {
    fn new(picture: &'a Picture, placement: &Placement, density: f32) -> Self {
        let Shown { level, interpolate } = picture.shown(placement, f64::from(density));
        let (columns, pixels) = picture.levels().cells(level);
        let (width, height) = picture.cells();
        Self {
            size: [width as f32, height as f32],
            scale: (1_usize << level) as f32,
            columns,
            rows: pixels.len() / columns.max(1),
            pixels,
            interpolate,
            points: placement.scale() as f32,
        }
    }

    /// Colour at a place in cells.
    fn color(&self, [x, y]: [f32; 2]) -> Color32 {
        let outside = self.points * (-x).max(x - self.size[0]).max((-y).max(y - self.size[1]));
        let color = if outside < 0.0 {
            self.sample(x / self.scale, y / self.scale)
        } else {
            let share = (outside / SHADOW).min(1.0);
            let grey = lerp(f32::from(SHADE.r())..=f32::from(theme::SURROUND.r()), share);
            Color32::from_gray(grey.round() as u8)
        };
        // The line is half a point wide to both sides and fades out over another half.
        let covered = 1.0 - outside.abs();
        if covered > 0.0 { color.lerp_to_gamma(Color32::from_gray(EDGE), covered) } else { color }
    }

    /// Colour at a place in cells of the level.
    fn sample(&self, x: f32, y: f32) -> Color32 {
        let cell = |column: usize, row: usize| {
            self.pixels[row.min(self.rows - 1) * self.columns + column.min(self.columns - 1)]
        };
        if !self.interpolate {
            return cell(x as usize, y as usize);
        }
        // Weights have 8 bits, as in samplers of graphics cards.
        let [(column, right), (row, down)] = [x, y].map(|at| {
            let at = ((at - 0.5).max(0.0) * 256.0) as usize;
            (at >> 8, (at & 255) as u32)
        });
        let corners = [(column, row), (column + 1, row), (column, row + 1), (column + 1, row + 1)];
        let [a, b, c, d] = corners.map(|(column, row)| cell(column, row).to_array().map(u32::from));
        let [red, green, blue] = [0, 1, 2].map(|channel: usize| {
            let upper = a[channel] * (256 - right) + b[channel] * right;
            let lower = c[channel] * (256 - right) + d[channel] * right;
            ((upper * (256 - down) + lower * down + (1 << 15)) >> 16) as u8
        });
        Color32::from_rgb(red, green, blue)
    }
}

/// Largest width of a light's name, in points.
const NAME_WIDTH: f32 = 84.0;
