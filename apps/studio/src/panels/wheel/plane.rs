//! The plane of a* and b* on the screen.

use eframe::egui::{Pos2, Rect, vec2};

/// Steps of the rings of equal chroma.
pub(super) const RING: f64 = 20.0;

/// Mapping between a*, b* and points of the window: a* to the right, b* upwards, grey in the middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Square on the screen.
    pub rect: Rect,
    /// Chroma at the middle of its sides.
    pub reach: f64,
}

impl Plane {
    /// A plane in which everything up to this chroma is seen.
    #[must_use]
    pub fn with_chroma(rect: Rect, chroma: f64) -> Self {
        let half = 0.5 * RING;
        Self { rect, reach: ((chroma / half).ceil() * half).max(2.0 * RING) }
    }

    /// Point of a* and b*.
    #[must_use]
    pub fn point(&self, [a, b]: [f64; 2]) -> Pos2 {
        let scale = 0.5 * f64::from(self.rect.width()) / self.reach;
        self.rect.center() + vec2((a * scale) as f32, (-b * scale) as f32)
    }

    /// Values of a* and b* at a point.
    #[must_use]
    pub fn place(&self, point: Pos2) -> [f64; 2] {
        let scale = 2.0 * self.reach / f64::from(self.rect.width());
        let away = point - self.rect.center();
        [f64::from(away.x) * scale, -f64::from(away.y) * scale]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;

    #[test]
    fn a_point_is_found_again_and_red_lies_right_of_yellow() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(200.0, 200.0));
        let plane = Plane::with_chroma(rect, 71.0);
        assert!((plane.reach - 80.0).abs() < 1e-12, "{}", plane.reach);
        assert_eq!(plane.point([0.0, 0.0]), rect.center());
        assert_eq!(plane.point([0.0, 80.0]), rect.center_top());
        assert_eq!(plane.point([80.0, 0.0]), rect.right_center());
        for place in [[12.5, -40.0], [-7.0, 66.0]] {
            let found = plane.place(plane.point(place));
            let near = found.iter().zip(place).all(|(found, wanted)| (found - wanted).abs() < 1e-4);
            assert!(near, "{found:?} {place:?}");
        }
        assert!((Plane::with_chroma(rect, 3.0).reach - 40.0).abs() < 1e-12, "never too near");
    }
}
