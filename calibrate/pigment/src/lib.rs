//! The pigment library, and what one does with it.
//!
//! In scope: the library's file, mixtures of its pigments and their reflectance,
//! colour errors, quadrature in wavelength, recipes for a colour, what a palette can
//! do, and keeping libraries. Out of scope: measuring and fitting (crate
//! `calibrate`), instruments' files, and anything with a brush.
//!
//! Files stand in an order of dependence; each uses only what stands above it.

pub mod digits;

pub mod evaluate;

pub mod mixture;

mod least_squares;

pub mod smooth_reflectance;

pub mod fit_settings;

pub mod library;

pub mod curation;

pub mod quadrature;

pub mod palette;

pub mod matching;
