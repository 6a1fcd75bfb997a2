//! What can be wrong with a measurement file, and where.

use spectra::instrument::MeasuredQuantity;

use spectra::csv_table::{CellPlace, CsvTableError};

/// Why readings cannot be used. Every variant says where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeasurementError {
    /// The sheet is faulty.
    #[error(transparent)]
    Sheet(CsvTableError),
    /// The file holds nothing.
    #[error("{file}: the file holds no readings")]
    Empty {
        /// The file.
        file: String,
    },
    /// A column has no header.
    #[error("{file}, row 1: column number {number} has no header")]
    UnnamedColumn {
        /// The file.
        file: String,
        /// Counted from 1.
        number: usize,
    },
    /// Two columns have one header.
    #[error("{place} stands twice, as column number {first} and {second}")]
    RepeatedColumn {
        /// Where.
        place: CellPlace,
        /// Counted from 1.
        first: usize,
        /// Counted from 1.
        second: usize,
    },
    /// A wavelength stands twice.
    #[error("{place}: the wavelength {nm} nm stands twice")]
    RepeatedWavelength {
        /// Where.
        place: CellPlace,
        /// The wavelength.
        nm: f64,
    },
    /// Wavelengths fall.
    #[error("{place}: wavelengths must rise, found {nm} nm after {before} nm")]
    FallingWavelength {
        /// Where.
        place: CellPlace,
        /// The one before.
        before: f64,
        /// The one found.
        nm: f64,
    },
    /// A header is a number that is no wavelength of light.
    #[error("{place} is no wavelength from 200 to 2500 nm")]
    WavelengthRange {
        /// Where.
        place: CellPlace,
    },
    /// A reading below 0 or far above white.
    #[error("{place}: a reflectance {range} is wanted, found `{value}`")]
    Reflectance {
        /// Where; the column is the wavelength.
        place: CellPlace,
        /// The allowed range, in the file's unit.
        range: &'static str,
        /// What was found.
        value: f64,
    },
    /// Most readings of a spectrum are below 0 or far above white.
    #[error(
        "{file}, line {line}: readings of {sample} must be {range}, most of its {count} are not, found `{bad}`"
    )]
    Noise {
        /// The file.
        file: String,
        /// Where the spectrum begins.
        line: u64,
        /// The sample.
        sample: String,
        /// The allowed range, in the file's unit.
        range: &'static str,
        /// How many readings it has.
        count: usize,
        /// How many are out of range.
        bad: usize,
    },
    /// One reading looks like fractions in a file of percent.
    #[error(
        "{file}, row {row}: the file is in percent, but no value of this reading exceeds `{largest}`, as if it were a fraction"
    )]
    MixedScale {
        /// The file.
        file: String,
        /// The row.
        row: u64,
        /// The largest value of the reading.
        largest: f64,
    },
    /// Two readings of one sample carry different recipes.
    #[error(
        "{place}: sample {sample} has another amount than in {first_file}, row {first_row}: `{amount}`"
    )]
    Contradiction {
        /// Where.
        place: CellPlace,
        /// The sample.
        sample: String,
        /// Where the other amount stands.
        first_file: String,
        /// Its row there.
        first_row: u64,
        /// The amount found.
        amount: f64,
    },
    /// A film has no recipe.
    #[error("{file}, row {row}: sample {sample} is paint, but no pigment has an amount")]
    NoRecipe {
        /// The file.
        file: String,
        /// The row.
        row: u64,
        /// The sample.
        sample: String,
    },
    /// A reading lies below what the surface alone reflects.
    #[error(
        "{file}, row {row}: sample {sample} reads `{measured}` at {nm} nm, below k1 = {k1}: the surface alone would reflect more"
    )]
    BelowSurface {
        /// The file.
        file: String,
        /// The row.
        row: u64,
        /// The sample.
        sample: String,
        /// The wavelength.
        nm: f64,
        /// The reading, as a fraction.
        measured: f64,
        /// The surface's share.
        k1: f64,
        /// Its other share.
        k2: f64,
        /// The least reading of the whole file, as a fraction.
        least: f64,
    },
    /// A reading above what a white film under this surface can reflect.
    #[error(
        "{file}, row {row}: sample {sample} reads `{measured}` at {nm} nm, above a perfect white"
    )]
    AboveWhite {
        /// The file.
        file: String,
        /// The row.
        row: u64,
        /// The sample.
        sample: String,
        /// The wavelength.
        nm: f64,
        /// The reading, as a fraction.
        measured: f64,
    },
    /// A film on a known backing whose bare reading is missing.
    #[error(
        "{file}, row {row}: sample {sample} lies on `{backing}`, of which there is no bare reading"
    )]
    NoBareBacking {
        /// The file.
        file: String,
        /// The row.
        row: u64,
        /// The sample.
        sample: String,
        /// The backing.
        backing: String,
    },
    /// Two files on different wavelengths.
    #[error(
        "{file}: all files must have one set of wavelengths; {first} has {wanted}, found `{found}`"
    )]
    Grid {
        /// The later file.
        file: String,
        /// Its wavelengths.
        found: String,
        /// The first file.
        first: String,
        /// Its wavelengths.
        wanted: String,
    },
    /// Another kind of file.
    #[error("{file}: a table of readings (CSV) is wanted, found `{found}`")]
    NoTable {
        /// The file.
        file: String,
        /// What it seems to be.
        found: &'static str,
    },
    /// No spectrum of a file is one of reflectance.
    #[error("{file}, line {line}: {sample} is {quantity}; reflectance is wanted")]
    NoReflectance {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// The first spectrum.
        sample: String,
        /// What it is.
        quantity: MeasuredQuantity,
    },
    /// A spectrum has no wavelength that a reading of paint has.
    #[error(
        "{file}, line {line}: {sample} is measured from {first_nm} to {last_nm} nm; wavelengths from 200 to 2500 nm are wanted"
    )]
    Band {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// The spectrum.
        sample: String,
        /// Its shortest wavelength.
        first_nm: f64,
        /// Its longest.
        last_nm: f64,
    },
    /// Two spectra of one file have no wavelength in common.
    #[error(
        "{file}: the spectra must overlap; {first} ends at {end_nm} nm, and {second} begins at {start_nm} nm"
    )]
    Apart {
        /// The file.
        file: String,
        /// One spectrum.
        first: String,
        /// Its longest wavelength.
        end_nm: f64,
        /// Another.
        second: String,
        /// Its shortest wavelength.
        start_nm: f64,
    },
    /// Bare cards only.
    #[error("no row is a film of paint")]
    NoFilms,
}

impl MeasurementError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::Sheet(CsvTableError::MissingColumn { .. }) => {
                "the first row names the columns: sample, film, backing, one per pigment, then wavelengths such as 400".into()
            }
            Self::RepeatedColumn { .. } | Self::RepeatedWavelength { .. } => {
                "remove or rename one of the two columns".into()
            }
            Self::FallingWavelength { .. } => {
                "order the wavelength columns from short to long".into()
            }
            Self::Sheet(CsvTableError::RowLength { wanted, found, .. }) if found > wanted => {
                "numbers take a decimal point; a decimal comma splits a cell in two".into()
            }
            Self::Sheet(CsvTableError::RowLength { .. }) => {
                "the row may be cut off; write empty cells as `,,`".into()
            }
            Self::Sheet(CsvTableError::Cell { text, .. }) if text.contains(',') => {
                "numbers take a decimal point, not a comma".into()
            }
            Self::Sheet(CsvTableError::Cell { wanted: "a reflectance", text, .. }) if text.is_empty() => {
                "fill in the reading, or remove the row of a sample that was not read".into()
            }
            Self::Sheet(CsvTableError::Cell { wanted: "an amount of pigment", .. }) => {
                "a column that is neither known nor a wavelength is read as a pigment; remove it if it is none".into()
            }
            Self::NoTable { .. } => {
                "a pigment library goes to mix, quadrature and library; fit, validate and color read CSV".into()
            }
            Self::Contradiction { .. } => {
                "one name is one sample; rename one of the two, or give both the same amounts".into()
            }
            Self::WavelengthRange { .. } => {
                "a pigment's name must not be a number".into()
            }
            Self::Grid { .. } => "fit files of different wavelengths one by one".into(),
            Self::MixedScale { .. } => {
                "write all readings in one unit, or say `--percent` if this sample really is that dark".into()
            }
            Self::Reflectance { .. } => {
                "say `--percent` or `--fraction` if the unit was told apart wrongly; a dark reading below 0 means that the instrument's zero is off".into()
            }
            Self::Noise { .. } => {
                "the file may hold a detector's counts (--white FILE --dark FILE), or another unit (`--percent`, `--fraction`)".into()
            }
            Self::BelowSurface { least, k2, .. } => format!(
                "give a k1 below every reading, such as `--saunderson {:.3},{k2}`, or `--below-surface floor` to read such samples as black",
                (least * 0.95 * 1000.0).floor() / 1000.0
            ),
            Self::NoBareBacking { backing, .. } => format!(
                "add a row with film `none` and backing `{backing}`: the card without paint"
            ),
            Self::NoFilms => "a film has `paint` (or nothing) in the column film, and amounts in the pigment columns".into(),
            Self::NoRecipe { .. } => {
                "write the amounts in the pigment columns, or in a file of recipes (--recipes FILE.csv); film `none` is a bare card".into()
            }
            Self::NoReflectance { quantity, .. } => match quantity {
                MeasuredQuantity::Counts => "counts need a white and a dark reading: --white FILE --dark FILE",
                MeasuredQuantity::Power => "the light of a lamp goes to --illuminant FILE",
                MeasuredQuantity::Transmittance => "if it was read over a white tile, say --as-reflectance",
                _ => "export reflectance from the instrument's program",
            }
            .into(),
            Self::Apart { .. } => "read them as files of their own".into(),
            Self::AboveWhite { .. } => "say `--percent` or `--fraction` if the unit was told apart wrongly".into(),
            _ => return None,
        })
    }
}
