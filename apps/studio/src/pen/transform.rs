//! The position of a surface in the window, as an affine map.

use eframe::egui::{Pos2, Rect, Vec2, pos2, vec2};
use paint::strokes::SurfaceId;

/// A surface in the window, with the affine map from points of the window to mm of the
/// surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceTransform {
    /// The surface of this map.
    pub surface: SurfaceId,
    /// A stroke on this surface can begin in this part of the window.
    pub area: Rect,
    origin: (f64, f64),
    right: (f64, f64),
    down: (f64, f64),
}

impl SurfaceTransform {
    /// A surface with the affine map `mm` from points of the window to mm of the surface. We
    /// evaluate the map at three points.
    pub fn new(surface: SurfaceId, area: Rect, mm: impl Fn(Pos2) -> (f64, f64)) -> Self {
        // A long distance keeps the rounding error of f32 small.
        const SPAN: f32 = 1024.0;
        let origin = mm(Pos2::ZERO);
        let [right, down] = [pos2(SPAN, 0.0), pos2(0.0, SPAN)].map(|at| {
            let (x, y) = mm(at);
            ((x - origin.0) / f64::from(SPAN), (y - origin.1) / f64::from(SPAN))
        });
        Self { surface, area, origin, right, down }
    }

    /// Position on the surface, in mm, below a point of the window.
    #[must_use]
    pub fn position_mm(&self, at: Pos2) -> (f64, f64) {
        let (x, y) = self.displacement((f64::from(at.x), f64::from(at.y)));
        (self.origin.0 + x, self.origin.1 + y)
    }

    /// Converts a tilt towards the right and lower edge of the window to a tilt towards the right
    /// and lower edge of the surface, in degrees from upright.
    pub(super) fn surface_tilt(&self, (tilt_x, tilt_y): (f64, f64)) -> (f64, f64) {
        let lean = [tilt_x, tilt_y]
            .map(|degrees: f64| degrees.clamp(-89.0, 89.0).to_radians().tan())
            .into();
        let (x, y) = self.displacement(lean);
        let length = x.hypot(y);
        if length == 0.0 {
            return (0.0, 0.0);
        }
        let scale = lean.0.hypot(lean.1) / length;
        ((x * scale).atan().to_degrees(), (y * scale).atan().to_degrees())
    }

    /// Converts a rotation in the window to a rotation on the surface, in degrees clockwise as you
    /// see it on a surface that is not mirrored.
    pub(super) fn surface_twist(&self, degrees: f64) -> f64 {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (x, y) = self.displacement((cos, sin));
        y.atan2(x).to_degrees()
    }

    /// Converts a displacement on the surface, in mm, to one in the window, in points. If the
    /// surface has no extent, this is 0.
    pub(super) fn way_in_window(&self, (x, y): (f64, f64)) -> Vec2 {
        let (a, b) = self.right;
        let (c, d) = self.down;
        let area = a * d - b * c;
        if area == 0.0 {
            return Vec2::ZERO;
        }
        vec2(((x * d - y * c) / area) as f32, ((y * a - x * b) / area) as f32)
    }

    /// Millimetres of the surface in a point of the window.
    pub(super) fn mm_per_point(&self) -> f64 {
        let (a, b) = self.right;
        let (c, d) = self.down;
        (a * d - b * c).abs().sqrt()
    }

    /// Converts a displacement in the window, in points, to one on the surface, in mm.
    fn displacement(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (x * self.right.0 + y * self.down.0, x * self.right.1 + y * self.down.1)
    }
}

/// The surfaces on which you can paint in this frame.
pub struct PenTargets<'a> {
    /// The visible surfaces, the topmost first.
    pub surfaces: &'a [SurfaceTransform],
    /// Returns whether a panel or dialog covers the surfaces at a point.
    pub covered: &'a dyn Fn(Pos2) -> bool,
}

impl std::fmt::Debug for PenTargets<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PenTargets").field("surfaces", &self.surfaces).finish_non_exhaustive()
    }
}

impl PenTargets<'_> {
    /// The surface that a press at this point of the window would touch.
    pub(super) fn surface_at(&self, at: Pos2) -> Option<&SurfaceTransform> {
        let transform = self.surfaces.iter().find(|transform| transform.area.contains(at))?;
        (!(self.covered)(at)).then_some(transform)
    }

    /// The transform of a surface, if you see it.
    pub(super) fn transform_of(&self, surface: SurfaceId) -> Option<&SurfaceTransform> {
        self.surfaces.iter().find(|transform| transform.surface == surface)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The canvas rotated by `degrees` clockwise, at 4 points per mm, optionally mirrored.
    fn turned(degrees: f64, mirrored: bool) -> SurfaceTransform {
        let area = Rect::from_min_max(Pos2::ZERO, pos2(800.0, 600.0));
        SurfaceTransform::new(SurfaceId::Canvas, area, |at| {
            let x = f64::from(at.x) - 300.0;
            let y = f64::from(at.y) - 200.0;
            let x = if mirrored { -x } else { x };
            let (sin, cos) = degrees.to_radians().sin_cos();
            ((x * cos + y * sin) / 4.0 + 90.0, (y * cos - x * sin) / 4.0 + 50.0)
        })
    }

    fn near(found: (f64, f64), wanted: (f64, f64)) {
        let off = (found.0 - wanted.0).hypot(found.1 - wanted.1);
        assert!(off < 1e-3, "{found:?}, not {wanted:?}");
    }

    #[test]
    fn positions_follow_the_affine_map() {
        near(turned(0.0, false).position_mm(pos2(340.0, 192.0)), (100.0, 48.0));
        near(turned(90.0, false).position_mm(pos2(300.0, 240.0)), (100.0, 50.0));
        near(turned(0.0, true).position_mm(pos2(340.0, 192.0)), (80.0, 48.0));
        let turned = turned(30.0, true);
        let ends = [pos2(340.0, 192.0), pos2(310.0, 250.0)].map(|at| turned.position_mm(at));
        let way = turned.way_in_window((ends[1].0 - ends[0].0, ends[1].1 - ends[0].1));
        near((way.x.into(), way.y.into()), (-30.0, 58.0));
    }

    #[test]
    fn tilt_and_twist_turn_with_the_view() {
        near(turned(0.0, false).surface_tilt((30.0, 10.0)), (30.0, 10.0));
        // The lower edge of the window is the right of the surface.
        near(turned(90.0, false).surface_tilt((0.0, 30.0)), (30.0, 0.0));
        near(turned(0.0, true).surface_tilt((30.0, 10.0)), (-30.0, 10.0));
        near(turned(30.0, true).surface_tilt((0.0, 0.0)), (0.0, 0.0));
        let twists = [
            (turned(0.0, false), 20.0, 20.0),
            (turned(90.0, false), 20.0, -70.0),
            (turned(0.0, true), 20.0, 160.0),
        ];
        for (transform, twist, expected) in twists {
            assert!(
                (transform.surface_twist(twist) - expected).abs() < 1e-6,
                "{}",
                transform.surface_twist(twist)
            );
        }
        let (x, y) = turned(45.0, false).surface_tilt((90.0, -90.0));
        assert!(x.abs() <= 90.0 && y.abs() <= 90.0, "{x} {y}");
    }

    #[test]
    fn the_topmost_surface_under_a_point_is_touched_unless_covered() {
        let mut palette = turned(0.0, false);
        palette.surface = SurfaceId::Palette;
        palette.area = Rect::from_min_max(pos2(700.0, 0.0), pos2(800.0, 600.0));
        let surfaces = [palette, turned(0.0, false)];
        let targets = PenTargets { surfaces: &surfaces, covered: &|at| at.y > 500.0 };
        for (x, y, wanted) in [
            (750.0, 10.0, Some(SurfaceId::Palette)),
            (650.0, 10.0, Some(SurfaceId::Canvas)),
            (650.0, 510.0, None),
            (850.0, 10.0, None),
        ] {
            let touched = targets.surface_at(pos2(x, y)).map(|transform| transform.surface);
            assert_eq!(touched, wanted, "{x} {y}");
        }
    }
}
