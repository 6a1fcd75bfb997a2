//! View transform of a picture in its panel.

use eframe::egui::{Pos2, Rect, Vec2, pos2, vec2};

/// Minimum and maximum zoom, in points for each pixel.
const ZOOM: (f32, f32) = (0.02, 64.0);

/// Position, zoom and mirroring of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PictureView {
    /// Picture position at the centre of the panel, in pixels.
    pub(super) center: Vec2,
    /// Zoom in points for each pixel.
    pub(super) zoom: f32,
    /// Whether the picture is mirrored horizontally.
    pub(super) flipped: bool,
}

impl PictureView {
    /// Fits a picture of `size` pixels into a panel of `panel_size` points.
    pub(super) fn fit(size: Vec2, panel_size: Vec2, flipped: bool) -> Self {
        let zoom = (panel_size.x / size.x).min(panel_size.y / size.y).clamp(ZOOM.0, ZOOM.1);
        Self { center: size / 2.0, zoom, flipped }
    }

    fn side(self) -> f32 {
        if self.flipped { -1.0 } else { 1.0 }
    }

    /// Converts a picture position in pixels to a point of the window.
    pub(super) fn point(self, panel: Rect, place: Vec2) -> Pos2 {
        let offset = (place - self.center) * self.zoom;
        panel.center() + vec2(self.side() * offset.x, offset.y)
    }

    /// Converts a point of the window to a picture position in pixels.
    pub(super) fn place(self, panel: Rect, point: Pos2) -> Vec2 {
        let offset = (point - panel.center()) / self.zoom;
        self.center + vec2(self.side() * offset.x, offset.y)
    }

    /// Returns the view moved by a drag, in points.
    pub(super) fn panned(self, by: Vec2) -> Self {
        let offset = by / self.zoom;
        Self { center: self.center - vec2(self.side() * offset.x, offset.y), ..self }
    }

    /// Returns the view zoomed by a factor about a fixed point.
    pub(super) fn zoomed(self, panel: Rect, about: Pos2, factor: f32) -> Self {
        let zoom = (self.zoom * factor).clamp(ZOOM.0, ZOOM.1);
        let fixed = self.place(panel, about);
        let moved = Self { zoom, ..self };
        let now = moved.place(panel, about);
        Self { center: moved.center + fixed - now, ..moved }
    }

    /// Rectangle of the whole picture of `size` pixels in the window, and its texture
    /// coordinates.
    pub(super) fn rects(self, panel: Rect, size: Vec2) -> (Rect, Rect) {
        let rect = Rect::from_two_pos(self.point(panel, Vec2::ZERO), self.point(panel, size));
        let (left, right) = if self.flipped { (1.0, 0.0) } else { (0.0, 1.0) };
        (rect, Rect { min: pos2(left, 0.0), max: pos2(right, 1.0) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PANEL: Rect = Rect { min: pos2(100.0, 50.0), max: pos2(500.0, 350.0) };

    fn near(a: Vec2, b: Vec2) -> bool {
        (a - b).length() < 1e-3
    }

    #[test]
    fn a_fitted_picture_touches_two_edges() {
        for flipped in [false, true] {
            let view = PictureView::fit(vec2(1600.0, 400.0), PANEL.size(), flipped);
            let (rect, _) = view.rects(PANEL, vec2(1600.0, 400.0));
            assert_eq!((rect.left(), rect.right()), (100.0, 500.0));
            assert!(rect.top() > 50.0 && rect.bottom() < 350.0, "{rect:?}");
        }
    }

    #[test]
    fn point_and_position_are_inverse_flipped_or_not() {
        for flipped in [false, true] {
            let view = PictureView { center: vec2(30.0, 70.0), zoom: 2.5, flipped };
            for place in [vec2(0.0, 0.0), vec2(31.0, 68.0), vec2(200.0, 10.0)] {
                let back = view.place(PANEL, view.point(PANEL, place));
                assert!(near(back, place), "{back:?} for {place:?}");
            }
        }
        let flipped = PictureView { center: vec2(30.0, 70.0), zoom: 2.0, flipped: true };
        let right = flipped.point(PANEL, vec2(40.0, 70.0));
        assert_eq!(right, PANEL.center() - vec2(20.0, 0.0), "what is right is shown left");
    }

    #[test]
    fn zoom_keeps_the_point_and_pan_follows_the_drag() {
        for flipped in [false, true] {
            let view = PictureView { center: vec2(30.0, 70.0), zoom: 1.0, flipped };
            let about = pos2(140.0, 300.0);
            let hand = vec2(25.0, -12.0);
            let zoomed = view.zoomed(PANEL, about, 3.0);
            assert!(near(zoomed.place(PANEL, about), view.place(PANEL, about)));
            assert_eq!(zoomed.zoom, 3.0);
            let panned = view.panned(hand);
            assert!(near(panned.place(PANEL, about + hand), view.place(PANEL, about)));
            assert_eq!(view.zoomed(PANEL, about, 1e9).zoom, ZOOM.1);
        }
    }
}
