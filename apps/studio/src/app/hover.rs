//! Marks that move with the pen: the head of a hovering brush, the mirrored twins of a stroke, and the
//! dashes of a mask.

use eframe::egui::{Color32, Painter, Shape, Stroke};
use paint::brush::{Head, Relief};
use paint::pose::Sample;
use paint::strokes::{BrushSpec, StrokeTool, SurfaceId};
use session::{Command, HeadOnCanvas, PenSample};

use crate::pen::Twin;
use crate::view::Placement;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Hover {
    pub(super) surface: SurfaceId,
    /// Position, tilt and twist of the brush.
    pub(super) sample: Sample,
    pub(super) brush: String,
}

/// Cached mesh of a hovering brush head, undeformed, over a level surface.
#[derive(Debug)]
pub(super) struct HoveringHead {
    spec: BrushSpec,
    head: Head,
    level: Relief,
}

impl HoveringHead {
    /// Builds the head of a brush; `None` if the size is invalid for the cell size.
    pub(super) fn of(spec: &BrushSpec, cell_mm: f64) -> Option<Self> {
        let head = Head::new(spec.shape, spec.size_mm, cell_mm).ok()?;
        Some(Self { spec: spec.clone(), head, level: Relief::flat(1, 1, cell_mm) })
    }

    /// Whether we built this head for the same brush head and cell size.
    pub(super) fn is_of(&self, spec: &BrushSpec, cell_mm: f64) -> bool {
        self.spec == *spec && self.level.cell_mm() == cell_mm
    }

    /// Places the head at the hover position. `None` if the head has no mesh.
    pub(super) fn over(&mut self, hover: &Hover) -> Option<HeadOnCanvas> {
        self.head.hover(&hover.sample.pose(self.level.cell_mm()), &self.level);
        let mesh = self.head.mesh()?;
        let surface = hover.surface;
        Some(HeadOnCanvas {
            surface,
            around: mesh.around,
            along: mesh.along,
            vertices: mesh.vertices,
        })
    }
}

/// Twins of the open stroke, i.e. its symmetrical copies. We paint them when it ends, because only one
/// stroke can be open at a time.
#[derive(Debug)]
pub(super) struct TwinStrokes {
    twins: Vec<Twin>,
    tool: StrokeTool,
    brush: String,
    samples: Vec<PenSample>,
}

impl TwinStrokes {
    /// The twins of a stroke that begins with a brush as a tool.
    pub(super) fn new(twins: Vec<Twin>, tool: StrokeTool, brush: &str) -> Self {
        Self { twins, tool, brush: brush.to_owned(), samples: Vec::new() }
    }

    pub(super) fn tool(&self) -> (StrokeTool, &str) {
        (self.tool, &self.brush)
    }

    pub(super) fn extend(&mut self, samples: &[PenSample]) {
        self.samples.extend_from_slice(samples);
    }

    /// Commands that paint the twins, or none if the stroke has no samples. `down` makes the
    /// command that begins each twin.
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

    /// Draws the paths of the twins, the symmetrical copies of the open stroke. Cells are `cell_mm` wide.
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

/// Length of a dash of the outline, in points.
pub(super) const DASH: f32 = 5.0;

/// The outline moves by this many dashes in a second.
const DASHES_A_SECOND: f64 = 2.0;

/// The dashes move for this time after the last input, in seconds.
const MOVES: f64 = 3.0;

/// Dashes that move for a while after each input.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Dashes {
    /// Time of the last input, in seconds.
    last: Option<f64>,
}

impl Dashes {
    /// Movement of the dashes at `now`, in points, and whether they still move. Times are in
    /// seconds. `happens` says whether there was input in this frame.
    pub(super) fn phase(&mut self, now: f64, happens: bool) -> (f32, bool) {
        if happens {
            self.last = Some(now);
        }
        let stop = *self.last.get_or_insert(now) + MOVES;
        let phase = (now.min(stop) * DASHES_A_SECOND).rem_euclid(2.0) as f32 * DASH;
        (phase, now < stop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::{Symmetry, SymmetryKind};
    use paint::pose::Sample;
    use web_time::Instant;

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

    #[test]
    fn dashes_move_after_input_and_then_stand_still() {
        let mut dashes = Dashes::default();
        assert_eq!(dashes.phase(100.0, false), (0.0, true), "they begin with a mask");
        assert_eq!(dashes.phase(100.25, false), (0.5 * DASH, true));
        assert_eq!(dashes.phase(102.75, true), (1.5 * DASH, true));
        assert_eq!(dashes.phase(105.5, false), (DASH, true), "input prolongs it");
        let still = dashes.phase(105.75, false);
        assert_eq!(still, (1.5 * DASH, false));
        assert_eq!(dashes.phase(900.0, false), still);
        assert_eq!(dashes.phase(901.0, true), (0.0, true), "and input begins it again");
    }
}
