//! Tables of spectrometer readings of paint, from a CSV or from an instrument's file.
//!
//! In the CSV each row is a reading. Columns are named, in any order: `sample` (or another heading of names,
//! such as `Name`), then optionally `film`,
//! `backing`, `thickness_mm`, `replicate`, then one for each pigment (amount), then the wavelengths in nm.
//! Readings without amounts take them from a CSV of recipes.

mod darker_film;
mod error;
mod error_hint;
mod scale;
mod table;
mod coordinates;
mod csv_row;
mod name_column;
mod column;
mod heading_row;
mod raw_rows;
mod common_grid;
mod no_amounts;
mod csv_rows;
mod csv;
mod pieces;
mod averaged;
mod recipes;
mod records;

pub use averaged::{AveragedSpectra, AveragedSpectrum, SpectrumNameError};
pub use column::names_a_pigment;
pub use csv::{begins_with_samples, is_measurement_csv};
pub use darker_film::DarkerFilm;
pub use error::MeasurementError;
pub(crate) use error::k1_below;
pub(crate) use pieces::{LargeCsv, LargeCsvChoice, LargeCsvError};
pub use recipes::{Recipes, RecipesError};
pub use records::RecordChoice;
pub use scale::{Scale, ScaleChoice};
pub use spectra::csv_table::{CellPlace, CsvTableError};
pub use table::{Film, MeasurementTable, Reading};
