//! From measured swatches of paint to a calibrated pigment library.
//!
//! ```text
//! files: CSV, CGATS, CxF, .. --> Readings --> swatches --> K/S --> fit --> PigmentLibrary
//!        recipes (CSV) -----------^                               |
//!                                                                 +--> validate: errors of unseen mixtures
//! ```
//!
//! ```
//! # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../measurements/van-gogh-oils.csv");
//! use calibrate::fit::Method;
//! use calibrate::{FitOptions, Readings};
//!
//! let readings = Readings::open(path)?;
//! let options = FitOptions { method: Method::Weighted, ..FitOptions::default() };
//! let fit = calibrate::fit(&readings, &options)?;
//! println!("{}", fit.report().with_samples(10));
//! assert_eq!(fit.library.reference.as_deref(), Some("Zinc White"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | task | call |
//! |---|---|
//! | read measurements of any format | [`Readings::open`], [`Readings::with_recipes`] |
//! | fit a library | [`fit()`] |
//! | error of mixtures that the fit has not seen | [`validate`] |
//! | which swatches to paint | [`plan()`] |
//! | compare a library with measurements | [`comparison::Comparable`] |
//! | colours and recipes of a library | [`PigmentLibrary`], from the crate `pigment`, whose modules are here too |
//!
//! Modules are ordered by dependence: each uses only modules declared above it.

pub use pigment::{
    Appearance, Backing, BackingError, ColorError, Curves, FilmOver, IlluminantChange,
    MixtureColor, PigmentId, PigmentLibrary, Recipe, Remark, RemarkKind, Viewing, curation, curves,
    digits, evaluate, library, matching, palette, quadrature, recipe, remark, smooth_reflectance,
    visible_band,
};

pub mod measurement;
pub mod swatch;
mod reading_options;
mod readings_error;
pub mod readings;
pub mod observation;
mod surface_choice;
mod backings;
pub mod fit;
mod scores;
mod residuals_error;
mod residuals;
mod findings;
pub mod calibration;
pub mod absolute;
pub mod report;
mod fitting_error;
pub mod fitting;
mod refit;
pub mod validation;
pub mod leave_out;
mod told;
pub mod comparison;
mod cards;
pub mod plan;
pub mod synthetic;

pub use fitting::{FilmModel, Fit, FitOptions, PreparedFit, fit};
pub use fitting_error::FittingError;
pub use leave_out::{FitValidation, LeftOut, ValidationOptions, validate};
pub use plan::plan;
pub use readings::{ReadingFormat, ReadingOptions, Readings};
pub use readings_error::ReadingsError;
pub use report::ErrorReport;
pub use residuals::{LeftOutMixture, Residuals};
pub use residuals_error::ResidualsError;
pub use scores::shares_of_squares;
