//! The mirrored twins of the stroke that is being painted.

use eframe::egui::{Color32, Painter, Shape, Stroke};
use paint::strokes::StrokeTool;
use session::{Command, PenSample};

use crate::pen::Twin;
use crate::view::Placement;

/// Twins of the open stroke. They are painted when it ends, because one stroke is open at a time.
#[derive(Debug)]
pub(super) struct TwinStrokes {
    twins: Vec<Twin>,
    tool: StrokeTool,
    brush: String,
    /// Samples of the open stroke.
    samples: Vec<PenSample>,
}

impl TwinStrokes {
    /// The twins of a stroke that begins with a brush as a tool.
    pub(super) fn new(twins: Vec<Twin>, tool: StrokeTool, brush: &str) -> Self {
        Self { twins, tool, brush: brush.to_owned(), samples: Vec::new() }
    }

    /// The tool and the brush of the stroke.
    pub(super) fn tool(&self) -> (StrokeTool, &str) {
        (self.tool, &self.brush)
    }

    /// Adds samples of the open stroke.
    pub(super) fn extend(&mut self, samples: &[PenSample]) {
        self.samples.extend_from_slice(samples);
    }

    /// Commands that paint the twins, each set down by `down`; none for a stroke without samples.
    pub(super) fn commands(&self, down: impl Fn() -> Command) -> Vec<Command> {
        if self.samples.is_empty() {
            return Vec::new();
        }
        self.twins
            .iter()
            .flat_map(|twin: &Twin| {
                let samples = self.samples.iter();
                [
                    down(),
                    Command::PenMove(
                        samples
                            .map(|of: &PenSample| PenSample {
                                sample: twin.sample(&of.sample),
                                ..*of
                            })
                            .collect(),
                    ),
                    Command::PenUp,
                ]
            })
            .collect()
    }

    /// Draws where the twins will be. Cells are `cell_mm` wide.
    pub(super) fn draw(&self, painter: &Painter, placement: &Placement, cell_mm: f64) {
        for twin in &self.twins {
            let points: Vec<_> = self
                .samples
                .iter()
                .map(|of: &PenSample| {
                    let place = twin.place([of.sample.x_mm, of.sample.y_mm]);
                    placement.point(place.map(|mm| mm / cell_mm))
                })
                .collect();
            for (width, color) in
                [(3.0, Color32::from_black_alpha(90)), (1.0, Color32::from_white_alpha(190))]
            {
                painter.add(Shape::line(points.clone(), Stroke::new(width, color)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use web_time::Instant;

    use paint::pose::Sample;

    use super::*;
    use crate::pen::{Symmetry, SymmetryKind};

    #[test]
    fn twins_are_whole_strokes_after_one_another() {
        let centre = [10.0, 10.0];
        let symmetry =
            Symmetry { on: true, kind: SymmetryKind::Radial, centre, angle_deg: 0.0, arms: 3 };
        let mut strokes = TwinStrokes::new(symmetry.twins(), StrokeTool::Paint, "round");
        for x_mm in [12.0, 14.0] {
            let sample = Sample::upright(0.1 * x_mm, x_mm, 10.0, 0.5);
            strokes.extend(&[PenSample { sample, arrived: Instant::now() }]);
        }
        let commands = strokes.commands(|| Command::BeginGroup);
        assert_eq!(commands.len(), 6);
        for twin in commands.chunks(3) {
            let [Command::BeginGroup, Command::PenMove(samples), Command::PenUp] = twin else {
                panic!("{twin:?}")
            };
            let fars: Vec<f64> = samples
                .iter()
                .map(|sample: &PenSample| {
                    (sample.sample.x_mm - 10.0).hypot(sample.sample.y_mm - 10.0)
                })
                .collect();
            assert!((fars[0] - 2.0).abs() < 1e-9 && (fars[1] - 4.0).abs() < 1e-9, "{fars:?}");
        }
    }
}
