//! Strokes in the picture. We list the splats that reach each square of pixels, find their weights
//! in one square, and do pass 1, the nearest splat before the mesh.
//!
//! Strokes reach beyond the outline of their surface. Where several surfaces do this, you see the
//! nearest one. The mesh hides it like any surface.

use graphics::field::Field;
use graphics::lanes::{greater, lesser};

/// A splat of brushwork in the picture: an ellipse with a part of the map.
///
/// Coordinates across and along the stroke are 0 at the centre. The splat ends where the sum of
/// their squares is 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeSplat {
    /// Distance of the centre from the left edge, in pixels.
    pub x: f32,
    /// Distance of the centre from the upper edge, in pixels.
    pub y: f32,
    /// Change of the coordinate across the stroke per pixel to the right and downwards.
    pub across: [f32; 2],
    /// Change of the coordinate along the stroke per pixel to the right and downwards.
    pub along: [f32; 2],
    /// Half the width and height of the ellipse's bounding box, in pixels.
    pub reach: [f32; 2],
    /// Depth of the centre, 0 (near plane) to 1 (far plane).
    pub depth: f32,
    /// Change of depth on the splat's plane per pixel to the right and downwards.
    pub slope: [f32; 2],
    /// Depth within which surfaces count as the same.
    pub tolerance: f32,
    /// Weight at the centre against other splats, above 0: up to 1, and more for outlines.
    pub weight: f32,
    /// Amount that the splat adds to the cover at its centre, above 0 and up to 1.
    pub cover: f32,
    /// Place in the map at the centre, in widths of the map.
    pub offset: [f32; 2],
    /// Change of the place per unit across and along the stroke, in widths of the map.
    pub extent: [f32; 2],
    /// Tone of the stroke as an index of the map's slices.
    pub slice: u32,
    /// How often the map is halved in size.
    pub halvings: u32,
    /// Colour that is added to the map's.
    pub color: [f32; 3],
}

impl StrokeSplat {
    /// Angle of the stroke in the picture in radians: 0 to the right, positive downwards.
    #[must_use]
    pub fn turn(&self) -> f32 {
        // The inverse of the coordinates' matrix, up to its sign and size.
        let size = self.across[0] * self.along[1] - self.across[1] * self.along[0];
        (self.across[0] * size.signum()).atan2(-self.across[1] * size.signum())
    }
}

/// Width and height of a square of pixels.
pub(super) const SIDE: usize = 8;

/// The splats of all squares.
#[derive(Debug)]
pub(super) struct Lists {
    /// Number of squares in a row.
    pub(super) across: usize,
    /// Index in `splats` at which the list of each square begins, then the end of the last.
    starts: Vec<u32>,
    /// Indices of splats, list after list, in rising order.
    splats: Vec<u32>,
}

impl Lists {
    pub(super) fn new(width: usize, height: usize, splats: &[StrokeSplat]) -> Self {
        let across = width.div_ceil(SIDE);
        let down = height.div_ceil(SIDE);
        let mut reached = Vec::with_capacity(24 * splats.len());
        let mut starts = vec![0_u32; across * down + 1];
        for (splat, number) in splats.iter().zip(0..) {
            let columns = squares(splat.x, splat.reach[0], across);
            for row in squares(splat.y, splat.reach[1], down) {
                for column in columns.clone() {
                    if reaches(splat, column, row) {
                        reached.push(((row * across + column) as u32, number));
                        starts[row * across + column + 1] += 1;
                    }
                }
            }
        }
        for square in 0..across * down {
            starts[square + 1] += starts[square];
        }
        let mut lists = vec![0_u32; reached.len()];
        let mut next = starts.clone();
        for (square, number) in reached {
            let next = &mut next[square as usize];
            lists[*next as usize] = number;
            *next += 1;
        }
        Self { across, starts, splats: lists }
    }

    /// Indices of the splats of one square, in rising order.
    pub(super) fn of(&self, square: usize) -> &[u32] {
        &self.splats[self.starts[square] as usize..self.starts[square + 1] as usize]
    }

    /// For each square where its list begins in [`Self::numbers`], then the end of the last.
    pub(super) fn starts(&self) -> &[u32] {
        &self.starts
    }

    /// Indices of splats, list after list.
    pub(super) fn numbers(&self) -> &[u32] {
        &self.splats
    }
}

/// The squares, out of `count`, that a range of pixels touches.
fn squares(at: f32, reach: f32, count: usize) -> std::ops::Range<usize> {
    fn square(at: f32) -> i64 {
        (at / SIDE as f32).floor() as i64
    }
    let last = square(at + reach).saturating_add(1).clamp(0, count as i64) as usize;
    (square(at - reach).max(0) as usize).min(last)..last
}

/// Whether the ellipse may reach a pixel of a square.
fn reaches(splat: &StrokeSplat, column: usize, row: usize) -> bool {
    const HALF: f32 = SIDE as f32 / 2.0;
    fn middle(square: usize) -> f32 {
        (square * SIDE) as f32 + HALF
    }
    let right = middle(column) - splat.x;
    let down = middle(row) - splat.y;
    fn part([x, y]: [f32; 2], down: f32, right: f32) -> f32 {
        let most = (HALF - 0.5) * (x.abs() + y.abs());
        ((x * right + y * down).abs() - most).max(0.0)
    }
    let across = part(splat.across, down, right);
    let along = part(splat.along, down, right);
    across * across + along * along < 1.0
}

/// A value for each pixel of a square.
pub(super) type Values = [[f32; SIDE]; SIDE];

/// Depth of a pixel at which there is no surface.
const NOTHING: f32 = 1.0;

#[derive(Debug, Clone)]
pub(super) struct Square {
    pub(super) first: [f32; 2],
    /// Depth of the mesh at each pixel, 1 where there is none and beyond the picture.
    pub(super) depths: Values,
    range: [f32; 2],
}

/// Where a splat lies relative to the mesh, over a square.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Lie {
    /// Behind the mesh everywhere.
    Hidden,
    /// On the mesh everywhere.
    On,
    /// Anything else: for example, in front of the mesh, or on it at some pixels only.
    Mixed,
}

impl Square {
    /// The square with the upper left pixel (`x`, `y`).
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

    /// For each pixel, the share of 0 to 1 with which the plane of a splat lies on the mesh, and
    /// the share with which it lies before the mesh.
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
/// power of Taylor's for exp(-1.125 x) about 1/2. Its error is below 0.002.
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

/// How fast a splat recedes towards its edge. Where its weight is 1/(1 + n), it counts n times this
/// share of its tolerance farther away. So no splat is nearest where it has no weight.
const BOWL: f32 = 0.1;

/// The depth at which a splat counts: its plane, bent back where its weight is low.
#[inline(always)]
pub(super) fn bowl(splat: &StrokeSplat, plane: &Values, weight: &Values) -> Values {
    let mut bowl = [[0.0; SIDE]; SIDE];
    let depth = BOWL * splat.tolerance;
    for row in 0..SIDE {
        for column in 0..SIDE {
            let weight = weight[row][column];
            let weight = if weight > 1e-6 { weight } else { 1e-6 };
            bowl[row][column] = plane[row][column] + depth * (1.0 / weight - 1.0);
        }
    }
    bowl
}

/// Replaces the nearest depth by the depth of a splat where the splat is nearer.
#[inline(always)]
pub(super) fn bring_forward(nearest: &mut Values, bowl: &Values) {
    for (nearest, bowl) in nearest.iter_mut().zip(bowl) {
        for (nearest, bowl) in nearest.iter_mut().zip(bowl) {
            *nearest = lesser(*nearest, *bowl);
        }
    }
}

/// Share, 0 to 1, with which a splat belongs to the nearest surface.
#[inline(always)]
pub(super) fn nearness(splat: &StrokeSplat, nearest: &Values, bowl: &Values) -> Values {
    let mut near = [[0.0; SIDE]; SIDE];
    let per_tolerance = 1.0 / splat.tolerance;
    for row in 0..SIDE {
        for column in 0..SIDE {
            let behind = (bowl[row][column] - nearest[row][column]) * per_tolerance;
            let share = lesser(2.0 - behind, 1.0);
            near[row][column] = if share > 0.0 { share } else { 0.0 };
        }
    }
    near
}

#[cfg(test)]
mod tests {
    use super::super::test_scenes::splat;
    use super::*;

    #[test]
    fn a_list_has_all_splats_that_reach_a_pixel_of_its_square() {
        let splats: Vec<StrokeSplat> = (0..40)
            .map(|i| {
                let at = [(i * 37 % 90) as f32 - 4.3, (i * 53 % 70) as f32 - 3.8];
                splat(at, [4.0 + (i % 5) as f32, 13.0], i as f32 * 0.4)
            })
            .collect();
        let width = 83;
        let height = 61;
        let lists = Lists::new(width, height, &splats);
        let mut spare = 0;
        for square in 0..lists.across * height.div_ceil(SIDE) {
            let left = square % lists.across * SIDE;
            let top = square / lists.across * SIDE;
            let list = lists.of(square);
            assert!(list.windows(2).all(|pair| pair[0] < pair[1]));
            for (splat, number) in splats.iter().zip(0..) {
                let inside = (0..SIDE * SIDE).any(|pixel| {
                    let right = (left + pixel % SIDE) as f32 + 0.5 - splat.x;
                    let down = (top + pixel / SIDE) as f32 + 0.5 - splat.y;
                    let [a, b] = [splat.across, splat.along].map(|[x, y]| x * right + y * down);
                    a * a + b * b < 1.0
                });
                let listed = list.contains(&number);
                assert!(listed || !inside, "splat {number} in square {square}");
                spare += usize::from(listed && !inside);
            }
        }
        let all: usize =
            (0..lists.across * height.div_ceil(SIDE)).map(|at| lists.of(at).len()).sum();
        assert!(spare * 4 < all, "{spare} of {all} for nothing");
    }

    #[test]
    fn splats_beyond_the_picture_are_in_no_list() {
        let far = splat([-50.0, 20.0], [5.0, 9.0], 0.3);
        let lists = Lists::new(30, 30, &[far]);
        assert!((0..16).all(|square| lists.of(square).is_empty()));
        assert_eq!(Lists::new(0, 0, &[far]).across, 0);
    }

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

    #[test]
    fn the_nearer_splat_hides_the_farther_where_it_has_weight() {
        let near = splat([4.0, 4.0], [6.0, 9.0], 0.0);
        let far = StrokeSplat { depth: 0.6, ..near };
        let mut weight = [[1.0; SIDE]; SIDE];
        weight[0][0] = 0.0;
        fn flat(depth: f32) -> [[f32; 8]; 8] {
            [[depth; SIDE]; SIDE]
        }
        let bowls = [
            bowl(&near, &flat(near.depth), &weight),
            bowl(&far, &flat(far.depth), &[[1.0; SIDE]; SIDE]),
        ];
        let mut nearest = flat(f32::INFINITY);
        bowls.iter().for_each(|bowl| bring_forward(&mut nearest, bowl));
        let shares = [nearness(&near, &nearest, &bowls[0]), nearness(&far, &nearest, &bowls[1])];
        assert_eq!((shares[0][3][3], shares[1][3][3]), (1.0, 0.0));
        assert_eq!((shares[0][0][0], shares[1][0][0]), (0.0, 1.0));
    }

    #[test]
    fn a_splat_recedes_without_a_step_as_its_weight_falls() {
        let own = splat([4.0, 4.0], [6.0, 9.0], 0.0);
        let mut last = 0.0;
        for step in 1..=1000 {
            let weight = [[step as f32 / 1000.0; SIDE]; SIDE];
            let bowl = bowl(&own, &[[0.5; SIDE]; SIDE], &weight);
            let near = nearness(&own, &[[0.5; SIDE]; SIDE], &bowl)[0][0];
            assert!(near >= last && near - last < 0.05, "{step}: {last} {near}");
            last = near;
        }
        assert_eq!(last, 1.0);
    }
}
