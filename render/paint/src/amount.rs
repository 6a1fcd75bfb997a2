//! Amounts of paint in whole quanta of height.
//!
//! We measure the column of paint over a cell in quanta. 2^21 quanta are as high as a cell is wide,
//! so with cells of 0.1 mm, for example, a quantum is 0.05 nm. We only move quanta and never create
//! or lose them, so every pigment's total is exact. Sums of integers do not depend on their order,
//! so threads, backends and machines agree bit for bit.
//!
//! Moving paint spends most of its time in the arithmetic on the amounts of the eight pigments of a
//! cell. For WebAssembly the compiler does not make vectors of loops over so few numbers, so we
//! write them out.

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

/// Number of pigments that a cell can hold.
pub(crate) const PIGMENTS: usize = 8;

/// Amount of each pigment's paint in quanta.
pub(crate) type Amounts = [u32; PIGMENTS];

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
pub(crate) use loops::{difference, share, sum, total, wrapping_difference, wrapping_sum};

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub(crate) use vectors::{difference, share, sum, total, wrapping_difference, wrapping_sum};

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
mod loops {
    use super::{Amounts, PIGMENTS, share_of_65536};

    /// `share / 65536` of each amount, rounded down, for a `share` of 0 to 65536.
    #[inline(always)]
    pub(crate) fn share(amounts: &Amounts, share: u32) -> Amounts {
        each(
            amounts,
            amounts,
            #[inline(always)]
            |amount, _| share_of_65536(amount, share),
        )
    }

    /// Sums, none of which exceeds 32 bits.
    #[inline(always)]
    pub(crate) fn sum(a: &Amounts, b: &Amounts) -> Amounts {
        each(
            a,
            b,
            #[inline(always)]
            |a, b| a + b,
        )
    }

    /// Differences `a - b`, none of which is negative.
    #[inline(always)]
    pub(crate) fn difference(a: &Amounts, b: &Amounts) -> Amounts {
        each(
            a,
            b,
            #[inline(always)]
            |a, b| a - b,
        )
    }

    /// Sums modulo 2^32.
    #[inline(always)]
    pub(crate) fn wrapping_sum(a: &Amounts, b: &Amounts) -> Amounts {
        each(
            a,
            b,
            #[inline(always)]
            |a, b| a.wrapping_add(b),
        )
    }

    /// Differences `a - b` modulo 2^32.
    #[inline(always)]
    pub(crate) fn wrapping_difference(a: &Amounts, b: &Amounts) -> Amounts {
        each(
            a,
            b,
            #[inline(always)]
            |a, b| a.wrapping_sub(b),
        )
    }

    #[inline(always)]
    pub(crate) fn total(amounts: &Amounts) -> u32 {
        let mut total = 0;
        for amount in amounts {
            total += amount;
        }
        total
    }

    /// Applies `act` to each pair of amounts. We write this as a loop: the compiler does not always
    /// inline the closures of `map` and `from_fn`, and then does not compile them for the
    /// instruction set that you chose.
    #[inline(always)]
    fn each(a: &Amounts, b: &Amounts, act: impl Fn(u32, u32) -> u32) -> Amounts {
        let mut found = *a;
        let mut i = 0;
        while i < PIGMENTS {
            found[i] = act(a[i], b[i]);
            i += 1;
        }
        found
    }
}

/// Vectors do not check that sums fit into 32 bits. In the tests, loops that do check this move the
/// paint.
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod vectors {
    use std::arch::wasm32::{
        i32x4_add, i32x4_mul, i32x4_sub, u32x4_extract_lane, u32x4_shr, u32x4_splat, v128, v128_and,
    };

    use super::Amounts;

    pub(crate) use wrapping_difference as difference;
    pub(crate) use wrapping_sum as sum;

    #[inline(always)]
    pub(crate) fn share(amounts: &Amounts, share: u32) -> Amounts {
        let [first, second]: [v128; 2] = bytemuck::cast(*amounts);
        let share = u32x4_splat(share);
        bytemuck::cast([share_of_four(first, share), share_of_four(second, share)])
    }

    #[inline(always)]
    fn share_of_four(amounts: v128, share: v128) -> v128 {
        let low = v128_and(amounts, u32x4_splat(0xffff));
        let low = u32x4_shr(i32x4_mul(low, share), 16);
        i32x4_add(i32x4_mul(u32x4_shr(amounts, 16), share), low)
    }

    #[inline(always)]
    pub(crate) fn wrapping_sum(a: &Amounts, b: &Amounts) -> Amounts {
        let (a, b): ([v128; 2], [v128; 2]) = (bytemuck::cast(*a), bytemuck::cast(*b));
        bytemuck::cast([i32x4_add(a[0], b[0]), i32x4_add(a[1], b[1])])
    }

    #[inline(always)]
    pub(crate) fn wrapping_difference(a: &Amounts, b: &Amounts) -> Amounts {
        let (a, b): ([v128; 2], [v128; 2]) = (bytemuck::cast(*a), bytemuck::cast(*b));
        bytemuck::cast([i32x4_sub(a[0], b[0]), i32x4_sub(a[1], b[1])])
    }

    #[inline(always)]
    pub(crate) fn total(amounts: &Amounts) -> u32 {
        let [first, second]: [v128; 2] = bytemuck::cast(*amounts);
        let sums = i32x4_add(first, second);
        let upper = u32x4_extract_lane::<0>(sums) + u32x4_extract_lane::<1>(sums);
        upper + u32x4_extract_lane::<2>(sums) + u32x4_extract_lane::<3>(sums)
    }
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
