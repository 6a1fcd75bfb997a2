//! Handles with which the drawing aids are moved.

use super::place::{Place, across, dot, length, moved, unit, way};
use super::ruler::RulerShape;
use super::settings::{DrawingAids, GuideKind};
use super::symmetry::{SymmetryKind, upright_turned};

/// Angle to a multiple of 15 degrees within which an axis takes it, in degrees.
const SNAP_DEG: f64 = 2.0;

/// Step of these angles, in degrees.
const STEP_DEG: f64 = 15.0;

/// Distance of the handle that turns the symmetry from its centre, as a share of the shorter side
/// of the canvas.
const ARM: f64 = 0.3;

/// A handle of the drawing aids.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AidHandle {
    /// One of the two ends of the straight ruler, 0 or 1.
    End(usize),
    /// Middle of the ellipse, which moves all of it.
    Middle,
    /// End of the half axis of the ellipse that turns it.
    Tip,
    /// End of its other half axis.
    Side,
    /// A vanishing point, from 0.
    Vanishing(usize),
    /// Centre of the symmetry.
    Centre,
    /// The place on its axis that turns it.
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

impl DrawingAids {
    /// Handles of all aids that are shown.
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

    /// Moves a handle to a place in mm of the canvas, or as near as it may be: only vanishing
    /// points leave the canvas.
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

    /// Distance of a place from the line of the ellipse's half axis.
    fn half_width(&self, to: Place) -> f64 {
        let axis = unit(way(self.ruler.middle, self.ruler.tip)).unwrap_or([1.0, 0.0]);
        dot(across(axis), way(self.ruler.middle, to)).abs()
    }
}

/// An angle in degrees, set to a multiple of 15 that is near.
fn stepped(degrees: f64) -> f64 {
    let step = (degrees / STEP_DEG).round() * STEP_DEG;
    if (degrees - step).abs() < SNAP_DEG { step } else { degrees }
}

#[cfg(test)]
mod tests {
    use super::*;

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
                // Along the ray or the axis, as angle and width keep their direction.
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
