//! Faults of measurement files, each with its place.

use std::sync::Arc;

use super::darker_film::DarkerFilm;
use spectra::instrument::{InstrumentError, MeasuredQuantity};

use spectra::csv_table::{CellPlace, CsvTableError};

/// The k1 that lies below the reading `least` by a little, with the three digits in which k1 is written.
pub(crate) fn k1_below(least: f64) -> f64 {
    (least * 0.95 * 1000.0).floor() / 1000.0
}

/// Readings that cannot be used. Every variant names the place of the fault.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeasurementError {
    /// A cell, row or column of the table is faulty.
    #[error(transparent)]
    Sheet(CsvTableError),
    /// The file is binary, or a damaged workbook.
    #[error(transparent)]
    Instrument(InstrumentError),
    /// The file holds no readings.
    #[error("{file}: the file holds no readings")]
    Empty {
        /// File name as the caller gave it.
        file: String,
    },
    /// A column has no header.
    #[error("{file}, row {row}: column number {number} has no header")]
    UnnamedColumn {
        /// File name as the caller gave it.
        file: String,
        /// Row of the headers in the file, from 1.
        row: u64,
        /// Column number, counted from 1.
        number: usize,
    },
    /// Two columns have the same header.
    #[error("{place} occurs twice, as column number {first} and {second}")]
    RepeatedColumn {
        /// File, row and column.
        place: CellPlace,
        /// First column number, counted from 1.
        first: usize,
        /// Second column number, counted from 1.
        second: usize,
    },
    /// A wavelength occurs twice.
    #[error("{place}: the wavelength {nm} nm occurs twice")]
    RepeatedWavelength {
        /// File, row and column.
        place: CellPlace,
        /// Wavelength in nm.
        nm: f64,
    },
    /// The wavelengths of the columns neither rise nor fall throughout.
    #[error("{place}: wavelengths must rise or fall throughout, found {nm} nm after {before} nm")]
    UnorderedWavelength {
        /// File, row and column.
        place: CellPlace,
        /// Wavelength of the column before, in nm.
        before: f64,
        /// Wavelength of this column, in nm.
        nm: f64,
    },
    /// A header is a number outside the wavelengths at which paint is measured.
    #[error("{place} is no wavelength from 200 to 2500 nm")]
    WavelengthRange {
        /// File, row and column.
        place: CellPlace,
    },
    /// A reading is negative or far above white.
    #[error("{place}: expected a reflectance {range}, found `{value}`")]
    Reflectance {
        /// File and row; the column is the wavelength.
        place: CellPlace,
        /// Allowed range in the file's unit.
        range: &'static str,
        /// Value that was read, in the file's unit.
        value: f64,
    },
    /// Most readings of a spectrum are negative or far above white.
    #[error(
        "{file}, line {line}: readings of {sample} must be {range}, most of its {count} are not, found `{bad}`"
    )]
    Noise {
        /// File name as the caller gave it.
        file: String,
        /// Line on which the spectrum begins.
        line: u64,
        /// Name of the sample.
        sample: String,
        /// Allowed range in the file's unit.
        range: &'static str,
        /// Number of readings in the spectrum.
        count: usize,
        /// Number of readings that are out of range.
        bad: usize,
    },
    /// A reading looks like a fraction in a file of percent.
    #[error(
        "{file}, row {row}: the file is in percent, but no value of this reading exceeds `{largest}`, as if it were a fraction"
    )]
    MixedScale {
        /// File name as the caller gave it.
        file: String,
        /// Row in the file, the header being row 1.
        row: u64,
        /// Largest value of the reading, in the file's unit.
        largest: f64,
    },
    /// Two readings of one sample have different recipes.
    #[error(
        "{place}: sample {sample} has another amount than in {first_file}, row {first_row}: `{amount}`"
    )]
    Contradiction {
        /// File, row and column.
        place: CellPlace,
        /// Name of the sample.
        sample: String,
        /// File that holds the other amount.
        first_file: Arc<str>,
        /// Row of the other amount.
        first_row: u64,
        /// Amount in this row.
        amount: f64,
    },
    /// A film of paint has no recipe.
    #[error("{file}, row {row}: sample {sample} is paint, but no pigment has an amount")]
    NoRecipe {
        /// File name as the caller gave it.
        file: String,
        /// Row in the file, the header being row 1.
        row: u64,
        /// Name of the sample.
        sample: String,
        /// Whether some row of the files is a bare card.
        has_cards: bool,
    },
    /// A reading is below the surface's own reflection.
    #[error(
        "{file}, row {row}: sample {sample} reads `{measured}` at {nm} nm, below k1 = {k1}: the surface alone would reflect more"
    )]
    BelowSurface {
        /// File name as the caller gave it.
        file: String,
        /// Row in the file, the header being row 1.
        row: u64,
        /// Name of the sample.
        sample: String,
        /// Wavelength in nm.
        nm: f64,
        /// Measured reflectance, as a fraction.
        measured: f64,
        /// Share of light that the surface reflects.
        k1: f64,
        /// Share of light that the surface turns back inside.
        k2: f64,
        /// Least reading of all files, as a fraction.
        least: f64,
    },
    /// No file has a column with the name of a pigment that was asked for.
    #[error("no file has a column of the pigment `{name}`")]
    NoPigmentColumn {
        /// Name that was asked for.
        name: String,
    },
    /// Most readings of films are below what a paint's surface reflects by itself.
    #[error(
        "{file}, row {row}: beginning with sample {sample}, {below} of {count} readings of paint are below k1 = {k1}: the surface alone would reflect more"
    )]
    MostBelowSurface {
        /// File name as the caller gave it.
        file: String,
        /// Row of the first such film, the header being row 1.
        row: u64,
        /// Name of the first sample with such a reading.
        sample: String,
        /// Number of readings below k1.
        below: usize,
        /// Number of all readings of films.
        count: usize,
        /// Share of light that the surface reflects.
        k1: f64,
        /// A surface below every reading, as settings take it.
        below_all: String,
    },
    /// A film is darker over the brighter of two cards.
    #[error("{0}")]
    DarkerOverBrighter(Box<DarkerFilm>),
    /// A reading is above the greatest value under this surface.
    #[error(
        "{file}, row {row}: sample {sample} reads `{measured}` at {nm} nm, above a perfect white"
    )]
    AboveWhite {
        /// File name as the caller gave it.
        file: String,
        /// Row in the file, the header being row 1.
        row: u64,
        /// Name of the sample.
        sample: String,
        /// Wavelength in nm.
        nm: f64,
        /// Measured reflectance, as a fraction.
        measured: f64,
    },
    /// The backing of a film was not measured bare.
    #[error("{file}, row {row}: sample {sample} {}", no_bare_reading(backing))]
    NoBareBacking {
        /// File name as the caller gave it.
        file: String,
        /// Row in the file, the header being row 1.
        row: u64,
        /// Name of the sample.
        sample: String,
        /// Name of the backing; empty if the files name none.
        backing: String,
    },
    /// Two files have different wavelengths.
    #[error(
        "{file}: all files must have one set of wavelengths; {first} has {wanted}, found `{found}`"
    )]
    Grid {
        /// File that differs.
        file: String,
        /// Wavelengths of that file.
        found: String,
        /// File that was read first.
        first: String,
        /// Wavelengths of the first file.
        wanted: String,
    },
    /// The file is of another kind.
    #[error("{file}: expected a table of readings (CSV), found `{found}`")]
    NoTable {
        /// File name as the caller gave it.
        file: String,
        /// Kind of file that it seems to be.
        found: &'static str,
    },
    /// No spectrum of a file is a reflectance.
    #[error("{file}, line {line}: {sample} is {quantity}; reflectance is wanted")]
    NoReflectance {
        /// File name as the caller gave it.
        file: String,
        /// Line in the file, counted from 1.
        line: u64,
        /// Name of the first spectrum.
        sample: String,
        /// Quantity of that spectrum.
        quantity: MeasuredQuantity,
    },
    /// A spectrum has no wavelength at which paint is measured.
    #[error(
        "{file}, line {line}: {sample} is measured from {first_nm} to {last_nm} nm; expected wavelengths from 200 to 2500 nm"
    )]
    Band {
        /// File name as the caller gave it.
        file: String,
        /// Line in the file, counted from 1.
        line: u64,
        /// Name of the spectrum.
        sample: String,
        /// Shortest wavelength in nm.
        first_nm: f64,
        /// Longest wavelength in nm.
        last_nm: f64,
    },
    /// Two spectra of one file have no wavelength in common.
    #[error(
        "{file}: the spectra must overlap; {first} ends at {end_nm} nm, and {second} begins at {start_nm} nm"
    )]
    Apart {
        /// File name as the caller gave it.
        file: String,
        /// Name of the first spectrum.
        first: String,
        /// Longest wavelength of the first, in nm.
        end_nm: f64,
        /// Name of the second spectrum.
        second: String,
        /// Shortest wavelength of the second, in nm.
        start_nm: f64,
    },
    /// The files hold bare cards only.
    #[error("no row is a film of paint")]
    NoFilms,
}

fn no_bare_reading(backing: &str) -> String {
    if backing.is_empty() {
        return "lies on a backing of which there is no bare reading".to_owned();
    }
    format!("lies on `{backing}`, of which there is no bare reading")
}
