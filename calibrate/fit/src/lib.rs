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
//! use calibrate::{FitRequest, Readings};
//!
//! let readings = Readings::open(path)?;
//! let options = FitRequest { method: Method::Weighted, ..FitRequest::default() };
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
//! | compare two sets of measurements | [`compare_sets`] |
//! | K, S and hiding power of a film on two cards | [`film()`] |
//! | compare a library with measurements | [`comparison::Comparable`] |
//! | colours and recipes of a library | [`PigmentLibrary`], from the crate `pigment`, whose modules are here too |
//!
//! Modules are ordered by dependence: each uses only modules declared above it.

pub use pigment::{
    Appearance, Backing, BackingError, ColorError, Curves, FilmOver, IlluminantChange,
    MixtureColor, PigmentId, PigmentLibrary, Recipe, Remark, RemarkKind, Viewing, curation, curves,
    digits, evaluate, library, matching, palette, quadrature, recipe, remark, rows,
    smooth_reflectance, visible_band,
};

pub mod measurement;
pub mod swatch;
pub mod readings;
mod ground;
pub mod observation;
pub mod fit;
mod residuals;
pub mod report;
mod leave_out;
mod request;
mod two_cards;
pub mod film;
pub mod agreement;
pub mod calibration;
mod disorder;
pub mod absolute;
pub mod fitting;
mod strength;
pub mod validation;
pub mod comparison;
pub mod plan;
pub mod synthetic;

pub use agreement::{CompareRequest, compare_sets};
pub use film::{FilmRequest, film};
pub use fitting::{FilmModel, Fit, FittingError, PreparedFit, fit};
pub use ground::{BackingTextError, backing_from_text};
pub use leave_out::LeaveOut;
pub use plan::plan;
pub use readings::{ReadingFormat, ReadingOptions, Readings, ReadingsError};
pub use report::{ErrorReport, shares_of_squares};
pub use request::{FitRequest, Provenance, ValidationRequest};
pub use residuals::{LeftOutMixture, Residuals, ResidualsError};
pub use strength::StrengthChange;
pub use validation::{FitValidation, LeftOut, validate};
