//! A piece of a stroke: the smooth curve from one pen sample to the next, and its length in sub-steps.

use crate::pose::Pose;

/// Maximum change of pressure in a sub-step, 0 to 1 (chosen by eye).
const MOST_PRESSURE: f64 = 1.0 / 16.0;

/// Maximum change of pressure in a sub-step of a brush whose half width is `reach` in cells: the
/// sides of its mark move by about a cell.
pub(super) fn most_pressure(reach: f64) -> f64 {
    MOST_PRESSURE.min(0.5 / reach)
}

/// Maximum change of tilt or twist in a sub-step, in degrees (chosen by eye).
const MOST_DEGREES: f64 = 3.0;

/// Number of points per sub-step at which the walk tests whether the sub-step is full. This keeps
/// every sub-step at 15/16 or longer.
const LOOKS: f64 = 16.0;

/// The curve from one sample to the next.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    from: Pose,
    to: Pose,
    /// Bezier points of the curve, in cells.
    points: [(f64, f64); 4],
    /// Half of the width of the brush in cells.
    reach: f64,
    /// We walk the curve in this number of equal steps of its parameter.
    pub(super) looks: u64,
}

impl Piece {
    /// The curve between the samples `from` and `to`. The samples before and after them, if there
    /// are any, set its tangents. `reach` is half of the width of the brush in cells.
    pub(super) fn new(
        (before, from): (Option<Pose>, Pose),
        (mut to, after): (Pose, Option<Pose>),
        reach: f64,
    ) -> Self {
        let turn = (to.twist_deg - from.twist_deg) % 360.0;
        to.twist_deg = from.twist_deg + turn - 360.0 * (turn / 360.0).round();
        let b = place(&from);
        let c = place(&to);
        let before = before.map_or_else(|| mirrored(c, b), |pose| place(&pose));
        let after = after.map_or_else(|| mirrored(b, c), |pose| place(&pose));
        let points = [b, handle(before, b, c), handle(after, c, b), c];
        let mut piece = Self { from, to, points, reach, looks: 0 };
        piece.looks = (piece.size() * LOOKS).ceil() as u64;
        piece
    }

    /// Upper bound of the number of sub-steps of this piece.
    pub(super) fn size(&self) -> f64 {
        let legs = self.points.windows(2).map(|leg| distance(leg[0], leg[1]));
        // A Bezier curve of parameter 0..1 is nowhere faster than this.
        let fastest = 3.0 * legs.fold(0.0, f64::max);
        let swung = swung(&self.from, &self.to, self.reach);
        (fastest + swung).max(turned(&self.from, &self.to, self.reach))
    }

    /// Directions at the start and at the end of the piece: unit vectors, or (0, 0) for a piece without
    /// length.
    pub(super) fn headings(&self) -> [(f64, f64); 2] {
        let [start, leaving, arriving, end] = self.points;
        [(start, leaving), (arriving, end)].map(|(from, to)| {
            let length = distance(from, to);
            if length == 0.0 {
                return (0.0, 0.0);
            }
            ((to.0 - from.0) / length, (to.1 - from.1) / length)
        })
    }

    /// Number of sub-steps, or part of one, from step `look` to the next step.
    pub(super) fn part(&self, look: u64) -> f64 {
        substeps_between(&self.pose(look), &self.pose(look + 1), self.reach)
    }

    /// Pose after `look` of its `looks` steps.
    pub(super) fn pose(&self, look: u64) -> Pose {
        let t = look as f64 / self.looks as f64;
        let s = 1.0 - t;
        let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        let on_curve = weights.iter().zip(&self.points);
        let (x, y) = on_curve.fold((0.0, 0.0), |(x, y), (w, p)| (x + w * p.0, y + w * p.1));
        Pose {
            x,
            y,
            pressure: interpolated(self.from.pressure, self.to.pressure, t),
            tilt_x_deg: interpolated(self.from.tilt_x_deg, self.to.tilt_x_deg, t),
            tilt_y_deg: interpolated(self.from.tilt_y_deg, self.to.tilt_y_deg, t),
            twist_deg: interpolated(self.from.twist_deg, self.to.twist_deg, t),
            speed_mm_s: interpolated(self.from.speed_mm_s, self.to.speed_mm_s, t),
        }
    }
}

pub(super) fn interpolated(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

pub(super) fn place(pose: &Pose) -> (f64, f64) {
    (pose.x, pose.y)
}

/// Number of sub-steps, or part of one, from `a` to the near pose `b`. In a sub-step the sides of
/// the brush move by a cell at most.
fn substeps_between(a: &Pose, b: &Pose, reach: f64) -> f64 {
    (distance((a.x, a.y), (b.x, b.y)) + swung(a, b, reach)).max(turned(a, b, reach))
}

/// Distance in cells by which the sides of a brush move as it twists. `reach` is half of its width
/// in cells.
fn swung(a: &Pose, b: &Pose, reach: f64) -> f64 {
    reach * (a.twist_deg - b.twist_deg).abs().to_radians()
}

/// Number of sub-steps that the change of pressure and angles takes.
pub(super) fn turned(a: &Pose, b: &Pose, reach: f64) -> f64 {
    let tilted = (a.tilt_x_deg - b.tilt_x_deg).abs().max((a.tilt_y_deg - b.tilt_y_deg).abs());
    let turned = tilted.max((a.twist_deg - b.twist_deg).abs());
    (turned / MOST_DEGREES).max((a.pressure - b.pressure).abs() / most_pressure(reach))
}

pub(super) fn distance(a: (f64, f64), b: (f64, f64)) -> f64 {
    libm::hypot(a.0 - b.0, a.1 - b.1)
}

/// `a` mirrored at `b`.
fn mirrored(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (2.0 * b.0 - a.0, 2.0 * b.1 - a.1)
}

/// Inner Bezier point next to `here` of the curve from `here` to `next`, with `last` as the
/// point before.
fn handle(last: (f64, f64), here: (f64, f64), next: (f64, f64)) -> (f64, f64) {
    // Centripetal: knot distances are square roots of point distances.
    let d = distance(last, here);
    let e = distance(here, next);
    let root_d = d.sqrt();
    let root_e = e.sqrt();
    let whole = 3.0 * root_d * (root_d + root_e);
    if whole == 0.0 {
        return here;
    }
    let weight = 2.0 * d + 3.0 * root_d * root_e + e;
    let along = |l: f64, h: f64, n: f64| (d * n - e * l + weight * h) / whole;
    (along(last.0, here.0, next.0), along(last.1, here.1, next.1))
}
