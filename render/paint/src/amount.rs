//! Amounts of paint in whole quanta of height.
//!
//! We measure the column of paint over a cell in quanta. 2^21 quanta are as high as a cell is wide,
//! so with cells of 0.1 mm, for example, a quantum is 0.05 nm. We only move quanta and never create
//! or lose them, so every pigment's total is exact. Sums of integers do not depend on their order,
//! so threads, backends and machines agree bit for bit.

/// Height in quanta of a column as high as its cell is wide.
pub const QUANTA_PER_CELL: u32 = 1 << 21;

/// Maximum height in quanta of the column over a cell: 512 cell widths.
pub const MAX_COLUMN: u32 = 1 << 30;

/// Computes `amount * share / 256`, rounded down, for a `share` of 0 to 256. This splits `amount`,
/// because the whole product may exceed the 32 bits of integers in shaders.
#[inline(always)]
#[must_use]
pub const fn share_of_256(amount: u32, share: u32) -> u32 {
    (amount >> 8) * share + (((amount & 0xff) * share) >> 8)
}

/// Computes `amount * share / 65536`, rounded down, for a `share` of 0 to 65536.
#[inline(always)]
#[must_use]
pub const fn share_of_65536(amount: u32, share: u32) -> u32 {
    (amount >> 16) * share + (((amount & 0xffff) * share) >> 16)
}

/// Computes `part / whole` in parts of 65536, for a `part` up to `whole` and a `whole` up to
/// [`MAX_COLUMN`]. The result never exceeds the exact ratio, and is less by at most 1/32768 of it
/// plus 1. If `whole` is 0, you get 0.
#[inline(always)]
#[must_use]
pub fn ratio_of_65536(part: u32, whole: u32) -> u32 {
    /// Mask of the exponent bits of an f64. For a number from 2^e to 2^(e + 1), `SHIFTED` minus
    /// these bits gives the bits of 2^(15 - e).
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    const SHIFTED: u64 = (15 + 2 * 1023) << 52;
    // In the shaders, the product of `part` and 65536 must fit into 32 bits, so both numbers lose
    // the bits that `part` has above 16. Some vectors shift each lane by its own number slowly, so
    // we divide by the power of two, which is exact.
    let size = f64::from((part | 1) as i32).to_bits() & EXPONENT;
    let power = f64::from_bits(SHIFTED - size);
    let (scale, more) = if power < 1.0 { (power, 1.0) } else { (1.0, 0.0) };
    let part = (f64::from(part as i32) * scale).floor();
    let whole = (f64::from(whole as i32) * scale).floor() + more;
    floor_of_quotient(part * 65536.0, whole)
}

/// Computes `amount / count`, rounded down, for an `amount` up to [`MAX_COLUMN`] and a `count` of
/// 1 or more.
#[inline(always)]
#[must_use]
pub fn quotient(amount: u32, count: u32) -> u32 {
    floor_of_quotient(f64::from(amount as i32), f64::from(count as i32))
}

/// Computes `part / whole`, rounded down, for whole numbers. Processors cannot divide vectors of
/// whole numbers, so we divide in f64, which is exact here.
#[inline(always)]
fn floor_of_quotient(part: f64, whole: f64) -> u32 {
    /// 2^52: above this number, neighbouring f64 values are 1 apart. Adding it is faster than the
    /// range checks of `as`.
    const UNIT: f64 = 4_503_599_627_370_496.0;
    let whole = if whole > 1.0 { whole } else { 1.0 };
    ((part / whole).floor() + UNIT).to_bits() as u32
}

/// Converts a height in mm to quanta, rounded to the nearest and clamped to 0 to [`MAX_COLUMN`].
/// `cell_mm` is the width of a cell in mm.
#[must_use]
pub fn quanta_from_mm(height_mm: f64, cell_mm: f64) -> u32 {
    let quanta = height_mm / cell_mm * f64::from(QUANTA_PER_CELL);
    quanta.round().clamp(0.0, f64::from(MAX_COLUMN)) as u32
}

/// Converts a height in quanta to mm. `cell_mm` is the width of a cell in mm.
#[must_use]
pub fn mm_from_quanta(quanta: u32, cell_mm: f64) -> f64 {
    f64::from(quanta) / f64::from(QUANTA_PER_CELL) * cell_mm
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn shares_agree_with_64_bit_arithmetic() {
        for amount in [0, 1, 255, 256, 65535, 65536, 123_456_789, MAX_COLUMN, u32::MAX] {
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
    fn ratios_are_near_the_exact_ones_and_never_above() {
        for whole in [1, 2, 77, 65535, 65536, 65537, 99_999_999, MAX_COLUMN] {
            for share in [0, 1, 1000, 32768, 65536_u64] {
                let part = u64::from(whole) * share / 65536;
                let exact = part as f64 / f64::from(whole) * 65536.0;
                let found = f64::from(ratio_of_65536(part as u32, whole));
                let least = exact * (1.0 - 1.0 / 32768.0) - 1.0;
                assert!((least..=exact).contains(&found), "{part} of {whole}: {found}");
            }
        }
        assert_eq!(ratio_of_65536(0, 0), 0);
    }

    #[test]
    fn quotients_and_ratios_agree_with_whole_numbers() {
        /// Divides as the shaders do.
        fn ratio(part: u32, whole: u32) -> u32 {
            let excess = 16_u32.saturating_sub(part.leading_zeros());
            ((part >> excess) << 16) / ((whole >> excess) + u32::from(excess > 0))
        }
        let random = &mut ChaCha8Rng::seed_from_u64(1);
        for _ in 0..200_000 {
            let [a, b]: [u32; 2] = std::array::from_fn(|_| {
                let most = MAX_COLUMN >> random.random_range(0..30);
                random.random_range(1..=most)
            });
            for amount in [a, a / b * b, (a / b * b).saturating_sub(1)] {
                assert_eq!(quotient(amount, b), amount / b, "{amount} / {b}");
                let part = amount.min(b);
                assert_eq!(ratio_of_65536(part, b), ratio(part, b), "{part} of {b}");
            }
            assert_eq!(ratio_of_65536(b, b), ratio(b, b), "{b} of {b}");
        }
    }

    #[test]
    fn millimetres_survive_conversion_to_quanta() {
        for mm in [0.0, 0.001, 0.1, 7.5] {
            let back = mm_from_quanta(quanta_from_mm(mm, 0.1), 0.1);
            assert!((back - mm).abs() < 1e-7, "{mm}: {back}");
        }
        assert_eq!(quanta_from_mm(-1.0, 0.1), 0);
        assert_eq!(quanta_from_mm(1e9, 0.1), MAX_COLUMN);
    }
}
