//! Which cells of a lattice a triangle enters.

use glam::DVec3;

use super::lattice::Lattice;

/// Distance from a wall between cells, as a share of a cell, within which an edge touches both.
const TOUCH: f64 = 1e-4;

/// The cells that the triangle between three places (in widths of a cell from the origin of the
/// lattice) enters, in a fixed order. A triangle that lies on a wall enters the cell above.
pub(super) fn entered(corners: [DVec3; 3], found: &mut Vec<[i32; 3]>) {
    let [a, b, c] = corners;
    let cell = |at: DVec3| at.floor().to_array().map(|value| value as i32);
    let low = cell(a.min(b).min(c));
    let high = cell(a.max(b).max(c));
    if low == high {
        found.push(low);
    } else {
        within(&corners, low, high.map(|value| value + 1), found);
    }
}

/// Searches the cells from `low` up to and without `high`, halving the longest side.
fn within(corners: &[DVec3; 3], low: [i32; 3], high: [i32; 3], found: &mut Vec<[i32; 3]>) {
    let size = [0, 1, 2].map(|axis| high[axis] - low[axis]);
    let axis = (0..3).fold(0, |most, axis| if size[axis] > size[most] { axis } else { most });
    let [from, to] = [low, high].map(|at| DVec3::from(at.map(f64::from)));
    if size[axis] == 1 {
        // The lower walls belong to the cell; a little more, as places near them are rounded.
        let rounding = DVec3::splat(1e-9);
        if meets(corners, from - rounding, to - DVec3::splat(TOUCH)) {
            found.push(low);
        }
    } else if meets(corners, from, to) {
        let middle = low[axis] + size[axis] / 2;
        let mut end = high;
        let mut start = low;
        (end[axis], start[axis]) = (middle, middle);
        within(corners, low, end, found);
        within(corners, start, high, found);
    }
}

/// Whether the line between two places (in widths of a cell) touches a cell.
pub(super) fn touches([a, b]: [DVec3; 2], cell: [i32; 3]) -> bool {
    let low = DVec3::from(cell.map(f64::from));
    let margin = DVec3::splat(TOUCH);
    meets(&[a, b, b], low - margin, low + DVec3::ONE + margin)
}

/// A place in widths of a cell from the origin of the lattice.
pub(super) fn in_cells(lattice: &Lattice, place: [f32; 3]) -> DVec3 {
    (glam::Vec3::from(place) - lattice.origin).as_dvec3() / f64::from(lattice.cell)
}

/// Whether a triangle meets a box: no axis separates them (Akenine-Moller, "Fast 3D triangle-box
/// overlap testing", 2001).
fn meets(corners: &[DVec3; 3], low: DVec3, high: DVec3) -> bool {
    const AXES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];
    let center = (low + high) / 2.0;
    let half = (high - low) / 2.0;
    let at = corners.map(|corner| corner - center);
    let edges = [at[1] - at[0], at[2] - at[1], at[0] - at[2]];
    let apart = |axis: DVec3| {
        let [a, b, c] = at.map(|place| place.dot(axis));
        let reach = half.dot(axis.abs());
        a.min(b).min(c) > reach || a.max(b).max(c) < -reach
    };
    let crossed = edges.iter().flat_map(|edge| AXES.map(|axis| axis.cross(*edge)));
    !AXES.into_iter().any(apart) && !apart(edges[0].cross(edges[1])) && !{ crossed }.any(apart)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn the_cells_of_every_point_of_a_triangle_are_entered_and_no_others() {
        let random = &mut ChaCha8Rng::seed_from_u64(1);
        for _ in 0..50 {
            let corners = [(); 3].map(|()| {
                let mut value = || random.random_range(-3.0..3.0);
                DVec3::new(value(), value(), value())
            });
            let mut found = Vec::new();
            entered(corners, &mut found);
            let mut hit: Vec<[i32; 3]> = Vec::new();
            for i in 0..=300 {
                for j in 0..=300 - i {
                    let [u, v] = [i, j].map(|share| f64::from(share) / 300.0);
                    let at =
                        corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v;
                    hit.push(at.floor().to_array().map(|value| value as i32));
                }
            }
            hit.sort_unstable();
            hit.dedup();
            found.sort_unstable();
            assert!(hit.iter().all(|cell| found.binary_search(cell).is_ok()));
            // Cells of which the triangle has less than a corner between two points.
            let missed = found.len() - hit.len();
            assert!(missed <= found.len() / 12 + 1, "{missed} of {}", found.len());
        }
    }

    #[test]
    fn a_triangle_on_a_wall_is_in_the_cells_above() {
        let corners = [[0.5, 2.0, 0.5], [3.5, 2.0, 0.5], [0.5, 2.0, 0.9]].map(DVec3::from);
        let mut found = Vec::new();
        entered(corners, &mut found);
        assert_eq!(found, [0, 1, 2, 3].map(|x| [x, 2, 0]));
        let edge = [corners[0], corners[1]];
        assert!(touches(edge, [1, 1, 0]) && touches(edge, [1, 2, 0]) && !touches(edge, [1, 3, 0]));
    }
}
