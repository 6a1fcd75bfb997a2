//! How a head is held: its axes in space.

use super::shape::Proportions;
use super::vector::Vector;
use crate::pose::Pose;

/// Largest angle of a handle from upright, in degrees. Beyond it the ferrule would touch
/// the canvas.
const FARTHEST_LEAN_DEG: f64 = 80.0;

/// Component of a handle across a blade, as the sine of its lean, from which the blade is
/// turned over to that side. Below it the twist decides.
const OTHER_SIDE: f32 = 0.17;

/// Angle in degrees between the blade of a knife and the canvas, at pressure 0 and at full
/// pressure (chosen by eye).
const BLADE_DEG: (f64, f64) = (25.0, 8.0);

/// Number of steps per cell that positions are rounded to, so that a stroke shifted by whole
/// cells has the same contacts.
const STEPS_PER_CELL: f64 = 65536.0;

/// Largest distance from the origin in cells; positions beyond it are clipped.
const FARTHEST: f64 = 1e9;

/// Axes of a head at a pose. Lengths are in cells from `origin`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grip {
    /// The cell that contains the pose's position: origin of all coordinates of the head.
    pub(super) origin: (i64, i64),
    /// The pose's position within the cell `origin`, 0 to 1 along x and y.
    pub(super) tip: (f32, f32),
    /// Unit vector from the tip to the ferrule.
    pub(super) axis: Vector,
    /// Unit vector across the head along its broad side.
    pub(super) broad: Vector,
    /// Unit vector across the head along its thin side.
    pub(super) thin: Vector,
    /// Pressure from 0 to 1.
    pub(super) pressure: f32,
}

impl Grip {
    /// Axes of a head of these proportions at `pose`; `None` if a number is not finite or the
    /// pressure is 0. A wide head or a blade lies level along its broad side, as it would
    /// stand on a corner if it leaned that way.
    pub(super) fn new(pose: &Pose, of: &Proportions) -> Option<Self> {
        if !pose.is_finite() || pose.pressure <= 0.0 {
            return None;
        }
        let pressure = pose.pressure.min(1.0);
        let (column, x) = whole_and_part(pose.x);
        let (row, y) = whole_and_part(pose.y);
        let mut handle = handle(pose.tilt_x_deg, pose.tilt_y_deg, FARTHEST_LEAN_DEG);
        let (sin, cos) = libm::sincos((pose.twist_deg % 360.0).to_radians());
        let across = Vector::new(cos as f32, sin as f32, 0.0);
        if of.spines > 1 {
            handle = handle.across(across).unit_or(Vector::UP);
        }
        let broad = across.across(handle).unit_or(across);
        let mut axis = handle;
        if of.rigid {
            let angle = BLADE_DEG.0 + (BLADE_DEG.1 - BLADE_DEG.0) * pressure;
            let (sin, cos) = libm::sincos(angle.to_radians());
            let level = Vector::UP.cross(broad);
            let side = if handle.dot(level) < -OTHER_SIDE { -1.0 } else { 1.0 };
            axis = level * (side * cos as f32) + Vector::UP * sin as f32;
        }
        Some(Self {
            origin: (column, row),
            tip: (x, y),
            axis,
            broad,
            thin: axis.cross(broad),
            pressure: pressure as f32,
        })
    }

    /// Direction in which hair bends by default: opposite to the lean of the handle, or along
    /// the thin side if the handle is upright.
    pub(super) fn falls_to(&self) -> Vector {
        let away = Vector::new(-self.axis.x, -self.axis.y, 0.0);
        let over = Vector::new(self.thin.x, self.thin.y, 0.0);
        (away * 4.0 + over * 0.25).unit_or(over)
    }
}

fn whole_and_part(cells: f64) -> (i64, f32) {
    let steps = (cells.clamp(-FARTHEST, FARTHEST) * STEPS_PER_CELL).round();
    let whole = (steps / STEPS_PER_CELL).floor();
    (whole as i64, (steps / STEPS_PER_CELL - whole) as f32)
}

/// Direction of a handle with these tilts, the first seen from the front, the second from the
/// side, limited to `farthest_deg` degrees from upright.
fn handle(tilt_x_deg: f64, tilt_y_deg: f64, farthest_deg: f64) -> Vector {
    let (sin_x, cos_x) = libm::sincos(tilt_x_deg.clamp(-90.0, 90.0).to_radians());
    let (sin_y, cos_y) = libm::sincos(tilt_y_deg.clamp(-90.0, 90.0).to_radians());
    // Proportional to (tan x, tan y, 1), but finite at 90 degrees. If both tilts are 90
    // degrees, the handle lies between the x and y axes.
    let mut x = sin_x * cos_y;
    let mut y = sin_y * cos_x;
    let z = cos_x * cos_y;
    if libm::hypot(x, y) + z < 1e-9 {
        (x, y) = (sin_x, sin_y);
    }
    let level = (x * x + y * y).sqrt();
    let lean = libm::atan2(level, z).min(farthest_deg.to_radians());
    let (sin, cos) = libm::sincos(lean);
    if level == 0.0 {
        return Vector::UP;
    }
    Vector::new((x / level * sin) as f32, (y / level * sin) as f32, cos as f32)
}

#[cfg(test)]
mod tests {
    use super::super::shape::HeadShape;
    use super::*;

    const POSE: Pose =
        Pose { x: 3.25, y: -1.5, pressure: 0.5, tilt_x_deg: 0.0, tilt_y_deg: 0.0, twist_deg: 0.0 };

    #[test]
    fn axes_stand_upright_on_each_other_whatever_the_pose() {
        for (tilt_x_deg, tilt_y_deg) in
            [(0.0, 0.0), (45.0, 0.0), (90.0, 0.0), (-90.0, 90.0), (1e9, -1e9), (89.999, 30.0)]
        {
            for (twist_deg, shape) in
                [(0.0, HeadShape::Round), (90.0, HeadShape::Knife), (-1e12, HeadShape::Flat)]
            {
                let pose = Pose { tilt_x_deg, tilt_y_deg, twist_deg, ..POSE };
                let grip = Grip::new(&pose, shape.proportions()).unwrap();
                for axis in [grip.axis, grip.broad, grip.thin] {
                    assert!((axis.length() - 1.0).abs() < 1e-5, "{pose:?}: {axis:?}");
                }
                assert!(grip.axis.dot(grip.broad).abs() < 1e-5, "{pose:?}");
                assert!(grip.axis.z > 0.13, "{pose:?}: {:?}", grip.axis);
            }
        }
    }

    #[test]
    fn a_lean_is_towards_its_side_and_a_twist_clockwise() {
        let right =
            Grip::new(&Pose { tilt_x_deg: 30.0, ..POSE }, HeadShape::Round.proportions()).unwrap();
        assert!((right.axis.x - 0.5).abs() < 1e-6 && right.axis.y == 0.0);
        let lower =
            Grip::new(&Pose { tilt_y_deg: 30.0, ..POSE }, HeadShape::Round.proportions()).unwrap();
        assert!((lower.axis.y - 0.5).abs() < 1e-6);
        let turned =
            Grip::new(&Pose { twist_deg: 90.0, ..POSE }, HeadShape::Round.proportions()).unwrap();
        assert!((turned.broad.y - 1.0).abs() < 1e-6);
        assert_eq!((right.origin, right.tip), ((3, -2), (0.25, 0.5)));
    }

    #[test]
    fn a_wide_head_stays_level_and_a_blade_stands_on_its_edge() {
        for towards_deg in (0..360).step_by(15) {
            let (sin, cos) = f64::from(towards_deg).to_radians().sin_cos();
            let tilt = |part: f64| (1.5 * part).atan().to_degrees();
            let pose = Pose { tilt_x_deg: tilt(cos), tilt_y_deg: tilt(sin), ..POSE };
            for shape in [HeadShape::Flat, HeadShape::Knife] {
                let grip = Grip::new(&pose, shape.proportions()).unwrap();
                assert_eq!(grip.broad.z, 0.0, "{shape}, {towards_deg}");
            }
            let blade = Grip::new(&pose, HeadShape::Knife.proportions()).unwrap();
            let angle_deg = blade.axis.z.asin().to_degrees();
            assert!((angle_deg - 16.5).abs() < 0.01, "{towards_deg}: {angle_deg}");
            // The handle chooses the side.
            let leans = sin.abs() > 0.3;
            assert!(!leans || f64::from(blade.axis.y) * sin > 0.0, "{towards_deg}: {blade:?}");
        }
    }

    #[test]
    fn no_pressure_and_no_numbers_are_no_grip() {
        assert!(
            Grip::new(&Pose { pressure: 0.0, ..POSE }, HeadShape::Round.proportions()).is_none()
        );
        assert!(Grip::new(&Pose { x: f64::NAN, ..POSE }, HeadShape::Round.proportions()).is_none());
        assert!(
            Grip::new(&Pose { twist_deg: f64::INFINITY, ..POSE }, HeadShape::Round.proportions())
                .is_none()
        );
    }
}
