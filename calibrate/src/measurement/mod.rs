//! Spectrometer readings of paint, as a CSV holds them.
//!
//! One row a reading; columns by name, in any order: `sample`, then optionally
//! `film`, `backing`, `thickness_mm`, `replicate`, then one column per pigment
//! (amount), then the wavelengths in nm.

mod column;

mod error;

mod scale;

mod table;

pub(crate) use column::wavelength as wavelength_of_header;
pub use error::{MeasurementError, Place};
pub use scale::{Scale, ScaleChoice};
pub use table::{Film, MeasurementTable, Reading};
