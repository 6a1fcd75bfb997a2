//! Zoom, pan, rotation and mirroring of a surface.
//!
//! You choose a [`ViewState`]. A [`Placement`] is this view in a rectangle of the window at one
//! pixel density, as an affine map:
//!
//! ```text
//! point = middle + M R s (cell - centre)
//! ```
//!
//! Here R is the rotation, M the mirroring (left and right of the rotated surface) and s the
//! scale in points per cell. We compute it in f64, so that a position maps back to within a
//! millionth of a cell.

use std::f64::consts::{FRAC_PI_2, TAU};

use eframe::egui::{Pos2, Rect, Vec2};

/// Range of the zoom, in physical pixels per cell.
const ZOOM: std::ops::RangeInclusive<f64> = 0.02..=64.0;

/// If a rotation is this close to a quarter turn, it snaps to it, in degrees.
const SNAP_DEG: f64 = 1.5;

/// Zoom, pan, rotation and mirroring of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewState {
    /// The position in the middle of the view, in cells.
    pub centre: [f64; 2],
    /// Physical pixels per cell.
    pub zoom: f64,
    /// Clockwise rotation of the surface before mirroring, in radians.
    pub rotation: f64,
    /// Whether left and right are exchanged in the window.
    pub mirror: bool,
    /// Whether the surface is fitted again whenever the window changes.
    pub fitted: bool,
}

impl Default for ViewState {
    fn default() -> Self {
        Self { centre: [0.0; 2], zoom: 1.0, rotation: 0.0, mirror: false, fitted: true }
    }
}

impl ViewState {
    /// Fits a surface of `cells` columns and rows into `rect`, with `margin` points around it, at
    /// its current rotation.
    pub fn fit(&mut self, cells: (usize, usize), rect: Rect, margin: f32, density: f32) {
        let width = cells.0 as f64;
        let height = cells.1 as f64;
        let (sin, cos) = self.rotation.sin_cos();
        let across = width * cos.abs() + height * sin.abs();
        let down = width * sin.abs() + height * cos.abs();
        let [room_across, room_down] = [rect.width(), rect.height()]
            .map(|points| f64::from((points - 2.0 * margin).max(16.0) * density));
        let zoom = (room_across / across).min(room_down / down);
        self.zoom = zoom.clamp(*ZOOM.start(), *ZOOM.end());
        self.centre = [0.5 * width, 0.5 * height];
        self.fitted = true;
    }

    /// Pans by `delta` points.
    pub fn pan(&mut self, delta: Vec2, density: f32) {
        let scale = f64::from(density) / self.zoom;
        let moved =
            self.surface_direction_of([f64::from(delta.x) * scale, f64::from(delta.y) * scale]);
        self.centre = [self.centre[0] - moved[0], self.centre[1] - moved[1]];
        self.fitted = false;
    }

    /// Scales by `factor`. The cell at the point `about` stays there.
    pub fn zoom_by(&mut self, factor: f64, about: Pos2, rect: Rect, density: f32) {
        self.keeping_fixed(about, rect, density, |view| {
            view.zoom = (view.zoom * factor).clamp(*ZOOM.start(), *ZOOM.end());
        });
    }

    /// Rotates clockwise, in radians. The cell at the point `about` stays there.
    pub fn rotate_about(&mut self, radians: f64, about: Pos2, rect: Rect, density: f32) {
        self.keeping_fixed(about, rect, density, |view| view.rotate(radians));
    }

    /// Applies `change`, then pans to move the cell at `about` back to its place.
    fn keeping_fixed(
        &mut self,
        about: Pos2,
        rect: Rect,
        density: f32,
        change: impl FnOnce(&mut Self),
    ) {
        let fixed = self.placement(rect, density).unsnapped(about);
        change(self);
        let now = self.placement(rect, density).unsnapped(about);
        self.centre[0] += fixed[0] - now[0];
        self.centre[1] += fixed[1] - now[1];
        self.fitted = false;
    }

    /// Sets the zoom to one physical pixel per cell. The middle of the view stays.
    pub fn actual_size(&mut self) {
        self.zoom = 1.0;
        self.fitted = false;
    }

    /// Rotates clockwise about the middle of the view, in radians.
    pub fn rotate(&mut self, radians: f64) {
        let rotation = self.rotation + if self.mirror { -radians } else { radians };
        self.rotation = rotation.rem_euclid(TAU);
    }

    /// The rotation that you see. Near a quarter turn it snaps to it.
    #[must_use]
    pub fn snapped_turn(&self) -> f64 {
        let quarters = (self.rotation / FRAC_PI_2).round();
        let near = (self.rotation - quarters * FRAC_PI_2).abs() < SNAP_DEG.to_radians();
        if near { (quarters * FRAC_PI_2).rem_euclid(TAU) } else { self.rotation }
    }

    /// The placement in a rectangle of the window, at `density` physical pixels per point.
    #[must_use]
    pub fn placement(&self, rect: Rect, density: f32) -> Placement {
        let rotation = self.snapped_turn();
        let quarters = rotation / FRAC_PI_2;
        // Sines and cosines are exact at quarter turns, so that cells align with pixels.
        let (sin, cos) = if quarters == quarters.round() {
            [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][quarters as usize % 4]
        } else {
            rotation.sin_cos()
        };
        let scale = self.zoom / f64::from(density);
        let flip = if self.mirror { -1.0 } else { 1.0 };
        let matrix = [[flip * cos * scale, flip * -sin * scale], [sin * scale, cos * scale]];
        let middle = [f64::from(rect.center().x), f64::from(rect.center().y)];
        let offset = [0, 1].map(|row: usize| {
            middle[row] - matrix[row][0] * self.centre[0] - matrix[row][1] * self.centre[1]
        });
        let aligned = quarters == quarters.round() && self.zoom == self.zoom.round();
        let snapped = if aligned {
            offset.map(|points: f64| (points * f64::from(density)).round() / f64::from(density))
        } else {
            offset
        };
        let unsnapped = [offset[0] - snapped[0], offset[1] - snapped[1]];
        Placement { matrix, offset: snapped, unsnapped, rotation, mirror: self.mirror, aligned }
    }

    /// Converts a direction on the screen to one on the surface.
    fn surface_direction_of(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.snapped_turn().sin_cos();
        let x = if self.mirror { -x } else { x };
        [cos * x + sin * y, cos * y - sin * x]
    }
}

/// A view in a rectangle of the window: the map between cells and points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    matrix: [[f64; 2]; 2],
    offset: [f64; 2],
    unsnapped: [f64; 2],
    /// Clockwise rotation of the surface before mirroring, in radians.
    pub rotation: f64,
    /// Whether left and right are exchanged in the window.
    pub mirror: bool,
    /// Whether cell edges lie on the edges of physical pixels.
    pub aligned: bool,
}

impl Placement {
    /// Converts a position in cells to a point of the screen.
    #[must_use]
    pub fn point(&self, cell: [f64; 2]) -> Pos2 {
        let [[a, b], [c, d]] = self.matrix;
        let x = self.offset[0] + a * cell[0] + b * cell[1];
        let y = self.offset[1] + c * cell[0] + d * cell[1];
        Pos2::new(x as f32, y as f32)
    }

    /// Converts a point of the screen to a position in cells.
    #[must_use]
    pub fn cell(&self, point: Pos2) -> [f64; 2] {
        let x = f64::from(point.x) - self.offset[0];
        let y = f64::from(point.y) - self.offset[1];
        let [[a, b], [c, d]] = self.matrix;
        let size = a * d - b * c;
        [(d * x - b * y) / size, (a * y - c * x) / size]
    }

    /// Scale in points per cell.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.matrix[0][0].hypot(self.matrix[1][0])
    }

    /// Converts a direction on the surface to the screen. Its length in points is its length in
    /// cells times [`scale`](Self::scale).
    #[must_use]
    pub fn direction(&self, [x, y]: [f64; 2]) -> Vec2 {
        let [[a, b], [c, d]] = self.matrix;
        Vec2::new((a * x + b * y) as f32, (c * x + d * y) as f32)
    }

    /// Like [`cell`](Self::cell), without the shift that aligns cells with pixels.
    fn unsnapped(&self, point: Pos2) -> [f64; 2] {
        let offset = [0, 1].map(|axis: usize| self.offset[axis] + self.unsnapped[axis]);
        Self { offset, ..*self }.cell(point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{pos2, vec2};

    const RECT: Rect = Rect { min: pos2(100.0, 40.0), max: pos2(900.0, 640.0) };

    fn general_view() -> ViewState {
        ViewState { centre: [310.0, 95.5], zoom: 2.7, rotation: 0.9, mirror: true, fitted: false }
    }

    fn near(a: [f64; 2], b: [f64; 2], by: f64) -> bool {
        (a[0] - b[0]).abs() < by && (a[1] - b[1]).abs() < by
    }

    #[test]
    fn cells_survive_the_round_trip_to_the_screen() {
        for density in [1.0, 1.25, 2.0] {
            for mirror in [false, true] {
                for rotation in [0.0, 0.4, FRAC_PI_2, 3.9] {
                    let placement =
                        ViewState { mirror, rotation, ..general_view() }.placement(RECT, density);
                    for cell in [[0.0, 0.0], [640.0, 400.0], [123.25, 17.75]] {
                        let back = placement.cell(placement.point(cell));
                        // Points are f32 values, with a resolution of 1/16,000 near 1000.
                        assert!(near(cell, back, 2e-3), "{cell:?} {back:?} {placement:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn unrotated_cells_run_right_and_down_and_mirroring_exchanges_left_and_right() {
        let view = ViewState { centre: [10.0, 10.0], zoom: 2.0, ..ViewState::default() };
        let placement = view.placement(RECT, 1.0);
        assert_eq!(placement.point([10.0, 10.0]), RECT.center());
        assert_eq!(placement.point([15.0, 12.0]), RECT.center() + vec2(10.0, 4.0));
        let mirrored = ViewState { mirror: true, ..view }.placement(RECT, 1.0);
        assert_eq!(mirrored.point([15.0, 12.0]), RECT.center() + vec2(-10.0, 4.0));
    }

    #[test]
    fn a_quarter_turn_is_clockwise_and_exact_also_when_mirrored() {
        for mirror in [false, true] {
            let mut view =
                ViewState { centre: [10.0, 10.0], zoom: 2.0, mirror, ..ViewState::default() };
            let before = view.placement(RECT, 1.0).point([15.0, 12.0]) - RECT.center();
            // This is close enough to snap to a quarter turn.
            view.rotate(FRAC_PI_2 + 0.01);
            let placement = view.placement(RECT, 1.0);
            let after = placement.point([15.0, 12.0]) - RECT.center();
            assert_eq!(after, vec2(-before.y, before.x));
            assert!(placement.aligned, "{placement:?}");
        }
    }

    #[test]
    fn zooming_and_rotating_keep_the_cell_below_the_pointer() {
        for factor in [0.5, 1.3, 4.0] {
            let mut view = general_view();
            let pointer = pos2(250.0, 500.0);
            let before = view.placement(RECT, 2.0).cell(pointer);
            view.zoom_by(factor, pointer, RECT, 2.0);
            view.rotate_about(factor, pointer, RECT, 2.0);
            let after = view.placement(RECT, 2.0).cell(pointer);
            assert!(near(before, after, 1e-9), "{before:?} {after:?}");
            assert!((view.zoom - 2.7 * factor).abs() < 1e-12, "{view:?}");
        }
    }

    #[test]
    fn panning_moves_the_cell_with_the_pointer() {
        let mut view = general_view();
        let from = pos2(300.0, 300.0);
        let cell = view.placement(RECT, 1.5).cell(from);
        view.pan(vec2(37.0, -12.0), 1.5);
        let after = view.placement(RECT, 1.5).cell(from + vec2(37.0, -12.0));
        assert!(near(cell, after, 1e-9), "{cell:?} {after:?}");
        assert!(!view.fitted, "{view:?}");
    }

    #[test]
    fn a_fitted_surface_touches_the_margin_and_never_crosses_it() {
        for rotation in [0.0, 0.3, FRAC_PI_2, 2.0] {
            let mut view = ViewState { rotation, ..ViewState::default() };
            view.fit((320, 200), RECT, 20.0, 2.0);
            let placement = view.placement(RECT, 2.0);
            let corners = [[0.0, 0.0], [320.0, 0.0], [0.0, 200.0], [320.0, 200.0]];
            let seen = Rect::from_points(&corners.map(|corner| placement.point(corner)));
            let rect = RECT.shrink(20.0);
            assert!(rect.expand(0.01).contains_rect(seen), "{seen} {rect}");
            let spare = (rect.size() - seen.size()).min_elem();
            assert!(spare < 0.01, "{seen} {rect}");
        }
    }

    #[test]
    fn at_actual_size_cells_lie_on_physical_pixels() {
        for density in [1.0, 1.5, 2.0] {
            let mut view = ViewState { centre: [100.3, 50.7], zoom: 3.3, ..ViewState::default() };
            view.actual_size();
            let placement = view.placement(RECT, density);
            let [first, next] =
                [[0.0, 0.0], [1.0, 1.0]].map(|cell| placement.point(cell).to_vec2() * density);
            assert!((first - first.round()).length() < 1e-3, "{first}");
            assert!((next - first - vec2(1.0, 1.0)).length() < 1e-3, "{first} {next}");
        }
    }
}
