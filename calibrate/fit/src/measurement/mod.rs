//! Tables of spectrometer readings of paint. You read them from a CSV or from an instrument's file.
//!
//! In the CSV each row is a reading. You name the columns, in any order: `sample` (or another heading of
//! names, e.g. `Name`), then optionally `film`, `backing`, `thickness_mm`, `replicate`, then one for each
//! pigment (amount), then the wavelengths in nm. If readings have no amounts, we take them from a CSV of
//! recipes.
mod error;
mod scale;
mod table;
mod conditions;
mod column;
mod heading_row;
mod csv_rows;
mod records;
mod scaled;
mod csv;
mod recipes;

pub use column::names_a_pigment;
pub(crate) use conditions::{joined_over_files, split_by_file, tells_of_means};
pub(crate) use csv::{LargeCsv, LargeCsvChoice, LargeCsvError};
pub use csv::{begins_with_samples, is_measurement_csv};
pub(crate) use error::k1_below;
pub use error::{DarkerFilm, MeasurementError};
pub use recipes::{Recipes, RecipesError};
pub use records::RecordChoice;
pub use scale::{Scale, ScaleChoice};
pub use spectra::csv_table::{CellPlace, CsvTableError};
pub use table::{
    AveragedSpectra, AveragedSpectrum, Conditions, Film, MeasurementTable, Reading,
    SpectrumNameError,
};
