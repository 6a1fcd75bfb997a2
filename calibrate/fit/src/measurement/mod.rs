//! Tables of spectrometer readings of paint, from a CSV or from an instrument's file.
//!
//! In the CSV each row is a reading. Columns are named, in any order: `sample` (or another heading of names,
//! such as `Name`), then optionally `film`,
//! `backing`, `thickness_mm`, `replicate`, then one for each pigment (amount), then the wavelengths in nm.
//! Readings without amounts take them from a CSV of recipes.
mod error;
mod table;
mod column;
mod csv_rows;
mod csv;
mod recipes;
mod records;

pub use column::names_a_pigment;
pub(crate) use csv::{LargeCsv, LargeCsvChoice, LargeCsvError};
pub use csv::{begins_with_samples, is_measurement_csv};
pub(crate) use error::k1_below;
pub use error::{DarkerFilm, MeasurementError};
pub use recipes::{Recipes, RecipesError};
pub use records::RecordChoice;
pub use spectra::csv_table::{CellPlace, CsvTableError};
pub use table::{
    AveragedSpectra, AveragedSpectrum, Film, MeasurementTable, Reading, Scale, ScaleChoice,
    SpectrumNameError,
};
