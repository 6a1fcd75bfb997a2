//! Where a surface lies in the window.

use eframe::egui::{Pos2, Rect, pos2};
use render::paint::strokes::SurfaceId;

/// A surface in the window: an affine map from points of the window to mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    /// Which surface.
    pub surface: SurfaceId,
    /// Where in the window the pen may set down on it.
    pub area: Rect,
    origin: (f64, f64),
    right: (f64, f64),
    down: (f64, f64),
}

impl Sight {
    /// A surface seen through `mm`, an affine map from points of the window to mm
    /// of the surface; it is asked at three places.
    pub fn new(surface: SurfaceId, area: Rect, mm: impl Fn(Pos2) -> (f64, f64)) -> Self {
        // Far apart, so that the rounding of f32 stays small.
        const SPAN: f32 = 1024.0;
        let origin = mm(Pos2::ZERO);
        let step = |at: Pos2| {
            let (x, y) = mm(at);
            ((x - origin.0) / f64::from(SPAN), (y - origin.1) / f64::from(SPAN))
        };
        Self { surface, area, origin, right: step(pos2(SPAN, 0.0)), down: step(pos2(0.0, SPAN)) }
    }

    /// The place in mm of the surface below a point of the window.
    #[must_use]
    pub fn place(&self, at: Pos2) -> (f64, f64) {
        let (x, y) = self.along((f64::from(at.x), f64::from(at.y)));
        (self.origin.0 + x, self.origin.1 + y)
    }

    /// A lean towards the right and the lower edge of the window, as one towards
    /// those of the surface; degrees from upright.
    pub(super) fn tilt(&self, (tilt_x, tilt_y): (f64, f64)) -> (f64, f64) {
        let slope = |degrees: f64| degrees.clamp(-89.0, 89.0).to_radians().tan();
        let lean = (slope(tilt_x), slope(tilt_y));
        let (x, y) = self.along(lean);
        let length = x.hypot(y);
        if length == 0.0 {
            return (0.0, 0.0);
        }
        let scale = lean.0.hypot(lean.1) / length;
        ((x * scale).atan().to_degrees(), (y * scale).atan().to_degrees())
    }

    /// A turn as seen in the window, as one of the surface: in degrees, clockwise
    /// when looking on the surface as it is.
    pub(super) fn twist(&self, degrees: f64) -> f64 {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (x, y) = self.along((cos, sin));
        y.atan2(x).to_degrees()
    }

    /// What a step in the window is on the surface, in mm.
    fn along(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (x * self.right.0 + y * self.down.0, x * self.right.1 + y * self.down.1)
    }
}

/// What a pen can paint on at this moment.
pub struct View<'a> {
    /// The surfaces; the first that lies under a point takes it.
    pub surfaces: &'a [Sight],
    /// Whether something else of the window lies over the surfaces there.
    pub covered: &'a dyn Fn(Pos2) -> bool,
}

impl std::fmt::Debug for View<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("View").field("surfaces", &self.surfaces).finish_non_exhaustive()
    }
}

impl View<'_> {
    /// What the pen would set down on.
    pub(super) fn under(&self, at: Pos2) -> Option<&Sight> {
        let sight = self.surfaces.iter().find(|sight| sight.area.contains(at))?;
        (!(self.covered)(at)).then_some(sight)
    }

    /// Where a surface is, if it is seen.
    pub(super) fn of(&self, surface: SurfaceId) -> Option<&Sight> {
        self.surfaces.iter().find(|sight| sight.surface == surface)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Turned by `degrees` clockwise, 4 points a mm, perhaps mirrored.
    fn turned(degrees: f64, mirrored: bool) -> Sight {
        let area = Rect::from_min_max(Pos2::ZERO, pos2(800.0, 600.0));
        Sight::new(SurfaceId::Canvas, area, |at| {
            let (x, y) = (f64::from(at.x) - 300.0, f64::from(at.y) - 200.0);
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
    fn places_are_those_of_the_map() {
        near(turned(0.0, false).place(pos2(340.0, 192.0)), (100.0, 48.0));
        near(turned(90.0, false).place(pos2(300.0, 240.0)), (100.0, 50.0));
        near(turned(0.0, true).place(pos2(340.0, 192.0)), (80.0, 48.0));
    }

    #[test]
    fn tilt_and_twist_turn_with_the_view() {
        near(turned(0.0, false).tilt((30.0, 10.0)), (30.0, 10.0));
        // The lower edge of the window is the surface's right.
        near(turned(90.0, false).tilt((0.0, 30.0)), (30.0, 0.0));
        near(turned(0.0, true).tilt((30.0, 10.0)), (-30.0, 10.0));
        near(turned(30.0, true).tilt((0.0, 0.0)), (0.0, 0.0));
        let twists = [
            (turned(0.0, false), 20.0, 20.0),
            (turned(90.0, false), 20.0, -70.0),
            (turned(0.0, true), 20.0, 160.0),
        ];
        for (sight, twist, wanted) in twists {
            assert!((sight.twist(twist) - wanted).abs() < 1e-6, "{}", sight.twist(twist));
        }
        let (x, y) = turned(45.0, false).tilt((90.0, -90.0));
        assert!(x.abs() <= 90.0 && y.abs() <= 90.0, "{x} {y}");
    }

    #[test]
    fn the_first_surface_under_a_point_takes_it_unless_covered() {
        let mut palette = turned(0.0, false);
        palette.surface = SurfaceId::Palette;
        palette.area = Rect::from_min_max(pos2(700.0, 0.0), pos2(800.0, 600.0));
        let surfaces = [palette, turned(0.0, false)];
        let view = View { surfaces: &surfaces, covered: &|at| at.y > 500.0 };
        let under = |x, y| view.under(pos2(x, y)).map(|sight| sight.surface);
        assert_eq!(under(750.0, 10.0), Some(SurfaceId::Palette));
        assert_eq!(under(650.0, 10.0), Some(SurfaceId::Canvas));
        assert_eq!(under(650.0, 510.0), None);
        assert_eq!(under(850.0, 10.0), None);
    }
}
