//! From swatches of paint to a calibrated pigment library.
//!
//! In scope: reading measurements of mixtures, K/S of films that hide or not,
//! fitting each pigment's K and S, what the data cannot tell, validation, the
//! library file and what one does with several, mixing forward, quadrature in
//! wavelength, and recipes for a colour. Out of scope: charts, and anything with
//! a brush.
//!
//! Files stand in an order of dependence; each uses only what stands above it.

pub mod measurement;

pub mod swatch;

pub mod observation;

pub mod digits;

pub mod evaluate;

pub mod mixture;

mod least_squares;

pub mod smooth_reflectance;

pub mod fit;

pub mod library;

pub mod curation;

mod scores;

mod findings;

pub mod calibration;

pub mod absolute;

pub mod validation;

pub mod comparison;

pub mod plan;

pub mod quadrature;

pub mod palette;

pub mod matching;

pub mod synthetic;
