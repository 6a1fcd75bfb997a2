//! For each square of pixels the splats that reach it.

use super::splat::StrokeSplat;

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
    let square = |at: f32| (at / SIDE as f32).floor() as i64;
    let last = square(at + reach).saturating_add(1).clamp(0, count as i64) as usize;
    (square(at - reach).max(0) as usize).min(last)..last
}

/// Whether the ellipse may reach a pixel of a square.
fn reaches(splat: &StrokeSplat, column: usize, row: usize) -> bool {
    const HALF: f32 = SIDE as f32 / 2.0;
    let middle = |square: usize| (square * SIDE) as f32 + HALF;
    let right = middle(column) - splat.x;
    let down = middle(row) - splat.y;
    let part = |[x, y]: [f32; 2]| {
        let most = (HALF - 0.5) * (x.abs() + y.abs());
        ((x * right + y * down).abs() - most).max(0.0)
    };
    let across = part(splat.across);
    let along = part(splat.along);
    across * across + along * along < 1.0
}

#[cfg(test)]
mod tests {
    use super::super::made_up::splat;
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
}
