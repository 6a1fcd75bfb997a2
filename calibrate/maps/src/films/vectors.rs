//! Arithmetic on eight numbers at once by the widest vectors of the processor.
//!
//! Nothing is fused, and each operation rounds like that on single numbers, so that all processors
//! give the same bits.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Sub};

use wide::f32x8;

/// Arithmetic that is inlined as a whole, so that it is compiled for each kind of processor.
pub(crate) trait Task {
    type Result;

    /// Does it; always inlined.
    fn run<V: Vectors>(self, vectors: V) -> Self::Result;
}

/// Vectors of a kind of processor: a proof that this one has them.
pub(crate) trait Vectors: Copy {
    type Eight: Eight;

    /// Eight times `value`.
    fn splat(self, value: f32) -> Self::Eight;

    /// Numbers from memory.
    fn load(self, numbers: f32x8) -> Self::Eight;
}

/// Eight numbers in registers.
pub(crate) trait Eight:
    Copy + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn sqrt(self) -> Self;

    /// The greater of each two numbers; the result for NaN depends on the processor.
    fn greater(self, other: Self) -> Self;

    /// Bits of the numbers that are greater than those of `other`; the lowest bit is the first number.
    fn is_above(self, other: Self) -> u32;

    /// The numbers for memory.
    fn store(self) -> f32x8;
}

/// Runs `task` with the vectors of this processor.
#[inline(always)]
pub(crate) fn by_vectors<T: Task>(task: T) -> T::Result {
    #[cfg(target_arch = "x86_64")]
    if let Some(vectors) = pulp::x86::V3::try_new() {
        return vectors.vectorize(avx2::Dispatched { task, vectors });
    }
    task.run(Halves)
}

/// Two vectors of four numbers, or single numbers on a processor without vectors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Halves;

impl Vectors for Halves {
    type Eight = f32x8;

    #[inline(always)]
    fn splat(self, value: f32) -> f32x8 {
        f32x8::splat(value)
    }

    #[inline(always)]
    fn load(self, numbers: f32x8) -> f32x8 {
        numbers
    }
}

impl Eight for f32x8 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        f32x8::sqrt(self)
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        self.fast_max(other)
    }

    #[inline(always)]
    fn is_above(self, other: Self) -> u32 {
        self.simd_gt(other).to_bitmask()
    }

    #[inline(always)]
    fn store(self) -> f32x8 {
        self
    }
}

/// Vectors of 256 bits. Without them the crate `wide` computes two halves also within code that is compiled for
/// AVX2, in nearly twice the time.
#[cfg(target_arch = "x86_64")]
mod avx2 {
    use std::arch::x86_64::__m256;
    use std::ops::{Add, Div, Mul, Sub};

    use pulp::x86::V3;
    use wide::f32x8;

    use super::{Eight, Task, Vectors};

    pub(super) struct Dispatched<T> {
        pub(super) task: T,
        pub(super) vectors: V3,
    }

    impl<T: Task> pulp::NullaryFnOnce for Dispatched<T> {
        type Output = T::Result;

        #[inline(always)]
        fn call(self) -> T::Result {
            self.task.run(self.vectors)
        }
    }

    /// Eight numbers, with the proof that the processor has vectors for them.
    #[derive(Debug, Clone, Copy)]
    pub(crate) struct Numbers {
        vectors: V3,
        lanes: __m256,
    }

    impl Vectors for V3 {
        type Eight = Numbers;

        #[inline(always)]
        fn splat(self, value: f32) -> Numbers {
            Numbers { vectors: self, lanes: self.avx._mm256_set1_ps(value) }
        }

        #[inline(always)]
        fn load(self, numbers: f32x8) -> Numbers {
            Numbers { vectors: self, lanes: pulp::cast(numbers) }
        }
    }

    impl Numbers {
        #[inline(always)]
        fn with(self, lanes: __m256) -> Self {
            Self { lanes, ..self }
        }
    }

    impl Add for Numbers {
        type Output = Self;

        #[inline(always)]
        fn add(self, other: Self) -> Self {
            self.with(self.vectors.avx._mm256_add_ps(self.lanes, other.lanes))
        }
    }

    impl Sub for Numbers {
        type Output = Self;

        #[inline(always)]
        fn sub(self, other: Self) -> Self {
            self.with(self.vectors.avx._mm256_sub_ps(self.lanes, other.lanes))
        }
    }

    impl Mul for Numbers {
        type Output = Self;

        #[inline(always)]
        fn mul(self, other: Self) -> Self {
            self.with(self.vectors.avx._mm256_mul_ps(self.lanes, other.lanes))
        }
    }

    impl Div for Numbers {
        type Output = Self;

        #[inline(always)]
        fn div(self, other: Self) -> Self {
            self.with(self.vectors.avx._mm256_div_ps(self.lanes, other.lanes))
        }
    }

    impl Eight for Numbers {
        #[inline(always)]
        fn sqrt(self) -> Self {
            self.with(self.vectors.avx._mm256_sqrt_ps(self.lanes))
        }

        #[inline(always)]
        fn greater(self, other: Self) -> Self {
            self.with(self.vectors.avx._mm256_max_ps(self.lanes, other.lanes))
        }

        #[inline(always)]
        fn is_above(self, other: Self) -> u32 {
            let avx = self.vectors.avx;
            let above =
                avx._mm256_cmp_ps::<{ std::arch::x86_64::_CMP_GT_OQ }>(self.lanes, other.lanes);
            avx._mm256_movemask_ps(above) as u32
        }

        #[inline(always)]
        fn store(self) -> f32x8 {
            pulp::cast(self.lanes)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All operations on eight numbers, and the bits of those above.
    struct All([f32x8; 2]);

    impl Task for All {
        type Result = ([[f32; 8]; 6], u32);

        fn run<V: Vectors>(self, v: V) -> Self::Result {
            let [a, b] = self.0.map(|numbers| v.load(numbers));
            let found = [a + b, a - b, a * v.splat(3.7) * b, a / b, a.sqrt(), a.greater(b)];
            (found.map(|numbers| numbers.store().to_array()), a.is_above(b))
        }
    }

    #[test]
    fn all_vectors_round_as_single_numbers_do() {
        for row in 0..50 {
            let number = |lane: usize, factor: f32| {
                let wave = (factor * (8 * row + lane) as f32).sin();
                wave * wave * 10f32.powi((row as i32 + lane as i32) % 30 - 15)
            };
            let a: [f32; 8] = std::array::from_fn(|lane| number(lane, 1.3));
            let mut b: [f32; 8] = std::array::from_fn(|lane| number(lane, 0.7));
            b[row % 8] = a[row % 8];
            let both = || All([f32x8::new(a), f32x8::new(b)]);
            let single: [[f32; 6]; 8] = std::array::from_fn(|i| {
                let a = a[i];
                let b = b[i];
                [a + b, a - b, a * 3.7 * b, a / b, a.sqrt(), if a > b { a } else { b }]
            });
            let above = (0..8).fold(0, |bits, i| bits | u32::from(a[i] > b[i]) << i);
            for (found, bits) in [by_vectors(both()), both().run(Halves)] {
                assert_eq!(bits, above, "{a:?} {b:?}");
                for (operation, numbers) in found.iter().enumerate() {
                    for (lane, number) in numbers.iter().enumerate() {
                        let expected = single[lane][operation];
                        assert_eq!(
                            number.to_bits(),
                            expected.to_bits(),
                            "{operation}: {a:?} {b:?}"
                        );
                    }
                }
            }
        }
    }
}
