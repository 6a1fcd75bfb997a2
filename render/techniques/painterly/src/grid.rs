//! Points in space, sorted so that those near a place are found quickly.

use glam::Vec3;

/// Points in cubes of one size.
#[derive(Debug, Clone, Default)]
pub(super) struct Grid {
    /// Side of a cube.
    side: f32,
    /// Cube and index of each point, sorted.
    order: Vec<([i32; 3], u32)>,
}

impl Grid {
    /// Sorts points into cubes of this side, above 0.
    pub(super) fn new(points: impl Iterator<Item = Vec3>, side: f32) -> Self {
        let mut order: Vec<_> = points.map(|point| cube(point, side)).zip(0..).collect();
        order.sort_unstable();
        Self { side, order }
    }

    /// Indices of the points in the cube of a place and in all cubes around it: all points that are
    /// nearer than the side of a cube, and some more.
    pub(super) fn near(&self, place: Vec3) -> impl Iterator<Item = usize> + '_ {
        let [i, j, k] = cube(place, self.side);
        let columns = (-1..=1).flat_map(move |x: i32| (-1..=1).map(move |y: i32| (x, y)));
        columns.flat_map(move |(x, y)| {
            let at = |k| [i.saturating_add(x), j.saturating_add(y), k];
            // The cubes of a column follow one another.
            let [low, high] = [at(k.saturating_sub(1)), at(k.saturating_add(1))];
            let first = self.order.partition_point(|(cube, _)| *cube < low);
            let column = self.order[first..].iter().take_while(move |(cube, _)| *cube <= high);
            column.map(|(_, index)| *index as usize)
        })
    }
}

fn cube(point: Vec3, side: f32) -> [i32; 3] {
    (point / side).floor().to_array().map(|at| at as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_points_within_the_side_of_a_cube_are_near() {
        let point = |i: usize| {
            let [x, y, z] = [i % 7, i / 7 % 11, i / 77].map(|part| part as f32);
            Vec3::new(0.37 * x - 1.0, 0.23 * y - 1.3, 0.29 * z - 0.7)
        };
        let grid = Grid::new((0..300).map(point), 0.4);
        for place in [Vec3::ZERO, point(17), Vec3::splat(-1.1), Vec3::splat(50.0)] {
            let near: Vec<usize> = grid.near(place).collect();
            for index in 0..300 {
                let within = point(index).distance(place) < 0.4;
                assert!(!within || near.contains(&index), "{index} near {place}");
            }
            assert!(near.len() < 150, "{} near {place}", near.len());
        }
    }
}
