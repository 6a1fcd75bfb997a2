//! A line that is being drawn with the pointer.

use eframe::egui::{Event, PointerButton, Pos2, Response, Ui};

/// Distance in points up to which a press and release is a click, not a line.
const CLICK_POINTS: f32 = 4.0;

/// The points of the window that the pointer passed with the primary button held.
#[derive(Debug, Default)]
pub(super) struct PointerLine {
    points: Vec<Pos2>,
}

/// A finished movement of the pointer.
#[derive(Debug, PartialEq)]
pub(super) enum Drawn {
    /// A line through these points of the window.
    Line(Vec<Pos2>),
    /// A click at a point of the window.
    Click(Pos2),
}

impl PointerLine {
    /// Takes the pointer events of this frame over an area. Returns a movement that has ended.
    pub(super) fn update(&mut self, ui: &Ui, area: &Response) -> Option<Drawn> {
        let own = area.is_pointer_button_down_on() || area.clicked() || area.drag_stopped();
        let mut ended = None;
        ui.input(|input| {
            for event in &input.events {
                match *event {
                    Event::PointerButton {
                        pos,
                        button: PointerButton::Primary,
                        pressed: true,
                        ..
                    } if own && area.rect.contains(pos) => self.points = vec![pos],
                    Event::PointerMoved(pos) if !self.points.is_empty() => self.points.push(pos),
                    Event::PointerButton {
                        pos,
                        button: PointerButton::Primary,
                        pressed: false,
                        ..
                    } if !self.points.is_empty() => {
                        self.points.push(pos);
                        ended = Some(drawn(std::mem::take(&mut self.points)));
                    }
                    _ => {}
                }
            }
        });
        ended
    }

    /// Forgets the line.
    pub(super) fn clear(&mut self) {
        self.points.clear();
    }

    /// The points so far.
    pub(super) fn points(&self) -> &[Pos2] {
        &self.points
    }
}

fn drawn(points: Vec<Pos2>) -> Drawn {
    let first = points[0];
    if points.iter().all(|point| point.distance(first) <= CLICK_POINTS) {
        Drawn::Click(first)
    } else {
        Drawn::Line(points)
    }
}
