//! Drawing aids as data. A ruler or a perspective guide leads strokes, and symmetry repeats them.
//! Lines show the aids, and you move them by handles. Positions are in mm of the canvas.

mod shapes;

use serde::{Deserialize, Serialize};

use shapes::{Course, Place, across, dot, length, moved, unit, upright_turned, way};

pub use shapes::{Perspective, Ruler, RulerShape, Symmetry, SymmetryKind, Twin};

/// Kind of a guide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GuideKind {
    /// The ruler, straight or an ellipse.
    Ruler,
    /// The perspective guide with its vanishing points.
    Perspective,
}

/// A guide that leads strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Guide {
    /// The ruler. Each stroke keeps to it.
    Ruler(Ruler),
    /// Perspective. Each stroke keeps to the line from its start to a vanishing point.
    Perspective(Perspective),
}

impl Guide {
    /// The line or ellipse that leads a stroke from `start`. With perspective it depends on the
    /// direction to `to` too. `None` if there is none.
    fn course(&self, start: Place, to: Place) -> Option<Course> {
        match self {
            Self::Ruler(ruler) => ruler.course(start),
            Self::Perspective(perspective) => perspective.course(start, to),
        }
    }
}

/// The drawing aids of a painting: one guide at a time, and symmetry. They are off at first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct DrawingAids {
    /// The guide that you see.
    pub guide: Option<GuideKind>,
    /// Whether the guide leads strokes. If not, you only see it.
    pub snaps: bool,
    /// The ruler, shown or not.
    pub ruler: Ruler,
    /// The perspective guide, shown or not.
    pub perspective: Perspective,
    /// Symmetry, on or off.
    pub symmetry: Symmetry,
    /// Width and height of the canvas that the aids lie on, in mm.
    pub canvas_mm: [f64; 2],
}

impl Default for DrawingAids {
    fn default() -> Self {
        Self {
            guide: None,
            snaps: true,
            ruler: Ruler::default(),
            perspective: Perspective::default(),
            symmetry: Symmetry::default(),
            canvas_mm: [0.0; 2],
        }
    }
}

impl DrawingAids {
    /// Shows this guide instead of another one. If it is shown, this hides it.
    pub fn toggle(&mut self, kind: GuideKind) {
        self.guide = if self.guide == Some(kind) { None } else { Some(kind) };
    }

    /// The guide that leads strokes, if any.
    #[must_use]
    pub fn leading(&self) -> Option<Guide> {
        let guide = match self.guide? {
            GuideKind::Ruler => Guide::Ruler(self.ruler),
            GuideKind::Perspective => Guide::Perspective(self.perspective),
        };
        self.snaps.then_some(guide)
    }

    /// Moves all aids to their usual places on a canvas of this width and height in mm. This does
    /// nothing if the canvas had this size before.
    pub fn fit(&mut self, canvas_mm: [f64; 2]) {
        if self.canvas_mm != canvas_mm {
            self.canvas_mm = canvas_mm;
            self.put_back();
        }
    }

    /// Moves all aids to their usual places on the canvas.
    pub fn put_back(&mut self) {
        let [width, height] = self.canvas_mm;
        self.ruler = Ruler::in_middle_of(self.canvas_mm, self.ruler.shape);
        self.perspective = Perspective::in_middle_of(self.canvas_mm, self.perspective.count);
        self.symmetry.centre = [0.5 * width, 0.5 * height];
        self.symmetry.angle_deg = 0.0;
    }

    /// Sets the number of vanishing points, 1 to 3, and moves them to their usual places.
    pub fn set_vanishing_points(&mut self, count: usize) {
        self.perspective = Perspective::in_middle_of(self.canvas_mm, count);
    }

    /// Lines that show the visible aids.
    #[must_use]
    pub fn lines(&self) -> AidLines {
        let mut lines = AidLines::default();
        // This is far enough to leave the canvas from every place on it.
        let far = 2.0 * length(self.canvas_mm);
        match self.guide {
            Some(GuideKind::Ruler) => self.ruler.lines(self.canvas_mm, far, &mut lines),
            Some(GuideKind::Perspective) => {
                self.perspective.lines(self.canvas_mm, far, &mut lines);
            }
            None => {}
        }
        if self.symmetry.on {
            let centre = self.symmetry.centre;
            let rays = self.symmetry.rays().into_iter();
            lines.main.extend(rays.map(|ray| vec![centre, moved(centre, ray, far)]));
        }
        lines
    }

    /// Handles of the visible aids.
    #[must_use]
    pub fn handles(&self) -> Vec<AidHandle> {
        let mut handles = match (self.guide, self.ruler.shape) {
            (Some(GuideKind::Ruler), RulerShape::Line | RulerShape::Parallel) => {
                vec![AidHandle::End(0), AidHandle::End(1)]
            }
            (Some(GuideKind::Ruler), RulerShape::Ellipse | RulerShape::Concentric) => {
                vec![AidHandle::Middle, AidHandle::Tip, AidHandle::Side]
            }
            (Some(GuideKind::Perspective), _) => {
                (0..self.perspective.in_use().len()).map(AidHandle::Vanishing).collect()
            }
            (None, _) => Vec::new(),
        };
        if self.symmetry.on {
            handles.push(AidHandle::Centre);
            // Turned twins do not depend on the angle.
            if self.symmetry.kind != SymmetryKind::Radial {
                handles.push(AidHandle::Axis);
            }
        }
        handles
    }

    /// Place of a handle in mm of the canvas.
    #[must_use]
    pub fn place_of(&self, handle: AidHandle) -> [f64; 2] {
        match handle {
            AidHandle::End(end) => self.ruler.ends[end.min(1)],
            AidHandle::Middle => self.ruler.middle,
            AidHandle::Tip => self.ruler.tip,
            AidHandle::Side => self.ruler.side(),
            AidHandle::Vanishing(number) => self.perspective.points[number.min(2)],
            AidHandle::Centre => self.symmetry.centre,
            AidHandle::Axis => {
                let [width, height] = self.canvas_mm;
                let up = upright_turned(self.symmetry.angle_deg);
                moved(self.symmetry.centre, up, ARM * width.min(height))
            }
        }
    }

    /// Moves a handle to a place in mm of the canvas, or as near as it can be. Only vanishing
    /// points can leave the canvas.
    pub fn move_to(&mut self, handle: AidHandle, to: [f64; 2]) {
        let [width, height] = self.canvas_mm;
        let inside = [to[0].clamp(0.0, width.max(0.0)), to[1].clamp(0.0, height.max(0.0))];
        match handle {
            AidHandle::End(end) => self.ruler.ends[end.min(1)] = inside,
            AidHandle::Middle => {
                let by = way(self.ruler.middle, inside);
                self.ruler.middle = inside;
                self.ruler.tip = moved(self.ruler.tip, by, 1.0);
            }
            AidHandle::Tip => self.ruler.tip = to,
            AidHandle::Side => self.ruler.half_width_mm = self.half_width(to),
            AidHandle::Vanishing(number) => self.perspective.points[number.min(2)] = to,
            AidHandle::Centre => self.symmetry.centre = inside,
            AidHandle::Axis => {
                let [right, down] = way(self.symmetry.centre, to);
                if length([right, down]) > 1e-6 {
                    self.symmetry.angle_deg = stepped(right.atan2(-down).to_degrees());
                }
            }
        }
    }

    /// Distance of a place from the axis through the middle of the ellipse and its tip.
    fn half_width(&self, to: Place) -> f64 {
        let axis = unit(way(self.ruler.middle, self.ruler.tip)).unwrap_or([1.0, 0.0]);
        dot(across(axis), way(self.ruler.middle, to)).abs()
    }
}

type Spot = (f64, f64);

/// How a guide leads one stroke.
#[derive(Debug, Clone)]
pub(super) struct Lead {
    state: State,
    last: Option<Spot>,
}

#[derive(Debug, Clone)]
enum State {
    Free,
    /// We need the start and direction of the stroke to choose the line.
    Undecided {
        guide: Guide,
        start: Option<Spot>,
        decided_mm: f64,
    },
    /// The stroke keeps to this line.
    Along(Course),
}

impl Lead {
    /// The lead of a new stroke. With perspective, we choose the line once the pen is `decided_mm`
    /// away from the start.
    pub(super) fn new(guide: Option<Guide>, decided_mm: f64) -> Self {
        Self {
            state: guide.map_or(State::Free, |guide| State::Undecided {
                guide,
                start: None,
                decided_mm,
            }),
            last: None,
        }
    }

    /// Whether the stroke follows the pen freely.
    pub(super) fn is_off(&self) -> bool {
        matches!(self.state, State::Free)
    }

    pub(super) fn is_open(&self) -> bool {
        matches!(self.state, State::Undecided { .. })
    }

    pub(super) fn last(&self) -> Option<Spot> {
        self.last
    }

    /// Leads the brush: returns the place of the stroke for a place of the brush. While the line is
    /// undecided, both are the same.
    pub(super) fn follow(&mut self, place: Spot) -> Spot {
        self.decide(place);
        let led = self.led(place);
        self.last = Some(led);
        led
    }

    /// Like [`Lead::follow`], but this only asks and changes nothing.
    pub(super) fn led(&self, place: Spot) -> Spot {
        match &self.state {
            State::Along(course) => course.led(place.into()).into(),
            State::Free | State::Undecided { .. } => place,
        }
    }

    /// Stops waiting for the direction of the stroke. A stroke too short to have one is free.
    pub(super) fn settle(&mut self) {
        if self.is_open() {
            self.state = State::Free;
        }
    }

    fn decide(&mut self, place: Spot) {
        let State::Undecided { guide, start, decided_mm } = &mut self.state else { return };
        let start = *start.get_or_insert(place);
        let far = length(way(start.into(), place.into())) >= *decided_mm;
        if let Guide::Ruler(_) = guide {
            let course = guide.course(start.into(), place.into());
            self.state = course.map_or(State::Free, State::Along);
        } else if far && let Some(course) = guide.course(start.into(), place.into()) {
            self.state = State::Along(course);
        }
    }
}

/// Number of lines of the fan of one vanishing point.
const FAN: usize = 16;

/// Number of parallel lines on each side of a straight ruler. An ellipse has as many ellipses of
/// the same form inside, and as many outside.
const BESIDE: i8 = 3;

/// Number of pieces of an ellipse.
const PIECES: usize = 96;

/// Polylines that show the drawing aids, in mm of the canvas. They continue beyond it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AidLines {
    /// The ruler, the horizon and the axes of symmetry.
    pub main: Vec<Vec<[f64; 2]>>,
    /// Fans of the vanishing points, parallel lines, and ellipses of the same form.
    pub faint: Vec<Vec<[f64; 2]>>,
}

impl Ruler {
    fn lines(&self, [width, height]: Place, far: f64, lines: &mut AidLines) {
        if let RulerShape::Ellipse | RulerShape::Concentric = self.shape {
            let Some(axes) = self.axes() else { return };
            lines.main.push(ellipse(self.middle, axes, 1.0));
            if self.shape == RulerShape::Concentric {
                let scales = (1..=BESIDE).map(|at| f64::from(at) / f64::from(BESIDE + 1));
                let scales = scales.flat_map(|scale| [scale, 1.0 + scale]);
                lines.faint.extend(scales.map(|scale| ellipse(self.middle, axes, scale)));
            }
            return;
        }
        let Some(along) = unit(way(self.ends[0], self.ends[1])) else { return };
        let through = |at: Place| vec![moved(at, along, -far), moved(at, along, far)];
        lines.main.push(through(self.ends[0]));
        if self.shape == RulerShape::Parallel {
            let step = 0.12 * width.min(height);
            let places = (-BESIDE..=BESIDE).filter(|at| *at != 0);
            let places = places.map(|at| moved(self.ends[0], across(along), f64::from(at) * step));
            lines.faint.extend(places.map(through));
        }
    }
}

impl Perspective {
    fn lines(&self, canvas: Place, far: f64, lines: &mut AidLines) {
        let at = self.in_use()[0];
        let along = self.horizon();
        // The horizon crosses the canvas wherever the vanishing point lies.
        let reach = far + self.in_use().iter().map(|&point| length(way(at, point))).sum::<f64>();
        let reach = reach + length(way(at, [0.0; 2]));
        lines.main.push(vec![moved(at, along, -reach), moved(at, along, reach)]);
        for &point in self.in_use() {
            lines.faint.extend(fan(point, canvas));
        }
    }
}

/// Lines from a vanishing point over a canvas, at equal angles. If the point is on the canvas, they
/// go in all directions.
fn fan(point: Place, [width, height]: Place) -> Vec<Vec<Place>> {
    let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
    let far = corners.map(|corner| length(way(point, corner))).into_iter().fold(0.0, f64::max);
    let on = (0.0..=width).contains(&point[0]) && (0.0..=height).contains(&point[1]);
    let Some(middle) = unit(way(point, [0.5 * width, 0.5 * height])).filter(|_| !on) else {
        let step = std::f64::consts::TAU / (2 * FAN) as f64;
        return (0..2 * FAN)
            .map(|at: usize| {
                let (sin, cos) = (at as f64 * step).sin_cos();
                vec![point, moved(point, [cos, sin], far)]
            })
            .collect();
    };
    let angles = corners.map(|corner| {
        let to = way(point, corner);
        dot(across(middle), to).atan2(dot(middle, to))
    });
    let [least, most] =
        [angles.into_iter().fold(0.0, f64::min), angles.into_iter().fold(0.0, f64::max)];
    (0..=FAN)
        .map(|at: usize| {
            let (sin, cos) = (least + (most - least) * at as f64 / FAN as f64).sin_cos();
            let direction = moved(middle.map(|part| part * cos), across(middle), sin);
            vec![point, moved(point, direction, far)]
        })
        .collect()
}

/// The outline of an ellipse with scaled half axes.
fn ellipse(middle: Place, axes: [Place; 2], scale: f64) -> Vec<Place> {
    (0..=PIECES)
        .map(|piece: usize| {
            let (sin, cos) = (std::f64::consts::TAU * piece as f64 / PIECES as f64).sin_cos();
            moved(moved(middle, axes[0], scale * cos), axes[1], scale * sin)
        })
        .collect()
}

/// An axis jumps to a multiple of 15 degrees within this angle, in degrees.
const SNAP_DEG: f64 = 2.0;

const STEP_DEG: f64 = 15.0;

/// Distance from the centre of the symmetry to the handle that turns it, as a share of the canvas's
/// shorter side.
const ARM: f64 = 0.3;

/// A handle of the drawing aids.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AidHandle {
    /// One of the two ends of the straight ruler, 0 or 1.
    End(usize),
    /// The middle of the ellipse. It moves all of it.
    Middle,
    /// The end of one half axis. It turns the ellipse.
    Tip,
    /// The end of the other half axis.
    Side,
    /// A vanishing point, from 0.
    Vanishing(usize),
    /// Centre of the symmetry.
    Centre,
    /// The place on the axis of symmetry that turns it.
    Axis,
}

impl AidHandle {
    /// Name of the handle for tooltips and screen readers.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::End(0) => "Start of the ruler".to_owned(),
            Self::End(_) => "End of the ruler".to_owned(),
            Self::Middle => "Middle of the ellipse".to_owned(),
            Self::Tip => "Length of the ellipse".to_owned(),
            Self::Side => "Width of the ellipse".to_owned(),
            Self::Vanishing(number) => format!("Vanishing point {}", number + 1),
            Self::Centre => "Centre of the symmetry".to_owned(),
            Self::Axis => "Angle of the symmetry".to_owned(),
        }
    }
}

fn stepped(degrees: f64) -> f64 {
    let step = (degrees / STEP_DEG).round() * STEP_DEG;
    if (degrees - step).abs() < SNAP_DEG { step } else { degrees }
}

#[cfg(test)]
mod tests {
    use super::shapes::{Perspective, Ruler};
    use super::*;

    #[test]
    fn one_guide_is_shown_at_a_time_and_leads_only_if_it_is_to() {
        let mut aids = DrawingAids::default();
        assert_eq!(aids.leading(), None);
        aids.toggle(GuideKind::Ruler);
        assert_eq!(aids.leading(), Some(Guide::Ruler(aids.ruler)));
        aids.toggle(GuideKind::Perspective);
        assert_eq!(aids.leading(), Some(Guide::Perspective(aids.perspective)));
        aids.snaps = false;
        assert_eq!((aids.leading(), aids.guide), (None, Some(GuideKind::Perspective)));
        aids.toggle(GuideKind::Perspective);
        assert_eq!(aids.guide, None);
    }

    #[test]
    fn aids_stay_where_they_are_while_the_canvas_has_their_size() {
        let mut aids = DrawingAids::default();
        aids.fit([40.0, 20.0]);
        assert_eq!(aids.symmetry.centre, [20.0, 10.0]);
        assert_eq!(aids.ruler.ends, [[10.0, 10.0], [30.0, 10.0]]);
        aids.symmetry.centre = [5.0, 6.0];
        aids.symmetry.arms = 9;
        let text = serde_json::to_string(&aids).unwrap();
        let mut read: DrawingAids = serde_json::from_str(&text).unwrap();
        assert_eq!(read, aids);
        read.fit([40.0, 20.0]);
        assert_eq!(read, aids, "those of an autosave too");
        read.fit([40.0, 30.0]);
        assert_eq!((read.symmetry.centre, read.symmetry.arms), ([20.0, 15.0], 9));
        assert_eq!(serde_json::from_str::<DrawingAids>("{}").unwrap(), DrawingAids::default());
    }

    fn perspective() -> Option<Guide> {
        let points = [[0.0, 0.0], [100.0, 0.0], [0.0, 0.0]];
        Some(Guide::Perspective(Perspective { count: 2, points }))
    }

    #[test]
    fn a_stroke_without_a_guide_goes_where_the_pen_does() {
        let mut lead = Lead::new(None, 2.0);
        assert!(lead.is_off() && !lead.is_open());
        for place in [(1.0, 2.0), (1.3, 2.7), (9.0, -4.0)] {
            assert_eq!((lead.follow(place), lead.last()), (place, Some(place)));
        }
    }

    #[test]
    fn a_ruler_leads_from_the_first_place_on() {
        let ruler = Ruler { ends: [[0.0, 5.0], [10.0, 5.0]], ..Ruler::default() };
        let mut lead = Lead::new(Some(Guide::Ruler(ruler)), 2.0);
        assert_eq!(lead.follow((3.0, 9.0)), (3.0, 5.0));
        assert!(!lead.is_open() && !lead.is_off());
        assert_eq!(lead.follow((-4.0, 2.0)), (-4.0, 5.0));
        let mut lead = Lead::new(Some(Guide::Ruler(Ruler::default())), 2.0);
        assert_eq!(lead.follow((3.0, 9.0)), (3.0, 9.0), "a ruler without extent");
        assert!(lead.is_off());
    }

    #[test]
    fn perspective_is_decided_once_the_pen_is_far_enough() {
        let mut lead = Lead::new(perspective(), 2.0);
        assert_eq!(lead.follow((50.0, 50.0)), (50.0, 50.0));
        assert_eq!(lead.follow((49.0, 49.2)), (49.0, 49.2));
        assert!(lead.is_open());
        let (x, y) = lead.follow((48.0, 48.4));
        assert!(!lead.is_open() && (x - y).abs() < 1e-9, "{x} {y}");
        // Later the stroke keeps to its line, wherever the pen moves.
        let (x, y) = lead.follow((70.0, 30.0));
        assert!((x - 50.0).abs() < 1e-9 && (y - 50.0).abs() < 1e-9, "{x} {y}");
    }

    #[test]
    fn a_touch_without_direction_is_free() {
        let mut lead = Lead::new(perspective(), 2.0);
        lead.follow((50.0, 50.0));
        lead.settle();
        assert!(lead.is_off());
        assert_eq!(lead.follow((90.0, 50.0)), (90.0, 50.0));
    }

    #[test]
    fn fans_cover_the_canvas_from_corner_to_corner() {
        let canvas = [200.0, 100.0];
        for point in [[-300.0, 40.0], [260.0, -20.0], [100.0, 4000.0]] {
            let rays = fan(point, canvas);
            assert_eq!(rays.len(), FAN + 1);
            // All corners lie between the first and the last line.
            for (ray, wanted) in [(&rays[0], 1.0), (&rays[FAN], -1.0)] {
                let along = unit(way(ray[0], ray[1])).unwrap();
                let sides = [[0.0, 0.0], [200.0, 0.0], [200.0, 100.0], [0.0, 100.0]]
                    .map(|corner| wanted * dot(across(along), way(point, corner)));
                assert!(sides.into_iter().all(|side| side > -1e-6), "{point:?}: {sides:?}");
                assert!(sides.into_iter().any(|side| side < 1e-6), "{point:?}: {sides:?}");
            }
        }
        assert_eq!(fan([100.0, 30.0], canvas).len(), 2 * FAN, "all around");
    }

    #[test]
    fn what_is_off_has_no_lines() {
        let mut aids = DrawingAids::default();
        aids.fit([200.0, 100.0]);
        assert_eq!(aids.lines(), AidLines::default());
        aids.symmetry.on = true;
        assert_eq!(aids.lines().main.len(), 2, "both halves of the axis");
        aids.toggle(GuideKind::Perspective);
        let lines = aids.lines();
        assert_eq!((lines.main.len(), lines.faint.is_empty()), (3, false), "and the horizon");
        aids.toggle(GuideKind::Ruler);
        aids.ruler.shape = RulerShape::Concentric;
        let lines = aids.lines();
        assert_eq!((lines.main.len(), lines.faint.len()), (3, 6));
        aids.ruler.half_width_mm = 0.0;
        assert_eq!(aids.lines().main.len(), 2, "an ellipse without extent");
    }

    fn aids(guide: Option<GuideKind>, shape: RulerShape, kind: SymmetryKind) -> DrawingAids {
        let mut aids = DrawingAids { guide, ..DrawingAids::default() };
        aids.ruler.shape = shape;
        aids.symmetry.on = true;
        aids.symmetry.kind = kind;
        aids.fit([200.0, 100.0]);
        aids
    }

    #[test]
    fn every_handle_goes_where_it_is_moved_to() {
        for (guide, shape, count) in [
            (Some(GuideKind::Ruler), RulerShape::Line, 4),
            (Some(GuideKind::Ruler), RulerShape::Concentric, 5),
            (Some(GuideKind::Perspective), RulerShape::Line, 4),
            (None, RulerShape::Line, 2),
        ] {
            let mut aids = aids(guide, shape, SymmetryKind::Vertical);
            let handles = aids.handles();
            assert_eq!(handles.len(), count, "{handles:?}");
            for handle in handles {
                let before = aids.place_of(handle);
                // We move along the ray or the axis, because angle and width keep their direction.
                let to = match handle {
                    AidHandle::Axis => [before[0] + 30.0, before[1] + 30.0],
                    AidHandle::Side => moved(before, way(aids.ruler.middle, before), 0.2),
                    _ => [before[0] + 7.0, before[1] - 5.0],
                };
                aids.move_to(handle, to);
                let after = aids.place_of(handle);
                if handle != AidHandle::Axis {
                    assert!(length(way(after, to)) < 1e-9, "{handle:?}: {after:?}, not {to:?}");
                }
            }
            assert_eq!(aids.symmetry.angle_deg, 90.0, "from upright to the right");
        }
    }

    #[test]
    fn an_ellipse_moves_as_a_whole_and_only_vanishing_points_leave_the_canvas() {
        let mut aids = aids(Some(GuideKind::Ruler), RulerShape::Ellipse, SymmetryKind::Both);
        let before = aids.ruler;
        aids.move_to(AidHandle::Middle, [60.0, 30.0]);
        assert_eq!(aids.ruler.axes(), before.axes());
        aids.move_to(AidHandle::Centre, [-20.0, 130.0]);
        assert_eq!(aids.symmetry.centre, [0.0, 100.0]);
        aids.move_to(AidHandle::Vanishing(0), [-500.0, 40.0]);
        assert_eq!(aids.perspective.points[0], [-500.0, 40.0]);
    }

    #[test]
    fn an_axis_takes_even_angles_that_are_near() {
        let mut aids = aids(None, RulerShape::Line, SymmetryKind::Vertical);
        let [x, y] = aids.symmetry.centre;
        for (to, wanted) in [
            ([x + 30.0, y - 31.0], 45.0),
            ([x - 0.5, y - 40.0], 0.0),
            ([x + 40.0, y], 90.0),
            ([x, y], 90.0),
        ] {
            aids.move_to(AidHandle::Axis, to);
            assert_eq!(aids.symmetry.angle_deg, wanted, "{to:?}");
        }
        aids.move_to(AidHandle::Axis, [x + 10.0, y - 20.0]);
        assert!((aids.symmetry.angle_deg - 26.565).abs() < 1e-3, "{}", aids.symmetry.angle_deg);
    }
}
