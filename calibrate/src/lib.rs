//! From swatches of paint to a calibrated pigment library.
//!
//! In scope: reading measurements of mixtures, K/S of films that hide or not,
//! fitting each pigment's K and S, what the data cannot tell, validation, and plans
//! of what to measure. What one does with a library once there is one stands in
//! the crate `pigment`, whose modules are here too.
//!
//! Files stand in an order of dependence; each uses only what stands above it.

pub use pigment::{
    Appearance, Backing, BackingError, ColorError, Curves, FilmOver, MixtureColor, PigmentId,
    PigmentLibrary, Recipe, Viewing, curation, curves, digits, evaluate, library, matching,
    palette, quadrature, recipe, remark, smooth_reflectance, visible_band,
};

pub mod measurement;

pub mod swatch;

pub mod observation;

pub mod fit;

mod scores;

mod findings;

pub mod calibration;

pub mod absolute;

pub mod validation;

pub mod comparison;

mod cards;

pub mod plan;

pub use plan::plan;

pub mod synthetic;
