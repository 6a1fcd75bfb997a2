//! A field in a window on which the pen draws as it would paint, to try its settings.

use web_time::Instant;

use eframe::egui::{Pos2, Rect, pos2};
use paint::strokes::SurfaceId;

use super::handling::Handling;
use super::input::Pen;
use super::pen_stroke::PenStroke;
use super::report::{Report, ReportKind};
use super::transform::SurfaceTransform;

/// Millimetres of a point of the window, at the usual 96 points an inch.
const MM_PER_POINT: f64 = 25.4 / 96.0;

/// Strokes that stay in the field.
const MOST_STROKES: usize = 8;

/// A sample of a stroke in the field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TestPoint {
    /// Place in points from the upper left corner of the field.
    pub at: Pos2,
    /// Pressure of the brush, 0 to 1.
    pub pressure: f64,
}

/// Strokes that were drawn on a field.
#[derive(Debug, Default)]
pub struct TestField {
    stroke: Option<PenStroke>,
    strokes: Vec<Vec<TestPoint>>,
}

impl TestField {
    /// Draws with the reports of this frame that are in `area`, as far as `reachable` tells that
    /// nothing lies above it. The pen's settings and options are used.
    pub fn update(&mut self, pen: &Pen, area: Rect, reachable: bool, now: Instant) {
        for report in pen.reports() {
            self.handle(report, area, reachable, &pen.handling(report.device));
        }
        if let Some(stroke) = &mut self.stroke {
            stroke.add_rest_sample(now, &pen.handling(stroke.device));
        }
        self.take_samples();
    }

    /// The strokes in the order of drawing.
    #[must_use]
    pub fn strokes(&self) -> &[Vec<TestPoint>] {
        &self.strokes
    }

    /// Whether a stroke is open.
    #[must_use]
    pub fn is_drawing(&self) -> bool {
        self.stroke.is_some()
    }

    /// Removes all strokes.
    pub fn clear(&mut self) {
        (self.stroke, self.strokes) = (None, Vec::new());
    }

    fn handle(&mut self, report: &Report, area: Rect, reachable: bool, handling: &Handling<'_>) {
        let Report { device, arrived, kind } = *report;
        match kind {
            ReportKind::Pressed(state) if reachable && area.contains(state.at) => {
                self.finish(arrived, handling);
                let corner = area.min;
                let transform = SurfaceTransform::new(SurfaceId::Canvas, area, |at| {
                    let place = at - corner;
                    (f64::from(place.x) * MM_PER_POINT, f64::from(place.y) * MM_PER_POINT)
                });
                self.stroke =
                    Some(PenStroke::new(device, state, arrived, (transform, None), None, handling));
                self.strokes.push(Vec::new());
                let surplus = self.strokes.len().saturating_sub(MOST_STROKES);
                self.strokes.drain(..surplus);
            }
            ReportKind::Moved(state) => {
                if let Some(stroke) = &mut self.stroke {
                    stroke.extend(state, arrived, handling);
                }
            }
            ReportKind::Released | ReportKind::Gone => self.finish(arrived, handling),
            ReportKind::Pressed(_) | ReportKind::Barrel { .. } => {}
        }
    }

    fn finish(&mut self, at: Instant, handling: &Handling<'_>) {
        if let Some(stroke) = &mut self.stroke {
            stroke.finish(at, handling);
            self.take_samples();
            self.stroke = None;
        }
    }

    fn take_samples(&mut self) {
        let (Some(stroke), Some(points)) = (&mut self.stroke, self.strokes.last_mut()) else {
            return;
        };
        points.extend(stroke.take_samples().into_iter().map(|taken| {
            let point = |mm: f64| (mm / MM_PER_POINT) as f32;
            let sample = taken.sample;
            TestPoint {
                at: pos2(point(sample.x_mm), point(sample.y_mm)),
                pressure: sample.pressure,
            }
        }));
    }
}
