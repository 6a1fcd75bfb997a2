//! Arithmetic on the amounts of the eight pigments of a cell.
//!
//! Moving paint spends most of its time here. For WebAssembly the compiler does not make vectors of
//! loops over so few numbers, so we write them out.

/// Number of pigments that a cell can hold.
pub(crate) const COUNT: usize = 8;

/// Amount of each pigment's paint in quanta.
pub(crate) type Amounts = [u32; COUNT];

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
pub(crate) use loops::{difference, share, sum, total, wrapping_difference, wrapping_sum};

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub(crate) use vectors::{difference, share, sum, total, wrapping_difference, wrapping_sum};

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
mod loops {
    use super::{Amounts, COUNT};
    use crate::amount::share_of_65536;

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
        while i < COUNT {
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
