//! Where a picture lies in its panel.

use eframe::egui::{Pos2, Rect, Vec2, pos2, vec2};

/// The most points that a pixel of the picture is shown at, and the least.
const ZOOM: (f32, f32) = (0.02, 64.0);

/// How a picture is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placing {
    /// The pixel in the middle of the panel.
    pub(super) middle: Vec2,
    /// Points for each pixel.
    pub(super) zoom: f32,
    /// Whether left and right are exchanged.
    pub(super) flipped: bool,
}

impl Placing {
    /// All of a picture of `size` pixels in a panel of `room` points.
    pub(super) fn fit(size: Vec2, room: Vec2, flipped: bool) -> Self {
        let zoom = (room.x / size.x).min(room.y / size.y).clamp(ZOOM.0, ZOOM.1);
        Self { middle: size / 2.0, zoom, flipped }
    }

    fn side(self) -> f32 {
        if self.flipped { -1.0 } else { 1.0 }
    }

    /// The point of the panel where a place of the picture, in pixels, is shown.
    pub(super) fn point(self, panel: Rect, place: Vec2) -> Pos2 {
        let away = (place - self.middle) * self.zoom;
        panel.center() + vec2(self.side() * away.x, away.y)
    }

    /// The place of the picture, in pixels, that is shown at a point.
    pub(super) fn place(self, panel: Rect, point: Pos2) -> Vec2 {
        let away = (point - panel.center()) / self.zoom;
        self.middle + vec2(self.side() * away.x, away.y)
    }

    /// Moved along with the hand, in points.
    pub(super) fn panned(self, by: Vec2) -> Self {
        let away = by / self.zoom;
        Self { middle: self.middle - vec2(self.side() * away.x, away.y), ..self }
    }

    /// Enlarged, the place under a point staying there.
    pub(super) fn zoomed(self, panel: Rect, about: Pos2, factor: f32) -> Self {
        let zoom = (self.zoom * factor).clamp(ZOOM.0, ZOOM.1);
        let kept = self.place(panel, about);
        let moved = Self { zoom, ..self };
        let now = moved.place(panel, about);
        Self { middle: moved.middle + kept - now, ..moved }
    }

    /// Where all of a picture of `size` pixels is drawn, and which parts of it stand
    /// at the upper left and the lower right.
    pub(super) fn drawn(self, panel: Rect, size: Vec2) -> (Rect, Rect) {
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
    fn all_of_a_picture_fits_and_touches_two_edges() {
        for flipped in [false, true] {
            let placing = Placing::fit(vec2(1600.0, 400.0), PANEL.size(), flipped);
            let (rect, _) = placing.drawn(PANEL, vec2(1600.0, 400.0));
            assert_eq!((rect.left(), rect.right()), (100.0, 500.0));
            assert!(rect.top() > 50.0 && rect.bottom() < 350.0, "{rect:?}");
        }
    }

    #[test]
    fn points_and_places_are_one_flipped_or_not() {
        for flipped in [false, true] {
            let placing = Placing { middle: vec2(30.0, 70.0), zoom: 2.5, flipped };
            for place in [vec2(0.0, 0.0), vec2(31.0, 68.0), vec2(200.0, 10.0)] {
                let back = placing.place(PANEL, placing.point(PANEL, place));
                assert!(near(back, place), "{back:?} for {place:?}");
            }
        }
        let flipped = Placing { middle: vec2(30.0, 70.0), zoom: 2.0, flipped: true };
        let right = flipped.point(PANEL, vec2(40.0, 70.0));
        assert_eq!(right, PANEL.center() - vec2(20.0, 0.0), "what is right is shown left");
    }

    #[test]
    fn the_place_under_the_pointer_stays_while_zooming_and_follows_the_hand() {
        for flipped in [false, true] {
            let placing = Placing { middle: vec2(30.0, 70.0), zoom: 1.0, flipped };
            let (about, hand) = (pos2(140.0, 300.0), vec2(25.0, -12.0));
            let zoomed = placing.zoomed(PANEL, about, 3.0);
            assert!(near(zoomed.place(PANEL, about), placing.place(PANEL, about)));
            assert_eq!(zoomed.zoom, 3.0);
            let panned = placing.panned(hand);
            assert!(near(panned.place(PANEL, about + hand), placing.place(PANEL, about)));
            assert_eq!(placing.zoomed(PANEL, about, 1e9).zoom, ZOOM.1);
        }
    }
}
