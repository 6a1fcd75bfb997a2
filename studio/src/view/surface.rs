//! One surface in the window: its view, its pictures, and the hand that moves it.

use eframe::egui::{
    Align2, Color32, CursorIcon, FontId, Id, MouseWheelSource, PointerButton, Pos2, Rect, Response,
    Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2,
};

use super::head::{self, HeadLook};
use super::outline::Outline;
use super::texture::{Half, Picture};
use super::transform::{Placement, View};
use crate::theme;
use session::{HeadOnCanvas, TilePixels};

/// Zoom of one notch of a wheel is `exp(50 points / this)`.
const WHEEL_POINTS: f32 = 220.0;

/// What the pointer does with the view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Hand {
    /// Nothing: it paints.
    #[default]
    Free,
    /// It moves it.
    Pan,
    /// It turns it about its middle.
    Rotate,
    /// It zooms, upwards in.
    Zoom,
}

/// The line between the pictures of two lights.
#[derive(Debug)]
pub struct Split<'a> {
    /// Where it is, as a share of the width.
    pub at: &'a mut f32,
    /// What the lights left and right of it are called.
    pub lights: [&'a str; 2],
}

/// A surface in the window.
#[derive(Debug)]
pub struct SurfaceView {
    /// What of it is seen.
    pub view: View,
    name: &'static str,
    outline: Outline,
    margin: f32,
    first: Picture,
    second: Option<Picture>,
    room: Rect,
    density: f32,
    grip: Hand,
    knob: Option<Rect>,
}

impl SurfaceView {
    /// A surface without paint, shown whole with `margin` points around it.
    #[must_use]
    pub fn new(name: &'static str, outline: Outline, margin: f32) -> Self {
        Self {
            view: View::default(),
            name,
            outline,
            margin,
            first: Picture::new(name, (1, 1)),
            second: None,
            room: Rect::NOTHING,
            density: 1.0,
            grip: Hand::Free,
            knob: None,
        }
    }

    /// Takes up another surface of so many cells, shown whole.
    pub fn take_up(&mut self, cells: (usize, usize)) {
        self.first = Picture::new(self.name, cells);
        self.second = None;
        self.view = View { mirror: self.view.mirror, ..View::default() };
    }

    /// Shows the picture under a second light too, or no longer.
    pub fn set_second(&mut self, there: bool) {
        if there && self.second.is_none() {
            self.second = Some(Picture::new(self.name, self.cells()));
        } else if !there {
            self.second = None;
        }
    }

    /// Takes what the worker told of one of the pictures.
    pub fn write(&mut self, second: bool, tile: &TilePixels) {
        let (name, cells) = (self.name, self.cells());
        let picture = if second {
            // Its tiles may be told before the light is.
            self.second.get_or_insert_with(|| Picture::new(name, cells))
        } else {
            &mut self.first
        };
        picture.write(tile);
    }

    /// Its cells, across and down.
    #[must_use]
    pub fn cells(&self) -> (usize, usize) {
        self.first.cells()
    }

    /// The picture, or the one under the second light.
    #[must_use]
    pub fn picture(&self, second: bool) -> Option<&Picture> {
        if second { self.second.as_ref() } else { Some(&self.first) }
    }

    /// Where the surface was in the window when it was last shown.
    #[must_use]
    pub fn room(&self) -> Rect {
        self.room
    }

    /// What moves the line between two lights, if there are two.
    #[must_use]
    pub fn knob(&self) -> Option<Rect> {
        self.knob
    }

    /// Where its cells are on the screen.
    #[must_use]
    pub fn placement(&self) -> Placement {
        self.view.placed(self.room, self.density)
    }

    /// The place, in cells, at a point of the window, if the surface is there.
    #[must_use]
    pub fn place(&self, point: Pos2) -> Option<[f64; 2]> {
        let place = self.placement().cell(point);
        let on = self.room.contains(point) && self.outline.contains(place, self.cells());
        on.then_some(place)
    }

    /// Shows all of it.
    pub fn fit(&mut self) {
        self.view.fit(self.cells(), self.room, self.margin, self.density);
    }

    /// Shows it in a rectangle of the window. `hand` is what a drag with the first
    /// button that begins now would do; the middle one always moves the view.
    pub fn show(&mut self, ui: &mut Ui, room: Rect, hand: Hand, split: Option<Split>) -> Response {
        self.room = room;
        self.density = ui.ctx().pixels_per_point();
        let id = Id::unique(("surface", self.name));
        let response = ui.interact(room, id, Sense::click_and_drag());
        let name = self.name;
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, name));
        self.moved(ui, &response, hand);
        if self.view.fitted {
            self.fit();
        }
        let placement = self.placement();
        let painter = ui.painter_at(room);
        self.knob = None;
        self.outline.under(&painter, &placement, self.cells());
        match (&mut self.second, split) {
            (Some(second), Some(split)) => {
                let column = f64::from(*split.at) * self.first.cells().0 as f64;
                self.first.draw(&painter, &placement, Half::Left(column));
                second.draw(&painter, &placement, Half::Right(column));
                self.outline.over(&painter, &placement, self.first.cells());
                self.split_line(ui, &placement, split);
            }
            _ => {
                self.first.draw(&painter, &placement, Half::Whole);
                self.outline.over(&painter, &placement, self.first.cells());
            }
        }
        response
    }

    /// Draws a head over it.
    pub fn show_head(&self, ui: &Ui, over: &HeadOnCanvas, look: HeadLook) {
        head::draw(&ui.painter_at(self.room), &self.placement(), over, look);
    }

    /// Moves the view as pointer, wheel and fingers ask.
    fn moved(&mut self, ui: &Ui, response: &Response, hand: Hand) {
        let (room, density) = (self.room, self.density);
        if response.drag_started_by(PointerButton::Middle) {
            self.grip = Hand::Pan;
        } else if response.drag_started_by(PointerButton::Primary) {
            self.grip = hand;
        }
        let delta = response.drag_delta();
        match (self.grip, response.interact_pointer_pos()) {
            (Hand::Pan, Some(_)) => self.view.pan(delta, density),
            (Hand::Rotate, Some(now)) => {
                let arm = |point: Pos2| (point - room.center()).angle();
                let turned = f64::from(arm(now) - arm(now - delta));
                self.view.rotate(turned);
                self.view.fitted = false;
            }
            (Hand::Zoom, Some(now)) => {
                let start = ui.input(|input| input.pointer.press_origin()).unwrap_or(now);
                self.view.zoom_by(f64::from(-delta.y / 120.0).exp(), start, room, density);
            }
            _ => {}
        }
        if !response.dragged() {
            self.grip = Hand::Free;
        }
        let cursor = match (self.grip, hand) {
            (Hand::Pan, _) => Some(CursorIcon::Grabbing),
            (Hand::Free, Hand::Pan) => Some(CursorIcon::Grab),
            (Hand::Rotate, _) | (_, Hand::Rotate) => Some(CursorIcon::Alias),
            (Hand::Zoom, _) | (_, Hand::Zoom) => Some(CursorIcon::ZoomIn),
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
            self.view.zoom_by(f64::from(touch.zoom_delta), centre, room, density);
            self.view.rotate_about(f64::from(touch.rotation_delta), centre, room, density);
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
            self.view.zoom_by(f64::from(factor), pointer, room, density);
        }
    }

    /// Draws the line between two lights, and moves it.
    fn split_line(&mut self, ui: &mut Ui, placement: &Placement, split: Split) {
        let (width, height) = (self.cells().0 as f64, self.cells().1 as f64);
        let ends = |at: f32| {
            let column = f64::from(at) * width;
            [placement.point([column, 0.0]), placement.point([column, height])]
        };
        let middle = |at: f32| self.room.shrink(16.0).clamp(ends(at)[0].lerp(ends(at)[1], 0.5));
        let knob = Rect::from_center_size(middle(*split.at), vec2(22.0, 22.0));
        self.knob = Some(knob);
        let response = ui.interact(knob, Id::unique(("split", self.name)), Sense::drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, "Split of two lights"));
        if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            *split.at = (placement.cell(pointer)[0] / width).clamp(0.0, 1.0) as f32;
        }
        let painter = ui.painter_at(self.room);
        painter.line_segment(ends(*split.at), Stroke::new(3.0, Color32::from_black_alpha(90)));
        painter.line_segment(ends(*split.at), Stroke::new(1.0, theme::STRONG));
        let centre = middle(*split.at);
        let fill = if response.hovered() { theme::CHOSEN } else { theme::PANEL };
        painter.circle(centre, 10.0, fill, Stroke::new(1.0, theme::STRONG));
        // Arrows along the surface's rows, whichever way it is turned.
        let along = placement.direction([1.0, 0.0]).normalized();
        for side in [-1.0, 1.0] {
            let tip = centre + along * (6.0 * side);
            let wing = along.rot90() * 3.0;
            let back = tip - along * (3.0 * side);
            painter.line_segment([back + wing, tip], Stroke::new(1.2, theme::STRONG));
            painter.line_segment([back - wing, tip], Stroke::new(1.2, theme::STRONG));
        }
        for (light, side) in split.lights.into_iter().zip([-1.0, 1.0]) {
            let at = centre + along * (16.0 * side) + vec2(0.0, 24.0);
            let align =
                if along.x * side < 0.0 { Align2::RIGHT_CENTER } else { Align2::LEFT_CENTER };
            tag(&painter, at, align, light);
        }
        response.on_hover_cursor(CursorIcon::ResizeHorizontal).on_hover_text(
            "Left of the line is the light, right of it the second one. Drag to compare.",
        );
    }
}

/// A few words over the picture.
fn tag(painter: &eframe::egui::Painter, at: Pos2, align: Align2, text: &str) {
    let font = FontId::proportional(11.0);
    let galley = painter.layout_no_wrap(text.to_owned(), font, theme::STRONG);
    let rect = align.anchor_size(at, galley.size());
    painter.rect_filled(rect.expand2(vec2(5.0, 2.0)), 3.0, Color32::from_black_alpha(150));
    painter.galley(pos2(rect.left(), rect.top()), galley, theme::STRONG);
}
