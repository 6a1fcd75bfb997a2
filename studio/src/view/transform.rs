//! Where on the screen a cell is: zoomed about a place, turned, mirrored.
//!
//! A view is what the painter chose; a [`Placement`] is that view in a rectangle
//! of the window at one density, the same numbers both ways:
//!
//! ```text
//! point = middle + M R s (cell - centre)
//! ```
//!
//! with R the turn, M the mirror (of what is seen, left for right) and s points
//! a cell. In 64 bits, so that a place comes back to a millionth of a cell.

use std::f64::consts::{FRAC_PI_2, TAU};

use eframe::egui::{Pos2, Rect, Vec2};

/// Physical pixels a cell may have.
const ZOOM: std::ops::RangeInclusive<f64> = 0.02..=64.0;

/// A turn this near to a quarter is a quarter, in degrees.
const CATCH_DEG: f64 = 1.5;

/// What of a surface is seen, and how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// The cell in the middle of the view.
    pub centre: [f64; 2],
    /// Physical pixels a cell.
    pub zoom: f64,
    /// Clockwise as the surface is turned, in radians, before it is mirrored.
    pub turn: f64,
    /// Whether left and right are exchanged.
    pub mirror: bool,
    /// Whether the whole surface is kept in view when the window changes.
    pub fitted: bool,
}

impl Default for View {
    fn default() -> Self {
        Self { centre: [0.0; 2], zoom: 1.0, turn: 0.0, mirror: false, fitted: true }
    }
}

impl View {
    /// Shows all of a surface of `cells`, with `margin` points around it, as it is
    /// turned.
    pub fn fit(&mut self, cells: (usize, usize), room: Rect, margin: f32, density: f32) {
        let (width, height) = (cells.0 as f64, cells.1 as f64);
        let (sin, cos) = self.turn.sin_cos();
        let across = width * cos.abs() + height * sin.abs();
        let down = width * sin.abs() + height * cos.abs();
        let pixels = |points: f32| f64::from((points - 2.0 * margin).max(16.0) * density);
        let zoom = (pixels(room.width()) / across).min(pixels(room.height()) / down);
        self.zoom = zoom.clamp(*ZOOM.start(), *ZOOM.end());
        self.centre = [0.5 * width, 0.5 * height];
        self.fitted = true;
    }

    /// Moves what is seen by `delta` points.
    pub fn pan(&mut self, delta: Vec2, density: f32) {
        let scale = f64::from(density) / self.zoom;
        let moved = self.unturned([f64::from(delta.x) * scale, f64::from(delta.y) * scale]);
        self.centre = [self.centre[0] - moved[0], self.centre[1] - moved[1]];
        self.fitted = false;
    }

    /// Makes cells `factor` times as large; the cell at `about` stays there.
    pub fn zoom_by(&mut self, factor: f64, about: Pos2, room: Rect, density: f32) {
        self.keeping(about, room, density, |view| {
            view.zoom = (view.zoom * factor).clamp(*ZOOM.start(), *ZOOM.end());
        });
    }

    /// Turns what is seen clockwise, in radians; the cell at `about` stays there.
    pub fn rotate_about(&mut self, radians: f64, about: Pos2, room: Rect, density: f32) {
        self.keeping(about, room, density, |view| view.rotate(radians));
    }

    /// Changes the view, then moves it so that the cell at `about` is there again.
    fn keeping(&mut self, about: Pos2, room: Rect, density: f32, change: impl FnOnce(&mut Self)) {
        let fixed = self.placed(room, density).unsnapped(about);
        change(self);
        let now = self.placed(room, density).unsnapped(about);
        self.centre[0] += fixed[0] - now[0];
        self.centre[1] += fixed[1] - now[1];
        self.fitted = false;
    }

    /// One cell is one physical pixel; the middle of the view stays.
    pub fn actual_size(&mut self) {
        self.zoom = 1.0;
        self.fitted = false;
    }

    /// Turns what is seen about the middle of the view, clockwise, in radians.
    pub fn rotate(&mut self, radians: f64) {
        let turn = self.turn + if self.mirror { -radians } else { radians };
        self.turn = turn.rem_euclid(TAU);
    }

    /// The turn as it is shown: exactly a quarter where it is nearly one.
    #[must_use]
    pub fn caught_turn(&self) -> f64 {
        let quarters = (self.turn / FRAC_PI_2).round();
        let near = (self.turn - quarters * FRAC_PI_2).abs() < CATCH_DEG.to_radians();
        if near { (quarters * FRAC_PI_2).rem_euclid(TAU) } else { self.turn }
    }

    /// The view in a rectangle of the window, at `density` physical pixels a
    /// point.
    #[must_use]
    pub fn placed(&self, room: Rect, density: f32) -> Placement {
        let turn = self.caught_turn();
        let quarters = turn / FRAC_PI_2;
        // Exact at quarters, so that cells and pixels fall together.
        let (sin, cos) = if quarters == quarters.round() {
            [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][quarters as usize % 4]
        } else {
            turn.sin_cos()
        };
        let scale = self.zoom / f64::from(density);
        let flip = if self.mirror { -1.0 } else { 1.0 };
        let matrix = [[flip * cos * scale, flip * -sin * scale], [sin * scale, cos * scale]];
        let middle = [f64::from(room.center().x), f64::from(room.center().y)];
        let offset = [0, 1].map(|row: usize| {
            middle[row] - matrix[row][0] * self.centre[0] - matrix[row][1] * self.centre[1]
        });
        let aligned = quarters == quarters.round() && self.zoom == self.zoom.round();
        let whole = |points: f64| (points * f64::from(density)).round() / f64::from(density);
        let snapped = if aligned { offset.map(whole) } else { offset };
        let unsnapped = [offset[0] - snapped[0], offset[1] - snapped[1]];
        Placement { matrix, offset: snapped, unsnapped, turn, mirror: self.mirror, aligned }
    }

    /// From the screen's directions to the surface's.
    fn unturned(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.caught_turn().sin_cos();
        let x = if self.mirror { -x } else { x };
        [cos * x + sin * y, cos * y - sin * x]
    }
}

/// A view in a rectangle of the window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    matrix: [[f64; 2]; 2],
    offset: [f64; 2],
    unsnapped: [f64; 2],
    /// Clockwise turn of the surface before it is mirrored, in radians.
    pub turn: f64,
    /// Whether left and right are exchanged.
    pub mirror: bool,
    /// Whether edges of cells lie on edges of physical pixels.
    pub aligned: bool,
}

impl Placement {
    /// Where a place of the surface, in cells, is on the screen.
    #[must_use]
    pub fn point(&self, cell: [f64; 2]) -> Pos2 {
        let [[a, b], [c, d]] = self.matrix;
        let x = self.offset[0] + a * cell[0] + b * cell[1];
        let y = self.offset[1] + c * cell[0] + d * cell[1];
        Pos2::new(x as f32, y as f32)
    }

    /// What place of the surface, in cells, is at a point of the screen.
    #[must_use]
    pub fn cell(&self, point: Pos2) -> [f64; 2] {
        let x = f64::from(point.x) - self.offset[0];
        let y = f64::from(point.y) - self.offset[1];
        let [[a, b], [c, d]] = self.matrix;
        let size = a * d - b * c;
        [(d * x - b * y) / size, (a * y - c * x) / size]
    }

    /// Points a cell.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.matrix[0][0].hypot(self.matrix[1][0])
    }

    /// A direction of the surface on the screen, of the same length in points as
    /// it has in cells, times [`scale`](Self::scale).
    #[must_use]
    pub fn direction(&self, [x, y]: [f64; 2]) -> Vec2 {
        let [[a, b], [c, d]] = self.matrix;
        Vec2::new((a * x + b * y) as f32, (c * x + d * y) as f32)
    }

    /// A direction of the screen on the surface, of the same length.
    #[must_use]
    pub fn surface_direction(&self, direction: [f64; 2]) -> [f64; 2] {
        let [[a, b], [c, d]] = self.matrix;
        let [x, y] = direction.map(|along| along * self.scale() / (a * d - b * c));
        [d * x - b * y, a * y - c * x]
    }

    /// As [`cell`](Self::cell), before edges were laid on pixels.
    fn unsnapped(&self, point: Pos2) -> [f64; 2] {
        let offset = [0, 1].map(|axis: usize| self.offset[axis] + self.unsnapped[axis]);
        Self { offset, ..*self }.cell(point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{pos2, vec2};

    const ROOM: Rect = Rect { min: pos2(100.0, 40.0), max: pos2(900.0, 640.0) };

    fn odd() -> View {
        View { centre: [310.0, 95.5], zoom: 2.7, turn: 0.9, mirror: true, fitted: false }
    }

    fn near(a: [f64; 2], b: [f64; 2], by: f64) -> bool {
        (a[0] - b[0]).abs() < by && (a[1] - b[1]).abs() < by
    }

    #[test]
    fn a_cell_comes_back_from_the_screen() {
        for density in [1.0, 1.25, 2.0] {
            for mirror in [false, true] {
                for turn in [0.0, 0.4, FRAC_PI_2, 3.9] {
                    let placement = View { mirror, turn, ..odd() }.placed(ROOM, density);
                    for cell in [[0.0, 0.0], [640.0, 400.0], [123.25, 17.75]] {
                        let back = placement.cell(placement.point(cell));
                        // Points are 32 bits: a 16,000th of one near 1000.
                        assert!(near(cell, back, 2e-3), "{cell:?} {back:?} {placement:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn upright_cells_run_right_and_down_and_the_mirror_exchanges_left_and_right() {
        let view = View { centre: [10.0, 10.0], zoom: 2.0, ..View::default() };
        let placement = view.placed(ROOM, 1.0);
        assert_eq!(placement.point([10.0, 10.0]), ROOM.center());
        assert_eq!(placement.point([15.0, 12.0]), ROOM.center() + vec2(10.0, 4.0));
        let mirrored = View { mirror: true, ..view }.placed(ROOM, 1.0);
        assert_eq!(mirrored.point([15.0, 12.0]), ROOM.center() + vec2(-10.0, 4.0));
    }

    #[test]
    fn a_quarter_turn_is_clockwise_and_exact_also_in_the_mirror() {
        for mirror in [false, true] {
            let mut view = View { centre: [10.0, 10.0], zoom: 2.0, mirror, ..View::default() };
            let before = view.placed(ROOM, 1.0).point([15.0, 12.0]) - ROOM.center();
            // Within the catch.
            view.rotate(FRAC_PI_2 + 0.01);
            let placement = view.placed(ROOM, 1.0);
            let after = placement.point([15.0, 12.0]) - ROOM.center();
            assert_eq!(after, vec2(-before.y, before.x));
            assert!(placement.aligned, "{placement:?}");
        }
    }

    #[test]
    fn zooming_and_turning_keep_the_cell_below_the_pointer() {
        for factor in [0.5, 1.3, 4.0] {
            let mut view = odd();
            let pointer = pos2(250.0, 500.0);
            let before = view.placed(ROOM, 2.0).cell(pointer);
            view.zoom_by(factor, pointer, ROOM, 2.0);
            view.rotate_about(factor, pointer, ROOM, 2.0);
            let after = view.placed(ROOM, 2.0).cell(pointer);
            assert!(near(before, after, 1e-9), "{before:?} {after:?}");
            assert!((view.zoom - 2.7 * factor).abs() < 1e-12, "{view:?}");
        }
    }

    #[test]
    fn panning_moves_the_cell_with_the_pointer() {
        let mut view = odd();
        let from = pos2(300.0, 300.0);
        let cell = view.placed(ROOM, 1.5).cell(from);
        view.pan(vec2(37.0, -12.0), 1.5);
        let after = view.placed(ROOM, 1.5).cell(from + vec2(37.0, -12.0));
        assert!(near(cell, after, 1e-9), "{cell:?} {after:?}");
        assert!(!view.fitted, "{view:?}");
    }

    #[test]
    fn a_fitted_surface_touches_the_margin_and_never_crosses_it() {
        for turn in [0.0, 0.3, FRAC_PI_2, 2.0] {
            let mut view = View { turn, ..View::default() };
            view.fit((320, 200), ROOM, 20.0, 2.0);
            let placement = view.placed(ROOM, 2.0);
            let corners = [[0.0, 0.0], [320.0, 0.0], [0.0, 200.0], [320.0, 200.0]];
            let seen = Rect::from_points(&corners.map(|corner| placement.point(corner)));
            let room = ROOM.shrink(20.0);
            assert!(room.expand(0.01).contains_rect(seen), "{seen} {room}");
            let spare = (room.size() - seen.size()).min_elem();
            assert!(spare < 0.01, "{seen} {room}");
        }
    }

    #[test]
    fn at_actual_size_cells_lie_on_physical_pixels() {
        for density in [1.0, 1.5, 2.0] {
            let mut view = View { centre: [100.3, 50.7], zoom: 3.3, ..View::default() };
            view.actual_size();
            let placement = view.placed(ROOM, density);
            let at = |cell| placement.point(cell).to_vec2() * density;
            let (first, next) = (at([0.0, 0.0]), at([1.0, 1.0]));
            assert!((first - first.round()).length() < 1e-3, "{first}");
            assert!((next - first - vec2(1.0, 1.0)).length() < 1e-3, "{first} {next}");
        }
    }

    #[test]
    fn a_direction_comes_back_with_its_length() {
        let placement = odd().placed(ROOM, 2.0);
        let on_surface = placement.surface_direction([0.6, 0.8]);
        assert!((on_surface[0].hypot(on_surface[1]) - 1.0).abs() < 1e-12, "{on_surface:?}");
        let back = placement.direction(on_surface) / placement.scale() as f32;
        assert!((back - vec2(0.6, 0.8)).length() < 1e-6, "{back}");
    }
}
