//! Spectrometer readings of paint, as a CSV or an instrument's file holds them.
//!
//! In the CSV one row is a reading; columns by name, in any order: `sample`, then optionally
//! `film`, `backing`, `thickness_mm`, `replicate`, then one column per pigment
//! (amount), then the wavelengths in nm. Readings without amounts get theirs from a CSV of
//! recipes.

mod column;

mod common_grid;

mod csv;

mod error;

mod recipes;

mod records;

mod scale;

mod table;

pub use column::names_a_pigment;
pub use csv::is_measurement_csv;
pub use error::MeasurementError;
pub use recipes::{Recipes, RecipesError};
pub use records::RecordChoice;
pub use scale::{Scale, ScaleChoice};
pub use spectra::csv_table::{CellPlace, CsvTableError};
pub use table::{Film, MeasurementTable, Reading};
