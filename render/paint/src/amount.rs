//! Amounts of paint, in whole quanta.
//!
//! A column of paint over one cell is counted in quanta of height; 2^21 of them
//! are as high as the cell is wide (at 0.1 mm a quantum is 0.05 nm). Whole
//! numbers are only ever moved, so that every pigment's total stays exactly;
//! and their sums do not depend on order, so that threads, backends and
//! machines agree bit for bit.

/// How many quanta high a column is that is as high as its cell is wide.
pub const QUANTA_PER_CELL: u32 = 1 << 21;

/// The most that a cell may hold: 512 cell widths of height.
pub const FULL: u32 = 1 << 30;

/// `amount * share / 256`, rounded down, for a `share` of 0 to 256; the
/// product would not fit 32 bits, and shaders have no more.
#[inline(always)]
#[must_use]
pub const fn share_of_256(amount: u32, share: u32) -> u32 {
    (amount >> 8) * share + (((amount & 0xff) * share) >> 8)
}

/// `amount * share / 65536`, rounded down, for a `share` of 0 to 65536.
#[inline(always)]
#[must_use]
pub const fn share_of_65536(amount: u32, share: u32) -> u32 {
    (amount >> 16) * share + (((amount & 0xffff) * share) >> 16)
}

/// The quanta of a height of `height_mm` over cells of `cell_mm`, to the nearest.
///
/// Heights beyond [`FULL`] are cut there, those below 0 count as 0.
#[must_use]
pub fn quanta_from_mm(height_mm: f64, cell_mm: f64) -> u32 {
    let quanta = height_mm / cell_mm * f64::from(QUANTA_PER_CELL);
    quanta.round().clamp(0.0, f64::from(FULL)) as u32
}

/// The height in mm of `quanta` over cells of `cell_mm`.
#[must_use]
pub fn mm_from_quanta(quanta: u32, cell_mm: f64) -> f64 {
    f64::from(quanta) / f64::from(QUANTA_PER_CELL) * cell_mm
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_those_of_wide_arithmetic() {
        for amount in [0, 1, 255, 256, 65535, 65536, 123_456_789, FULL, u32::MAX] {
            for share in [0_u32, 1, 77, 255, 256] {
                let wide = (u64::from(amount) * u64::from(share) / 256) as u32;
                assert_eq!(share_of_256(amount, share), wide, "{amount} {share}");
            }
            for share in [0_u32, 1, 257, 65535, 65536] {
                let wide = (u64::from(amount) * u64::from(share) / 65536) as u32;
                assert_eq!(share_of_65536(amount, share), wide, "{amount} {share}");
            }
        }
    }

    #[test]
    fn millimetres_come_back() {
        for mm in [0.0, 0.001, 0.1, 7.5] {
            let back = mm_from_quanta(quanta_from_mm(mm, 0.1), 0.1);
            assert!((back - mm).abs() < 1e-7, "{mm}: {back}");
        }
        assert_eq!(quanta_from_mm(-1.0, 0.1), 0);
        assert_eq!(quanta_from_mm(1e9, 0.1), FULL);
    }
}
