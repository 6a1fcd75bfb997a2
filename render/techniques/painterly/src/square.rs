//! One square of pixels and the weights of splats in it.

use graphics::field::Field;
use graphics::lanes::{greater, lesser};

use super::lists::SIDE;
use super::splat::StrokeSplat;

/// A value for each pixel of a square.
pub(super) type Values = [[f32; SIDE]; SIDE];

/// Depth of a pixel without a surface.
const NOTHING: f32 = 1.0;

/// A square of pixels.
#[derive(Debug, Clone)]
pub(super) struct Square {
    /// Centre of its first pixel.
    pub(super) first: [f32; 2],
    /// Depth of the mesh at each pixel; 1 where there is none and beyond the picture.
    pub(super) depths: Values,
    /// Least and greatest depth.
    range: [f32; 2],
}

/// How a splat lies to the mesh in a square.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Lie {
    /// Behind the mesh everywhere.
    Hidden,
    /// On the mesh everywhere.
    On,
    /// Not the same everywhere: some pixels show something else behind it, or before it.
    Mixed,
}

impl Square {
    /// The square whose upper left pixel is (`x`, `y`).
    pub(super) fn new(depth: &Field<f32>, x: usize, y: usize) -> Self {
        let mut depths = [[NOTHING; SIDE]; SIDE];
        let columns = SIDE.min(depth.width() - x);
        for (row, depths) in depths.iter_mut().enumerate().take(depth.height() - y) {
            depths[..columns].copy_from_slice(depth.row(y + row, x, columns));
        }
        let rows = SIDE.min(depth.height() - y);
        let inside = depths[..rows].iter().flat_map(|row| &row[..columns]);
        let range = inside.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], &at| {
            [lesser(low, at), greater(high, at)]
        });
        Self { first: [x as f32 + 0.5, y as f32 + 0.5], depths, range }
    }

    /// How a splat lies to the mesh.
    #[inline(always)]
    pub(super) fn lie(&self, splat: &StrokeSplat) -> Lie {
        const HALF: f32 = (SIDE - 1) as f32 / 2.0;
        let [right, down] = [self.first[0] - splat.x + HALF, self.first[1] - splat.y + HALF];
        let middle = splat.depth + splat.slope[0] * right + splat.slope[1] * down;
        let half = HALF * (splat.slope[0].abs() + splat.slope[1].abs());
        let least = self.range[0] - middle - half;
        let most = self.range[1] - middle + half;
        if most <= -2.0 * splat.tolerance {
            Lie::Hidden
        } else if least >= -splat.tolerance && most <= splat.tolerance && self.range[1] < NOTHING {
            Lie::On
        } else {
            Lie::Mixed
        }
    }

    /// Depth of the plane of a splat at each pixel.
    #[inline(always)]
    pub(super) fn plane(&self, splat: &StrokeSplat) -> Values {
        let mut plane = [[0.0; SIDE]; SIDE];
        for (row, values) in plane.iter_mut().enumerate() {
            let down = self.first[1] - splat.y + row as f32;
            let first = splat.depth + splat.slope[1] * down;
            for (column, value) in values.iter_mut().enumerate() {
                let right = self.first[0] - splat.x + column as f32;
                *value = first + splat.slope[0] * right;
            }
        }
        plane
    }

    /// Weight of a splat at each pixel: its own weight times a Gaussian of the distance d from its
    /// centre, exp(-4.5 d^2) brought to 0 at d = 1.
    #[inline(always)]
    pub(super) fn shape(&self, splat: &StrokeSplat) -> Values {
        let [[ax, ay], [bx, by]] = [splat.across, splat.along];
        let left = self.first[0] - splat.x;
        let mut shape = [[0.0; SIDE]; SIDE];
        for (row, values) in shape.iter_mut().enumerate() {
            let down = self.first[1] - splat.y + row as f32;
            if down.abs() >= splat.reach[1] {
                continue;
            }
            let first_a = ax * left + ay * down;
            let first_b = bx * left + by * down;
            for (column, value) in values.iter_mut().enumerate() {
                let a = first_a + ax * column as f32;
                let b = first_b + bx * column as f32;
                *value = splat.weight * bell(a * a + b * b);
            }
        }
        shape
    }

    /// Where the plane of a splat lies on the mesh, as a share of 0 to 1, and where before it.
    #[inline(always)]
    pub(super) fn shares(&self, splat: &StrokeSplat, plane: &Values) -> [Values; 2] {
        let mut shares = [[[0.0; SIDE]; SIDE]; 2];
        let per_tolerance = 1.0 / splat.tolerance;
        for row in 0..SIDE {
            for column in 0..SIDE {
                let depth = self.depths[row][column];
                let before = (depth - plane[row][column]) * per_tolerance;
                let on = greater(lesser(2.0 - before.abs(), 1.0), 0.0);
                let on = if depth < NOTHING { on } else { 0.0 };
                shares[0][row][column] = on;
                shares[1][row][column] = if before > 0.0 { 1.0 - on } else { 0.0 };
            }
        }
        shares
    }
}

/// exp(-4.5 x) brought to 0 at x = 1 and beyond, for x of 0 and up. The polynomial is the fourth
/// power of Taylor's for exp(-1.125 x) about 1/2; its error is below 0.002.
#[inline(always)]
fn bell(square: f32) -> f32 {
    const MIDDLE: f32 = 0.569_782_8;
    const END: f32 = 0.011_142_5;
    let t = -1.125 * (square - 0.5);
    let root = 1.0 + t * (1.0 + t * (0.5 + t * (1.0 / 6.0 + t * (1.0 / 24.0))));
    let root = MIDDLE * root;
    let second = root * root;
    let bell = (second * second - END) * (1.0 / (1.0 - END));
    let bell = if bell > 0.0 { bell } else { 0.0 };
    if square < 1.0 { bell } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::super::made_up::splat;
    use super::*;

    #[test]
    fn the_bell_is_a_gaussian_that_ends_at_one() {
        for step in 0..=1000 {
            let square = step as f32 / 1000.0;
            let end = (-4.5_f32).exp();
            let wanted = ((-4.5 * square).exp() - end) / (1.0 - end);
            assert!((bell(square) - wanted).abs() < 2e-3, "{square}: {} {wanted}", bell(square));
        }
        assert!(bell(0.999) < 1e-3 && bell(1.0) == 0.0 && bell(7.0) == 0.0);
    }

    #[test]
    fn a_splat_is_hidden_on_the_mesh_or_before_it() {
        let depth = |value| Square::new(&Field::filled(8, 8, value), 0, 0);
        let own = splat([4.0, 4.0], [6.0, 9.0], 0.4);
        assert_eq!(depth(0.5).lie(&own), Lie::On);
        assert_eq!(depth(0.47).lie(&own), Lie::Hidden);
        assert_eq!(depth(0.485).lie(&own), Lie::Mixed);
        assert_eq!(depth(1.0).lie(&own), Lie::Mixed);
        for (at, on, before) in [
            (0.5, 1.0, 0.0),
            (0.485, 0.5, 0.0),
            (0.515, 0.5, 0.5),
            (0.6, 0.0, 1.0),
            (1.0, 0.0, 1.0),
        ] {
            let square = depth(at);
            let [found_on, found_before] = square.shares(&own, &square.plane(&own));
            assert!((found_on[3][3] - on).abs() < 1e-4, "{at}: {}", found_on[3][3]);
            assert!((found_before[3][3] - before).abs() < 1e-4, "{at}: {}", found_before[3][3]);
        }
    }

    #[test]
    fn a_shape_falls_from_the_centre_to_the_end_of_the_ellipse() {
        let square = Square::new(&Field::filled(8, 8, 0.5), 0, 0);
        let own = StrokeSplat { weight: 0.5, ..splat([3.5, 3.5], [2.0, 4.0], 0.0) };
        let shape = square.shape(&own);
        assert!((shape[3][3] - 0.5).abs() < 1e-3, "{}", shape[3][3]);
        assert!(shape[3][5] < 1e-3 && shape[5][3] > 0.1, "{shape:?}");
        assert_eq!(shape[3][6], 0.0);
    }
}
