//! How the reference picture lies over the canvas: pure geometry in mm.

/// Shortest width of a picture over the canvas, in mm.
const LEAST_MM: f64 = 2.0;

/// Middle, width and turn of a picture over the canvas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OverlayPlace {
    /// Middle in mm from the upper left corner of the canvas.
    pub(super) center: [f64; 2],
    /// Width of the picture in mm.
    pub(super) width_mm: f64,
    /// Clockwise turn in radians.
    pub(super) turn: f64,
}

/// How the picture lies over the canvas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OverCanvas {
    /// Whether it is shown there.
    pub(super) shown: bool,
    /// Opacity, 0 to 1.
    pub(super) opacity: f32,
    /// Whether the pointer moves it instead of painting.
    pub(super) moving: bool,
    /// Its place; fitted to the canvas before the painter moves it.
    pub(super) place: Option<OverlayPlace>,
}

impl Default for OverCanvas {
    fn default() -> Self {
        Self { shown: false, opacity: 0.4, moving: false, place: None }
    }
}

impl OverlayPlace {
    /// Fitted without stretching into a canvas of `canvas_mm`, in its middle. `aspect` is
    /// the width of the picture over its height.
    pub(super) fn fitted(canvas_mm: [f64; 2], aspect: f64) -> Self {
        let [width, height] = canvas_mm;
        let center = [0.5 * width, 0.5 * height];
        Self { center, width_mm: width.min(height * aspect), turn: 0.0 }
    }

    /// Place in mm of a point of the picture: shares of its width and height, from the upper
    /// left corner.
    pub(super) fn point(&self, [across, down]: [f64; 2], aspect: f64) -> [f64; 2] {
        let x = (across - 0.5) * self.width_mm;
        let y = (down - 0.5) * self.width_mm / aspect;
        let (sin, cos) = self.turn.sin_cos();
        [self.center[0] + cos * x - sin * y, self.center[1] + sin * x + cos * y]
    }

    /// Moved by `by` mm.
    pub(super) fn moved(self, by: [f64; 2]) -> Self {
        Self { center: [self.center[0] + by[0], self.center[1] + by[1]], ..self }
    }

    /// Scaled about its middle so that a corner is as far from it as `to`.
    pub(super) fn scaled_to(self, to: [f64; 2], aspect: f64) -> Self {
        let reach = (to[0] - self.center[0]).hypot(to[1] - self.center[1]);
        let width_mm = 2.0 * reach / 1.0_f64.hypot(1.0 / aspect);
        Self { width_mm: width_mm.max(LEAST_MM), ..self }
    }

    /// Turned about its middle so that its upper edge faces `to`.
    pub(super) fn turned_to(self, to: [f64; 2]) -> Self {
        let x = to[0] - self.center[0];
        let y = to[1] - self.center[1];
        if x.hypot(y) < 1e-9 { self } else { Self { turn: x.atan2(-y), ..self } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: [f64; 2], b: [f64; 2]) -> bool {
        (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9
    }

    #[test]
    fn a_fitted_picture_touches_two_edges_of_the_canvas() {
        let wide = OverlayPlace::fitted([200.0, 100.0], 4.0);
        assert!(near(wide.point([0.0, 0.0], 4.0), [0.0, 25.0]), "{wide:?}");
        assert!(near(wide.point([1.0, 1.0], 4.0), [200.0, 75.0]), "{wide:?}");
        let high = OverlayPlace::fitted([200.0, 100.0], 0.5);
        assert!(near(high.point([0.0, 0.0], 0.5), [75.0, 0.0]), "{high:?}");
    }

    #[test]
    fn handles_stay_under_the_pointer() {
        let place = OverlayPlace::fitted([200.0, 100.0], 2.0).moved([10.0, -5.0]);
        assert_eq!(place.center, [110.0, 45.0]);
        // A corner in the direction of the picture's own.
        let corner = [place.center[0] + 40.0, place.center[1] + 20.0];
        let scaled = place.scaled_to(corner, 2.0);
        assert!(near(scaled.point([1.0, 1.0], 2.0), corner), "{scaled:?}");
        let turned = place.turned_to([150.0, 45.0]);
        assert!((turned.turn - std::f64::consts::FRAC_PI_2).abs() < 1e-9, "a quarter clockwise");
        let top = turned.point([0.5, 0.0], 2.0);
        assert!(near(top, [160.0, 45.0]), "the upper edge is at the right: {top:?}");
        let down = place.turned_to([110.0, 90.0]);
        assert!((down.turn - std::f64::consts::PI).abs() < 1e-9, "upside down: {down:?}");
        assert_eq!(place.scaled_to(place.center, 2.0).width_mm, LEAST_MM);
        assert_eq!(place.turned_to(place.center), place);
    }
}
