//! Arithmetic in f32 that the compiler vectorises.
//!
//! [`vectorized`] runs work with the widest vector instructions of the machine. You call the other
//! functions from such work, into which they are inlined. The type parameter `S` stands for the
//! instructions.

use pulp::{Simd, WithSimd};

/// Runs `work`, compiled with the widest vector instructions that this machine has.
#[cfg(not(target_arch = "wasm32"))]
#[inline(always)]
pub fn vectorized<W: WithSimd>(work: W) -> W::Output {
    pulp::Arch::new().dispatch(work)
}

/// Runs `work`, compiled with vectors of 128 bits if you compile the module with them.
///
/// [`pulp::Arch`] would add a version with relaxed instructions. We do not want this: their
/// results differ between machines, and engines without them refuse the module. One function with
/// them also lets the compiler use them in the whole module.
#[cfg(target_arch = "wasm32")]
#[inline(always)]
pub fn vectorized<W: WithSimd>(work: W) -> W::Output {
    match pulp::wasm::Simd128::try_new() {
        Some(vectors) => Simd::vectorize(vectors, work),
        None => Simd::vectorize(pulp::Scalar::new(), work),
    }
}

/// Name of the vector instructions that [`vectorized`] uses. `None` on a machine without them.
#[must_use]
pub fn vector_instructions() -> Option<&'static str> {
    if cfg!(target_arch = "wasm32") {
        cfg!(target_feature = "simd128").then_some("SIMD128")
    } else {
        (!matches!(pulp::Arch::new(), pulp::Arch::Scalar)).then_some("AVX2")
    }
}

/// `a * b + c`. If `S` has vectors, this is one fused instruction that rounds once. Otherwise, and
/// in WebAssembly, this takes two operations, because a fused one would be a slow library call.
#[inline(always)]
pub fn multiply_add<S: Simd>(a: f32, b: f32, c: f32) -> f32 {
    let has_fused =
        cfg!(not(target_arch = "wasm32")) && const { size_of::<S::f32s>() > size_of::<f32>() };
    if has_fused { a.mul_add(b, c) } else { a * b + c }
}

/// The greater of two numbers, `b` if one is NaN. This is one instruction, unlike [`f32::max`].
#[inline(always)]
pub fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The lesser of two numbers, `b` if one is NaN.
#[inline(always)]
pub fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// Coefficients of a minimax polynomial for (2^r - 1) / r, r in -1/2..=1/2, by rising powers
/// of r. The relative error is 2.2e-8 with the coefficients in f32.
const EXP2_MINUS_1: [f32; 6] = [
    std::f32::consts::LN_2,
    0.240_226_5,
    0.055_503_574,
    0.009_618_238,
    0.001_339_073_6,
    0.000_154_035_12,
];

/// `(exp(-x), 1 - exp(-x))` for `x` of 0 and up. Where exp(-x) is above 1e-3, the relative errors
/// are below 5e-7 and 2e-7. Elsewhere the absolute errors are below 1e-7.
#[inline(always)]
pub fn decay<S: Simd>(x: f32) -> (f32, f32) {
    // exp(-x) = 2^n 2^r. Results below 2^-126 are negligible, so we end the exponent there.
    let exponent = greater(x * -std::f32::consts::LOG2_E, -126.0);
    // Adding 1.5 * 2^23 rounds to a whole number, which the low bits then hold.
    const ROUND: f32 = 12_582_912.0;
    let rounded = exponent + ROUND;
    let r = exponent - (rounded - ROUND);
    let power = f32::from_bits((rounded.to_bits() << 23).wrapping_add(1.0f32.to_bits()));
    let [first, rest @ ..] = EXP2_MINUS_1;
    let [c1, c2, c3, c4, c5] = rest;
    let p = multiply_add::<S>(c5, r, c4);
    let p = multiply_add::<S>(p, r, c3);
    let p = multiply_add::<S>(p, r, c2);
    let p = multiply_add::<S>(p, r, c1);
    let p = multiply_add::<S>(p, r, first);
    let above = p * r * power;
    (power + above, (1.0 - power) - above)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest errors of both results. They are relative where exp(-x) is above 1e-3. Elsewhere
    /// this gives twice the absolute error.
    fn errors<S: Simd>() -> [f64; 2] {
        let mut worst = [0.0f64; 2];
        for i in 0..=200_000 {
            // From 1e-8 to 1e6, evenly in the exponent.
            let x = 10f64.powf(f64::from(i) * 14.0 / 200_000.0 - 8.0) as f32;
            let (power, rest) = decay::<S>(x);
            let exact = (-f64::from(x)).exp();
            let unit = if exact > 1e-3 { [exact, -(-f64::from(x)).exp_m1()] } else { [0.5; 2] };
            let found = [f64::from(power) - exact, f64::from(rest) + (-f64::from(x)).exp_m1()];
            for i in 0..2 {
                worst[i] = worst[i].max((found[i] / unit[i]).abs());
            }
        }
        worst
    }

    #[test]
    fn decay_is_as_near_as_it_says() {
        let [scalar, fused] = [errors::<pulp::Scalar>(), errors::<pulp::Scalar256b>()];
        for [power, rest] in [scalar, fused] {
            assert!(power < 5e-7 && rest < 2e-7, "{scalar:?} {fused:?}");
        }
        let (power, rest) = decay::<pulp::Scalar>(0.0);
        assert_eq!((power, rest), (1.0, 0.0));
    }
}
