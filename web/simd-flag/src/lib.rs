//! Which vector instructions of WebAssembly the crate `pulp` uses.
//!
//! `exr` turns on `pulp`'s use of relaxed SIMD, whose results differ between machines. Here the answer is
//! that it is never used. The instructions are
//! still in the module, because `pulp` keeps the answer in memory: a browser without them
//! refuses to load it.

/// Does nothing: the module is compiled with these instructions.
pub fn enable_simd128() {}

/// Does nothing: the module is compiled with these instructions.
pub fn disable_simd128() {}

/// Whether 128-bit vectors are used: where the module is compiled with them.
#[must_use]
#[inline(always)]
pub const fn is_simd128_enabled() -> bool {
    cfg!(target_feature = "simd128")
}

/// Does nothing: relaxed SIMD is never used.
pub fn enable_relaxed_simd() {}

/// Does nothing: relaxed SIMD is never used.
pub fn disable_relaxed_simd() {}

/// Whether relaxed SIMD is used: never.
#[must_use]
#[inline(always)]
pub const fn is_relaxed_simd_enabled() -> bool {
    false
}
