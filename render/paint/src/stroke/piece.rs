//! The curve between two samples.

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

/// Number of points per sub-step at which the walk tests whether the sub-step is full, so
/// that none is shorter than 15/16.
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
    /// Number of equal steps of the curve's parameter in which it is walked.
    pub(super) looks: u64,
}

impl Piece {
    /// The curve between the samples `from` and `to`; the samples before and after them, if
    /// there are any, set its tangents. `reach` is half of the width of the brush in cells.
    pub(super) fn new(
        (before, from): (Option<Pose>, Pose),
        (mut to, after): (Pose, Option<Pose>),
        reach: f64,
    ) -> Self {
        let turn = (to.twist_deg - from.twist_deg) % 360.0;
        to.twist_deg = from.twist_deg + turn - 360.0 * (turn / 360.0).round();
        let place = |pose: &Pose| (pose.x, pose.y);
        let b = place(&from);
        let c = place(&to);
        let before = before.map_or_else(|| mirrored(c, b), |pose| place(&pose));
        let after = after.map_or_else(|| mirrored(b, c), |pose| place(&pose));
        let points = [b, handle(before, b, c), handle(after, c, b), c];
        let mut piece = Self { from, to, points, reach, looks: 0 };
        piece.looks = (piece.size() * LOOKS).ceil() as u64;
        piece
    }

    /// Upper bound of its sub-steps.
    pub(super) fn size(&self) -> f64 {
        let legs = self.points.windows(2).map(|leg| distance(leg[0], leg[1]));
        // A Bezier curve of parameter 0..1 is nowhere faster than this.
        let fastest = 3.0 * legs.fold(0.0, f64::max);
        let swung = swung(&self.from, &self.to, self.reach);
        (fastest + swung).max(turned(&self.from, &self.to, self.reach))
    }

    /// Number of sub-steps from its step `look` to the next.
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
        let between = |a: f64, b: f64| a + (b - a) * t;
        Pose {
            x,
            y,
            pressure: between(self.from.pressure, self.to.pressure),
            tilt_x_deg: between(self.from.tilt_x_deg, self.to.tilt_x_deg),
            tilt_y_deg: between(self.from.tilt_y_deg, self.to.tilt_y_deg),
            twist_deg: between(self.from.twist_deg, self.to.twist_deg),
        }
    }
}

/// Number of sub-steps, or part of one, from `a` to the near pose `b`. In a sub-step the sides of
/// the brush move by a cell at most.
fn substeps_between(a: &Pose, b: &Pose, reach: f64) -> f64 {
    (distance((a.x, a.y), (b.x, b.y)) + swung(a, b, reach)).max(turned(a, b, reach))
}

/// Way in cells of the sides of a brush as it twists; `reach` is half of its width in cells.
fn swung(a: &Pose, b: &Pose, reach: f64) -> f64 {
    reach * (a.twist_deg - b.twist_deg).abs().to_radians()
}

/// Number of sub-steps that the change of pressure and angles takes.
pub(super) fn turned(a: &Pose, b: &Pose, reach: f64) -> f64 {
    let tilted = (a.tilt_x_deg - b.tilt_x_deg).abs().max((a.tilt_y_deg - b.tilt_y_deg).abs());
    let turned = tilted.max((a.twist_deg - b.twist_deg).abs());
    (turned / MOST_DEGREES).max((a.pressure - b.pressure).abs() / most_pressure(reach))
}

fn distance(a: (f64, f64), b: (f64, f64)) -> f64 {
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
