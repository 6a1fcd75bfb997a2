//! Cubes of one size that fill space, and their numbers.

use glam::Vec3;

use super::fault::WettingError;

/// Where the middle of the model lies in its cell, along each axis. Neither 0 nor 1/2, nor their
/// sums with round shares of a cell: faces of simple models then lie inside of cells, not on the
/// walls between them.
const MIDDLE: f32 = 0.37;

/// Bits of a coordinate in a [`Lattice::key`].
const BITS: u32 = 21;

/// Greatest coordinate of a cell on either side of the middle.
const FARTHEST: f32 = (1 << (BITS - 1)) as f32 - 2.0;

/// Cubes of one size that fill space, laid around the middle of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// A corner of the cell with the coordinates (0, 0, 0), in the unit of the scene.
    pub origin: Vec3,
    /// Width of a cell, above 0, in the unit of the scene.
    pub cell: f32,
}

impl Lattice {
    /// Cubes of width `cell` around the middle of `bounds`, the lowest and the highest corner of
    /// the model.
    ///
    /// # Errors
    /// If the width is not above 0, or so small that the coordinates of cells have no room.
    pub fn around([low, high]: [Vec3; 2], cell: f32) -> Result<Self, WettingError> {
        if !(cell.is_finite() && cell > 0.0) {
            return Err(WettingError::CellSize { found: cell });
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

    /// A number of the cell with these coordinates, unique within the reach of the lattice.
    #[must_use]
    pub fn key([x, y, z]: [i32; 3]) -> u64 {
        let bits = |value: i32| u64::from(value.wrapping_add(1 << (BITS - 1)) as u32);
        (bits(z) << (2 * BITS)) | (bits(y) << BITS) | bits(x)
    }

    /// Coordinates of the cell with this [`Lattice::key`].
    #[must_use]
    pub fn coordinates_of(key: u64) -> [i32; 3] {
        let value = |shift: u32| ((key >> shift) & ((1 << BITS) - 1)) as i32 - (1 << (BITS - 1));
        [value(0), value(BITS), value(2 * BITS)]
    }
}

/// The number with three digits that is `value` or the next above.
pub(super) fn rounded_up(value: f32) -> f32 {
    let value = f64::from(value);
    let unit = 10_f64.powi(value.log10().floor() as i32 - 2);
    // Text of the decimal number: a quotient of powers of ten would show its rounding.
    let digits = (value / unit).ceil();
    format!("{:.2e}", digits * unit).parse().unwrap_or(value as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

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
            assert!(matches!(Lattice::around(bounds, cell), Err(WettingError::CellSize { .. })));
        }
        let Err(WettingError::TooManyCells { fits, .. }) = Lattice::around(bounds, 1e-9) else {
            panic!("cells of 1e-9 fit");
        };
        assert!(Lattice::around(bounds, fits).is_ok());
        assert_eq!(rounded_up(0.123_41), 0.124);
    }
}
