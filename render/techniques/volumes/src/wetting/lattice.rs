//! Cubes of one size that fill space, and their numbers. You can find the cells that a triangle
//! enters. This also has the reasons why we cannot wet a surface.

use documents::hint::Explain;
use glam::{DVec3, Vec3};
use graphics::mesh::MeshFault;

/// Where the middle of the model lies in its cell, as a share of each side. We avoid 0 and 1/2, and
/// their sums with round shares of a cell. Then faces of simple models lie inside of cells, not on
/// the walls between them.
const MIDDLE: f32 = 0.37;

/// Bits of a coordinate in a [`Lattice::key`].
const BITS: u32 = 21;

/// Greatest coordinate of a cell, counted from the middle in either direction.
const FARTHEST: f32 = (1 << (BITS - 1)) as f32 - 2.0;

/// Cubes of one size that fill space. They are laid around the middle of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// A corner of the cell with the coordinates (0, 0, 0), in the unit of the scene.
    pub origin: Vec3,
    /// Width of a cell, above 0, in the unit of the scene.
    pub cell: f32,
}

impl Lattice {
    /// Lays cubes of width `cell` around the middle of `bounds`, which are the lowest and the
    /// highest corner of the model.
    ///
    /// # Errors
    /// If the width is not above 0, or so small that the coordinates of cells have no room.
    pub fn around([low, high]: [Vec3; 2], cell: f32) -> Result<Self, WettingError> {
        if !(cell.is_finite() && cell > 0.0) {
            return Err(WettingError::CellSize(cell));
        }
        let half = (high - low).max_element() / 2.0;
        if half / cell > FARTHEST {
            return Err(WettingError::TooManyCells { cell, fits: rounded_up(half / FARTHEST) });
        }
        let origin = low + (high - low) / 2.0 - Vec3::splat(MIDDLE * cell);
        Ok(Self { origin, cell })
    }

    /// Coordinates of the cell that holds `place`.
    #[must_use]
    pub fn coordinates(&self, place: Vec3) -> [i32; 3] {
        ((place - self.origin) / self.cell).floor().to_array().map(|value| value as i32)
    }

    /// Lowest corner of the cell with these coordinates.
    #[must_use]
    pub fn corner(&self, at: [i32; 3]) -> Vec3 {
        self.origin + Vec3::from(at.map(|value| value as f32)) * self.cell
    }

    /// A number of the cell with these coordinates. It is unique within the reach of the lattice.
    #[must_use]
    pub fn key([x, y, z]: [i32; 3]) -> u64 {
        fn bits(value: i32) -> u64 {
            u64::from(value.wrapping_add(1 << (BITS - 1)) as u32)
        }
        (bits(z) << (2 * BITS)) | (bits(y) << BITS) | bits(x)
    }

    /// Coordinates of the cell with this [`Lattice::key`].
    #[must_use]
    pub fn coordinates_of(key: u64) -> [i32; 3] {
        [0, BITS, 2 * BITS]
            .map(|shift: u32| ((key >> shift) & ((1 << BITS) - 1)) as i32 - (1 << (BITS - 1)))
    }
}

/// Rounds `value` up to a number with three digits.
pub(super) fn rounded_up(value: f32) -> f32 {
    let value = f64::from(value);
    let unit = 10_f64.powi(value.log10().floor() as i32 - 2);
    // We go through the text of the decimal number. A quotient of powers of ten would show its
    // rounding.
    let digits = (value / unit).ceil();
    format!("{:.2e}", digits * unit).parse().unwrap_or(value as f32)
}

/// A grid has at most this many cells.
pub const MOST_CELLS: usize = 1 << 20;

/// A surface or a size of cells for which there is no grid.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum WettingError {
    /// The mesh is damaged.
    #[error(transparent)]
    #[fault(Input)]
    Mesh(#[from] MeshFault),
    /// No triangle has an area, or the model is too large for its areas to be numbers.
    #[error("the model has {0} triangles, but no area that paint could lie on")]
    #[hint("export the model with its faces, at its real size")]
    #[fault(Input)]
    NoArea(usize),
    /// The cells have no size.
    #[error("cells of the grid are `{0}` wide")]
    #[hint(verbatim, "grid.cell is a share above 0")]
    CellSize(f32),
    /// The grid would have too many cells.
    #[error("cells of {cell} are too small for this model: the grid has at most {MOST_CELLS}")]
    #[hint(verbatim, "cells of {fits} would fit")]
    TooManyCells {
        /// Width of a cell, in the unit of the scene.
        cell: f32,
        /// Width of cells that are few enough, in the unit of the scene.
        fits: f32,
    },
    /// A cell would have no samples, or all cells together too many.
    #[error("cells of the grid have `{found}` samples each")]
    #[hint(verbatim, "grid.samples is 1 to {fits}")]
    TooManySamples {
        /// Samples in a cell.
        found: usize,
        /// Samples in a cell that are few enough for this model.
        fits: usize,
    },
    /// The rate or the slope of spilling is out of its range.
    #[error("the {what} of spilling cannot be `{found}`")]
    #[hint(if *what == "rate", verbatim, "grid.rate is 0 to 0.067")]
    #[hint(verbatim, "grid.slope is 0 to 1000")]
    Spilling {
        /// Name of the setting.
        what: &'static str,
        /// Its value.
        found: f32,
    },
}

/// Distance from a wall between cells, as a share of a cell, within which an edge touches both.
const TOUCH: f64 = 1e-4;

/// The cells that the triangle between three places enters, in a fixed order. You give places in
/// widths of a cell from the origin of the lattice. If a triangle lies on a wall, it enters the
/// cell above.
pub(super) fn entered(corners: [DVec3; 3], found: &mut Vec<[i32; 3]>) {
    let [a, b, c] = corners;
    fn cell(at: DVec3) -> [i32; 3] {
        at.floor().to_array().map(|value| value as i32)
    }
    let low = cell(a.min(b).min(c));
    let high = cell(a.max(b).max(c));
    if low == high {
        found.push(low);
    } else {
        within(&corners, low, high.map(|value| value + 1), found);
    }
}

fn within(corners: &[DVec3; 3], low: [i32; 3], high: [i32; 3], found: &mut Vec<[i32; 3]>) {
    let size = [0, 1, 2].map(|axis| high[axis] - low[axis]);
    let axis = (0..3).fold(0, |most, axis| if size[axis] > size[most] { axis } else { most });
    let [from, to] = [low, high].map(|at| DVec3::from(at.map(f64::from)));
    if size[axis] == 1 {
        // The lower walls belong to the cell. We add a little, because places near them are
        // rounded.
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

pub(super) fn touches([a, b]: [DVec3; 2], cell: [i32; 3]) -> bool {
    let low = DVec3::from(cell.map(f64::from));
    let margin = DVec3::splat(TOUCH);
    meets(&[a, b, b], low - margin, low + DVec3::ONE + margin)
}

pub(super) fn in_cells(lattice: &Lattice, place: [f32; 3]) -> DVec3 {
    (Vec3::from(place) - lattice.origin).as_dvec3() / f64::from(lattice.cell)
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
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn keys_give_their_cells_back() {
        for at in [[0, 0, 0], [-1, 2, -3], [1_000_000, -1_000_000, 7]] {
            assert_eq!(Lattice::coordinates_of(Lattice::key(at)), at);
        }
    }

    #[test]
    fn a_place_lies_in_its_cell() {
        let lattice = Lattice::around([Vec3::splat(-3.0), Vec3::splat(5.0)], 0.7).unwrap();
        for place in [[-3.0, 5.0, 1.0], [0.1, 0.2, 0.3]].map(Vec3::from) {
            let within = place - lattice.corner(lattice.coordinates(place));
            assert!(within.min_element() >= -1e-6 && within.max_element() < 0.7 + 1e-6);
        }
    }

    #[test]
    fn cells_without_size_or_room_are_refused() {
        let bounds = [Vec3::ZERO, Vec3::ONE];
        for cell in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(matches!(Lattice::around(bounds, cell), Err(WettingError::CellSize(..))));
        }
        let Err(WettingError::TooManyCells { fits, .. }) = Lattice::around(bounds, 1e-9) else {
            panic!("cells of 1e-9 fit");
        };
        assert!(Lattice::around(bounds, fits).is_ok());
        assert_eq!(rounded_up(0.123_41), 0.124);
    }

    #[test]
    fn the_cells_of_every_point_of_a_triangle_are_entered_and_no_others() {
        let random = &mut ChaCha8Rng::seed_from_u64(1);
        for _ in 0..50 {
            let corners =
                [(); 3].map(|()| DVec3::from([(); 3].map(|()| random.random_range(-3.0_f64..3.0))));
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
            // The triangle has less than a corner between two points in these cells.
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
