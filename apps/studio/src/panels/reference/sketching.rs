//! Draws marks and guides with the pointer, and shows them on the picture.

use eframe::egui::{Color32, Pos2, Rect, Response, Ui, vec2};

use super::mode::ReferenceMode;
use super::overlay::{Overlay, screen_color};
use super::picture_view::PictureView;
use super::pointer_line::Drawn;
use super::state::Reference;
use super::traced::traced;

/// Distance in points within which a click selects a line.
const REACH: f32 = 8.0;

/// Least bend in pixels of the picture, and in points of the window, that a line keeps.
const TOLERANCE_PX: f32 = 0.5;
const TOLERANCE_POINTS: f32 = 0.75;

impl Reference {
    /// Takes the pointer's movements over the picture in this frame.
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

    /// A line from stroke to stroke, or clicks on both, are the distance of strokes.
    fn sketch_spacing(&mut self, drawn: Drawn, place: impl Fn(Pos2) -> [f64; 2], size: [usize; 2]) {
        let (from, to) = match drawn {
            Drawn::Line(points) => match points[..] {
                [first, .., last] => (place(first), place(last)),
                _ => return,
            },
            Drawn::Click(point) => match self.first_place {
                Some(first) => (first, place(point)),
                None => {
                    let inside = |(at, side): (f64, usize)| (0.0..side as f64).contains(&at);
                    let at = place(point);
                    self.first_place = at.into_iter().zip(size).all(inside).then_some(at);
                    return;
                }
            },
        };
        if let [from, .., to] = traced(&[from, to], size, f64::INFINITY)[..] {
            self.first_place = None;
            self.samples.set_spacing([from, to], size);
        }
    }

    /// Draws the lines of the mode over the picture.
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
}
