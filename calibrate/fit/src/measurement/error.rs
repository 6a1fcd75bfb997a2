//! Faults of measurement files, each with its place and advice.

use std::fmt;
use std::sync::Arc;

use documents::hint::{Explain, Hint};
use spectra::csv_table::{CellPlace, CsvTableError};
use spectra::instrument::{InstrumentError, MeasuredQuantity};

/// A k1 that lies a little below the reading `least`, with the three digits that we write.
pub(crate) fn k1_below(least: f64) -> f64 {
    (least * 0.95 * 1000.0).floor() / 1000.0
}

/// Readings that cannot be used. Every variant names the place of the fault.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum MeasurementError {
    /// A cell, row or column of the table is faulty.
    #[error(transparent)]
    #[hint(with = sheet_hint(_0))]
    #[fault(Input)]
    Sheet(CsvTableError),
    /// The file is binary, or a damaged workbook.
    #[error(transparent)]
    Instrument(InstrumentError),
    /// The file holds no readings.
    #[error("{0}: the file holds no readings")]
    Empty(String),
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
    #[hint("remove or rename one of the two columns")]
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
    #[hint("remove or rename one of the two columns")]
    RepeatedWavelength {
        /// File, row and column.
        place: CellPlace,
        /// Wavelength in nm.
        nm: f64,
    },
    /// The wavelengths of the columns neither rise nor fall throughout.
    #[error("{place}: wavelengths must rise or fall throughout, found {nm} nm after {before} nm")]
    #[hint("order the wavelength columns from short to long")]
    UnorderedWavelength {
        /// File, row and column.
        place: CellPlace,
        /// Wavelength of the column before, in nm.
        before: f64,
        /// Wavelength of this column, in nm.
        nm: f64,
    },
    /// A header is a number outside the wavelengths at which paint is measured.
    #[error("{0} is not a wavelength from 200 to 2500 nm")]
    #[hint(
        "if it is a pigment, name it: [pigments={}], once for each pigment; a file of recipes may have such a column too. If the file holds values only, name their wavelengths: [wavelengths=380..730:10]",
        _0.column
    )]
    WavelengthRange(CellPlace),
    /// A reading is negative or far above white.
    #[error("{place}: expected a reflectance {range} of {sample}, found `{value}`")]
    #[hint(
        "set [percent] or [fraction] if the unit was recognised wrongly; a dark reading below 0 means that the instrument's zero is off"
    )]
    Reflectance {
        /// File and row. The column is the wavelength.
        place: CellPlace,
        /// Name of the sample.
        sample: String,
        /// Allowed range in the file's unit.
        range: &'static str,
        /// Value that was read, in the file's unit.
        value: f64,
    },
    /// Most readings of a spectrum are negative or far above white.
    #[error(
        "{file}, line {line}: readings of {sample} must be {range}, and {bad} of its {count} are not"
    )]
    #[hint(
        "the file may hold a detector's counts ([white_reading=FILE] [dark_reading=FILE]), or another unit ([percent], [fraction])"
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
    /// Two columns of amounts have different units.
    #[error("{place}: the amount is in `{unit}`, and that of `{first}` is not")]
    #[hint("write all amounts in one unit")]
    MixedAmounts {
        /// File, row and column.
        place: CellPlace,
        /// Unit of the column.
        unit: String,
        /// Heading of the first column of amounts with another unit.
        first: String,
    },
    /// Readings of one sample were taken under several geometries.
    #[error(
        "{file}, row {row}: {sample} is read under {count} geometries (column `{column}`); a calibration takes one"
    )]
    #[hint("keep the rows of one geometry, such as 45as45 or 45:0")]
    SeveralGeometries {
        /// File name as the caller gave it.
        file: String,
        /// Row in the file.
        row: u64,
        /// Name of the sample.
        sample: String,
        /// Heading of the column.
        column: String,
        /// Number of geometries.
        count: usize,
    },
    /// A reading looks like a fraction in a file of percent.
    #[error(
        "{file}, row {row}: the file is in percent, but no value of this reading exceeds `{largest}`, as if it were a fraction"
    )]
    #[hint("write all readings in one unit, or set [percent] if this sample really is that dark")]
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
    #[hint("one name is one sample; rename one of the two, or give both the same amounts")]
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
    #[hint(
        if !has_cards,
        "if it is a bare card or paper, say so in a column `film`: `none` for it, `paint` for the others; else write its amounts in the pigment columns. A file of recipes may have both: [recipes=FILE.csv]"
    )]
    #[hint(
        "write the amounts in the pigment columns, or in a file of recipes ([recipes=FILE.csv]); film `none` is a bare card"
    )]
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
    #[hint(
        "give a k1 below every reading, such as [saunderson={:.3},{k2}], or read such samples as black: [below_surface=floor]",
        k1_below(*least)
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
    #[error("no file has a column of the pigment `{0}`")]
    #[hint("[pigments=NAME] takes the heading of a column, once for each pigment")]
    NoPigmentColumn(String),
    /// Most readings of films are below what a paint's surface reflects by itself.
    #[error(
        "{file}, row {row}: beginning with sample {sample}, {below} of {count} readings of paint are below k1 = {k1}: the surface alone would reflect more"
    )]
    #[hint(
        "readings in fractions (white near 1) take [fraction]; for a surface that reflects less, give its k1 and k2, such as [saunderson={below_all}]"
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
        /// Surface with k1 below every reading, written as in a setting.
        below_all: String,
    },
    /// A film is darker over the brighter of two cards.
    #[error("{0}")]
    #[hint(
        "paint cannot do this; {} and {} may be exchanged in the column `backing`, or leave the sample out: [exclude={}]",
        _0.bright,
        _0.dark,
        _0.sample
    )]
    DarkerOverBrighter(Box<DarkerFilm>),
    /// A reading is above the greatest value under this surface.
    #[error(
        "{file}, row {row}: sample {sample} reads `{measured}` at {nm} nm, above a perfect white"
    )]
    #[hint("set [percent] or [fraction] if the unit was recognised wrongly")]
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
    #[hint(
        if backing.is_empty(),
        "add a row with the reading of the bare card or paper, and a column `film` with `none` in it and `paint` in the others; more than one card takes a column `backing` too. A file of recipes may have these columns instead: [recipes=FILE.csv]"
    )]
    #[hint("add a row with film `none` and backing `{backing}`: the card without paint")]
    NoBareBacking {
        /// File name as the caller gave it.
        file: String,
        /// Row in the file, the header being row 1.
        row: u64,
        /// Name of the sample.
        sample: String,
        /// Name of the backing, or empty if the files name none.
        backing: String,
    },
    /// Two files have different wavelengths.
    #[error(
        "{file}: all files must have one set of wavelengths; {first} has {wanted}, found `{found}`"
    )]
    #[hint("fit files of different wavelengths one by one")]
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
    #[hint(
        "a pigment library is read by mix, quadrature and library; fit, validate and color read CSV"
    )]
    NoTable {
        /// File name as the caller gave it.
        file: String,
        /// Kind of file that it seems to be.
        found: &'static str,
    },
    /// No spectrum of a file is a reflectance.
    #[error("{file}, line {line}: {sample} is {quantity}{stated}; reflectance is wanted")]
    #[hint(
        if *quantity == MeasuredQuantity::Counts,
        "counts need a white and a dark reading: [white_reading=FILE] [dark_reading=FILE]"
    )]
    #[hint(
        if *quantity == MeasuredQuantity::Power,
        "the light of a lamp is read by [illuminant=FILE]"
    )]
    #[hint(
        if *quantity == MeasuredQuantity::Transmittance,
        "if it was read over a white tile, set [as_reflectance]"
    )]
    #[hint(
        if *quantity == MeasuredQuantity::Absorbance,
        "if it is the absorbance of a reflectance, set [values=absorbance]; if the heading misleads, [values=reflectance]"
    )]
    #[hint(
        if *quantity == MeasuredQuantity::KubelkaMunk,
        "to turn K/S into reflectance, set [values=k/s]; if the heading misleads, [values=reflectance]"
    )]
    #[hint(
        "export reflectance from the instrument's program; if the heading misleads, set [values=reflectance]"
    )]
    NoReflectance {
        /// File name as the caller gave it.
        file: String,
        /// Line in the file, counted from 1.
        line: u64,
        /// Name of the first spectrum.
        sample: String,
        /// Quantity of that spectrum.
        quantity: MeasuredQuantity,
        /// The unit of an unknown quantity, in brackets, or empty.
        stated: String,
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
    #[hint("save each in a file of its own and read the files one by one")]
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
    #[hint(
        "a film has `paint` (or nothing) in the column film, and amounts in the pigment columns"
    )]
    NoFilms,
}

fn sheet_hint(error: &CsvTableError) -> Option<Hint> {
    Some(Hint::new(match error {
        CsvTableError::MissingColumn { .. } => {
            "one row names the columns: sample (or Name, Sample ID ..), film, backing, one per pigment, then wavelengths such as 400. If the file holds values only, name their wavelengths: [wavelengths=380..730:10]"
        }
        CsvTableError::RowLength { wanted, found, .. } if found > wanted => {
            "numbers take a decimal point; a decimal comma splits a cell in two"
        }
        CsvTableError::RowLength { .. } => "the row may be cut off; write empty cells as `,,`",
        CsvTableError::Cell { wanted: "an amount in the unit of the other cells", .. } => {
            "write all amounts in one unit, e.g. all as `5 %` or all as `5`"
        }
        CsvTableError::Cell { text, .. } if is_number_with(text, [',', '.']) => {
            "numbers have a decimal point, or a decimal comma in every reading of the file"
        }
        CsvTableError::Cell { wanted: "a reflectance", text, .. } if text.is_empty() => {
            "fill in the reading, or remove the row of a sample that was not read"
        }
        CsvTableError::Cell { wanted: "an amount of pigment", .. } => {
            "a column that is neither known nor a wavelength is read as a pigment; if it is none, name those that are: [pigments=NAME]"
        }
        CsvTableError::Cell { .. } => return None,
    }))
}

/// Whether `text` has digits around one of the signs.
fn is_number_with(text: &str, signs: [char; 2]) -> bool {
    let is_digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    text.contains(',') || text.split_once(signs).is_some_and(|(a, b)| is_digits(a) && is_digits(b))
}

fn no_bare_reading(backing: &str) -> String {
    if backing.is_empty() {
        return "lies on a backing of which there is no bare reading".to_owned();
    }
    format!("lies on `{backing}`, of which there is no bare reading")
}

/// A film of paint that is darker over the brighter of two cards. No paint can do this.
#[derive(Debug, Clone, PartialEq)]
pub struct DarkerFilm {
    /// File name as the caller gave it.
    pub file: String,
    /// Row of the first reading of the sample, the header being row 1.
    pub row: u64,
    /// Name of the sample.
    pub sample: String,
    /// Backing with the brighter bare card.
    pub bright: String,
    /// Backing with the darker bare card.
    pub dark: String,
    /// Largest difference of reflectance.
    pub by: f64,
    /// Wavelength of the largest difference, in nm.
    pub nm: f64,
    /// First and last wavelength at which the film is too dark, in nm.
    pub band_nm: [f64; 2],
    /// Number of further samples with this fault.
    pub others: usize,
}

impl fmt::Display for DarkerFilm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, row, sample, bright, dark, by, nm, band_nm: [first, last], others } = self;
        write!(
            f,
            "{file}, row {row}: sample {sample} is darker over the brighter card {bright} than over {dark}, by {by:.3} at {nm} nm (too dark from {first} to {last} nm)"
        )?;
        match others {
            0 => Ok(()),
            1 => f.write_str("; one more sample is"),
            _ => write!(f, "; {others} more samples are"),
        }
    }
}
