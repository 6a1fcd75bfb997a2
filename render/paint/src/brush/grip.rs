//! How a head is held: its axes in space.

use super::vector::Vector;
use crate::pose::Pose;

/// Largest angle of a handle from upright, in degrees. Beyond it the ferrule would touch
/// the canvas.
const FARTHEST_LEAN_DEG: f64 = 80.0;

/// Largest angle of the handle of a knife from upright, in degrees. Only the lean
/// across the edge counts, as a lean along it would put the knife on a corner.
const FARTHEST_LEAN_OF_BLADE_DEG: f64 = 45.0;

/// Angle in degrees between the blade of a knife and the canvas with an upright handle, at
/// pressure 0 and at full pressure (chosen by eye).
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
    /// Axes of `pose`; `None` if a number is not finite or the pressure is 0. `blade`:
    /// whether the head is a knife.
    pub(super) fn new(pose: &Pose, blade: bool) -> Option<Self> {
        if !pose.is_finite() || pose.pressure <= 0.0 {
            return None;
        }
        let pressure = pose.pressure.min(1.0);
        let (column, x) = whole_and_part(pose.x);
        let (row, y) = whole_and_part(pose.y);
        let farthest = if blade { FARTHEST_LEAN_OF_BLADE_DEG } else { FARTHEST_LEAN_DEG };
        let mut handle = handle(pose.tilt_x_deg, pose.tilt_y_deg, farthest);
        let (sin, cos) = (pose.twist_deg % 360.0).to_radians().sin_cos();
        let across = Vector::new(cos as f32, sin as f32, 0.0);
        if blade {
            handle = handle.across(across).unit_or(Vector::UP);
        }
        let broad = across.across(handle).unit_or(across);
        let mut axis = handle;
        if blade {
            let angle = BLADE_DEG.0 + (BLADE_DEG.1 - BLADE_DEG.0) * pressure;
            let (sin, cos) = angle.to_radians().sin_cos();
            axis = handle.cross(broad) * cos as f32 + handle * sin as f32;
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
    let (sin_x, cos_x) = tilt_x_deg.clamp(-90.0, 90.0).to_radians().sin_cos();
    let (sin_y, cos_y) = tilt_y_deg.clamp(-90.0, 90.0).to_radians().sin_cos();
    // Proportional to (tan x, tan y, 1), but finite at 90 degrees. If both tilts are 90
    // degrees, the handle lies between the x and y axes.
    let (mut x, mut y) = (sin_x * cos_y, sin_y * cos_x);
    let z = cos_x * cos_y;
    if x.hypot(y) + z < 1e-9 {
        (x, y) = (sin_x, sin_y);
    }
    let level = (x * x + y * y).sqrt();
    let lean = level.atan2(z).min(farthest_deg.to_radians());
    let (sin, cos) = lean.sin_cos();
    if level == 0.0 {
        return Vector::UP;
    }
    Vector::new((x / level * sin) as f32, (y / level * sin) as f32, cos as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    const POSE: Pose =
        Pose { x: 3.25, y: -1.5, pressure: 0.5, tilt_x_deg: 0.0, tilt_y_deg: 0.0, twist_deg: 0.0 };

    #[test]
    fn axes_stand_upright_on_each_other_whatever_the_pose() {
        for (tilt_x_deg, tilt_y_deg) in
            [(0.0, 0.0), (45.0, 0.0), (90.0, 0.0), (-90.0, 90.0), (1e9, -1e9), (89.999, 30.0)]
        {
            for (twist_deg, blade) in [(0.0, false), (90.0, true), (-1e12, false)] {
                let pose = Pose { tilt_x_deg, tilt_y_deg, twist_deg, ..POSE };
                let grip = Grip::new(&pose, blade).unwrap();
                for axis in [grip.axis, grip.broad, grip.thin] {
                    assert!((axis.length() - 1.0).abs() < 1e-5, "{pose:?}: {axis:?}");
                }
                assert!(grip.axis.dot(grip.broad).abs() < 1e-5, "{pose:?}");
                assert!(blade || grip.axis.z > 0.17, "{pose:?}: {:?}", grip.axis);
            }
        }
    }

    #[test]
    fn a_lean_is_towards_its_side_and_a_twist_clockwise() {
        let right = Grip::new(&Pose { tilt_x_deg: 30.0, ..POSE }, false).unwrap();
        assert!((right.axis.x - 0.5).abs() < 1e-6 && right.axis.y == 0.0);
        let lower = Grip::new(&Pose { tilt_y_deg: 30.0, ..POSE }, false).unwrap();
        assert!((lower.axis.y - 0.5).abs() < 1e-6);
        let turned = Grip::new(&Pose { twist_deg: 90.0, ..POSE }, false).unwrap();
        assert!((turned.broad.y - 1.0).abs() < 1e-6);
        assert_eq!((right.origin, right.tip), ((3, -2), (0.25, 0.5)));
    }

    #[test]
    fn no_pressure_and_no_numbers_are_no_grip() {
        assert!(Grip::new(&Pose { pressure: 0.0, ..POSE }, false).is_none());
        assert!(Grip::new(&Pose { x: f64::NAN, ..POSE }, false).is_none());
        assert!(Grip::new(&Pose { twist_deg: f64::INFINITY, ..POSE }, false).is_none());
    }
}
