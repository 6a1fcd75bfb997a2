//! Measurement files of any known format, read together, with the options and errors of reading them.

use std::fs::File;
use std::path::Path;

use documents::hint::Explain;
use documents::{counted, file::FileError};
use pigment::library::Input;
use pigment::remark::Remark;
use spectra::instrument::{
    FileOptions, FileText, Format, InstrumentError, InstrumentFile, StatedValues, bytes_of,
    read_with,
};
use spectra::referencing::{
    OpenedReferences, ReferenceFiles, ReferenceFilesError, ReferencingError, TileSource,
};

use crate::measurement::{
    LargeCsv, LargeCsvChoice, LargeCsvError, MeasurementError, MeasurementTable, Recipes,
    RecipesError, RecordChoice, Scale, ScaleChoice, begins_with_samples, is_measurement_csv,
    joined_over_files, split_by_file, tells_of_means,
};
use crate::swatch::SwatchSet;

/// Readings of one or more measurement files. If you want a sheet of a workbook, give `FILE.xlsx#SHEET`.
///
/// ```no_run
/// let readings = calibrate::Readings::open("swatches.ti3")?.with_recipes("recipes.csv")?;
/// for remark in &readings.remarks {
///     eprintln!("{remark}");
/// }
/// # Ok::<(), calibrate::ReadingsError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Readings {
    /// Readings of all files on one grid.
    pub table: MeasurementTable,
    /// Files that were read, with their hashes: measurements, then references, then recipes.
    pub inputs: Vec<Input>,
    /// Summary of the contents of each file, and warnings about them.
    pub remarks: Vec<Remark>,
}

impl Readings {
    /// Reads one measurement file of any known format.
    ///
    /// # Errors
    /// [`ReadingsError`] with file, row and column.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, ReadingsError> {
        Self::open_all(&[path], &ReadingOptions::default())
    }

    /// Reads several measurement files. They must have the same pigments and wavelengths.
    ///
    /// # Errors
    /// [`ReadingsError`] with file, row and column.
    pub fn open_all<P: AsRef<Path>>(
        paths: &[P],
        options: &ReadingOptions,
    ) -> Result<Self, ReadingsError> {
        Self::open_files(paths, options, false)
    }

    /// Reads only the spectra of files. Use this if you do not need their other columns, for example
    /// recipes.
    ///
    /// # Errors
    /// [`ReadingsError`] with file, row and column.
    pub fn open_spectra<P: AsRef<Path>>(
        paths: &[P],
        options: &ReadingOptions,
    ) -> Result<Self, ReadingsError> {
        Self::open_files(paths, options, true)
    }

    /// Reads measurement files of any known format from memory. Pass the name and content of each. We use
    /// the name in errors, and it may end in `#SHEET`. White, dark and tile of the options are files on the
    /// disk.
    ///
    /// # Errors
    /// [`ReadingsError`] with file, row and column.
    pub fn from_files<N: AsRef<str>, B: AsRef<[u8]>>(
        files: &[(N, B)],
        options: &ReadingOptions,
    ) -> Result<Self, ReadingsError> {
        Self::of_files(files, options, false)
    }

    /// Reads the spectra of files in memory. See [`Readings::open_spectra`] for files on the disk.
    ///
    /// # Errors
    /// [`ReadingsError`] with file, row and column.
    pub fn spectra_from_files<N: AsRef<str>, B: AsRef<[u8]>>(
        files: &[(N, B)],
        options: &ReadingOptions,
    ) -> Result<Self, ReadingsError> {
        Self::of_files(files, options, true)
    }

    /// Reads the measurement CSV in `bytes`, the content of `file`.
    ///
    /// # Errors
    /// [`ReadingsError::Measurement`] with row and column.
    pub fn from_csv(file: &str, bytes: &[u8]) -> Result<Self, ReadingsError> {
        Self::from_csv_with(file, bytes, &ReadingOptions::default())
    }

    /// Reads the measurement CSV in `bytes`, the content of `file`. For a CSV we use only the options
    /// `scale` and `pigments`.
    ///
    /// # Errors
    /// [`ReadingsError::Measurement`] with row and column.
    pub fn from_csv_with(
        file: &str,
        bytes: &[u8],
        options: &ReadingOptions,
    ) -> Result<Self, ReadingsError> {
        let (table, remarks) = csv_table(file, bytes, options, false)?;
        Ok(Self { table, inputs: vec![Input::new(file, bytes)], remarks })
    }

    /// Adds the recipes of a CSV file (columns `sample`, one for each pigment, optionally `film`,
    /// `backing`, `thickness_mm` and `reading`). Use this if the files of the readings have no recipes.
    ///
    /// # Errors
    /// [`ReadingsError::Recipes`] with the row.
    pub fn with_recipes(self, path: impl AsRef<Path>) -> Result<Self, ReadingsError> {
        self.with_recipes_of(path, None)
    }

    /// Adds the recipes of a CSV file like [`Readings::with_recipes`]. We read only the columns headed as
    /// one of `pigments`.
    ///
    /// # Errors
    /// [`ReadingsError::Recipes`] with the row.
    pub fn with_recipes_of(
        self,
        path: impl AsRef<Path>,
        pigments: Option<&[String]>,
    ) -> Result<Self, ReadingsError> {
        let (file, bytes) = content(path.as_ref())?;
        self.with_recipes_from(&file, &bytes, pigments)
    }

    /// Adds the recipes of the CSV file in `bytes`, the content of `file`, like [`Readings::with_recipes_of`].
    ///
    /// # Errors
    /// [`ReadingsError::Recipes`] with the row.
    pub fn with_recipes_from(
        mut self,
        file: &str,
        bytes: &[u8],
        pigments: Option<&[String]>,
    ) -> Result<Self, ReadingsError> {
        let recipes = Recipes::from_csv(file, bytes, pigments)?;
        self.table.remarks.clear();
        self.remarks.retain(|remark| !tells_of_means(&remark.text));
        self.table = recipes.joined_to(self.table)?;
        self.remarks.extend(self.table.remarks.iter().map(Remark::warning));
        self.inputs.push(Input::new(file, bytes));
        Ok(self)
    }

    /// Checks that some file has a column for each of `pigments`.
    ///
    /// # Errors
    /// [`MeasurementError::NoPigmentColumn`] for the first that has none.
    pub fn check_has_pigments(&self, pigments: &[String]) -> Result<(), MeasurementError> {
        match pigments.iter().find(|name| !self.table.pigments.contains(name)) {
            Some(name) => Err(MeasurementError::NoPigmentColumn(name.clone())),
            None => Ok(()),
        }
    }

    /// Groups the readings by sample.
    ///
    /// # Errors
    /// [`MeasurementError`] for rows that contradict each other, or if `set` has no films of paint.
    pub fn swatches(&self) -> Result<SwatchSet, MeasurementError> {
        SwatchSet::from_table(&self.table)
    }

    fn of_files<N: AsRef<str>, B: AsRef<[u8]>>(
        files: &[(N, B)],
        options: &ReadingOptions,
        spectra_only: bool,
    ) -> Result<Self, ReadingsError> {
        let references = options.references.as_ref().map(References::open).transpose()?;
        let mut found = Found::default();
        for (file, bytes) in files {
            let file = file.as_ref();
            let bytes = bytes.as_ref();
            found.add(of_bytes(file, bytes, options, references.as_ref(), spectra_only)?);
        }
        found.joined(references.as_ref(), spectra_only)
    }

    fn open_files<P: AsRef<Path>>(
        paths: &[P],
        options: &ReadingOptions,
        spectra_only: bool,
    ) -> Result<Self, ReadingsError> {
        let references = options.references.as_ref().map(References::open).transpose()?;
        let mut found = Found::default();
        for path in paths {
            if let Some(large) = large_csv(path.as_ref(), options, spectra_only)? {
                found.add(large);
                continue;
            }
            let (file, bytes) = content(path.as_ref())?;
            found.add(of_bytes(&file, &bytes, options, references.as_ref(), spectra_only)?);
        }
        found.joined(references.as_ref(), spectra_only)
    }
}

type OfFile = (MeasurementTable, Input, Vec<Remark>);

/// Tables, inputs and remarks of the files so far.
#[derive(Default)]
struct Found {
    tables: Vec<MeasurementTable>,
    inputs: Vec<Input>,
    remarks: Vec<Remark>,
}

impl Found {
    fn add(&mut self, (table, input, remarks): OfFile) {
        self.tables.push(table);
        self.inputs.push(input);
        self.remarks.extend(remarks);
    }

    /// Joins the tables. If only the spectra matter, readings of several files are never one sample. Recipes
    /// may say that they are.
    fn joined(
        mut self,
        references: Option<&References>,
        spectra_only: bool,
    ) -> Result<Readings, ReadingsError> {
        let shared = if spectra_only {
            split_by_file(&mut self.tables)
        } else {
            joined_over_files(&self.tables)
        };
        self.remarks.extend(shared.map(Remark::warning));
        self.remarks.splice(0..0, references.and_then(References::remark));
        let files = references.iter().flat_map(|references| &references.opened.files);
        self.inputs.extend(files.map(|(file, bytes)| Input::new(file, bytes)));
        let table = MeasurementTable::joined(self.tables)?;
        Ok(Readings { table, inputs: self.inputs, remarks: self.remarks })
    }
}

fn of_bytes(
    file: &str,
    bytes: &[u8],
    options: &ReadingOptions,
    references: Option<&References>,
    spectra_only: bool,
) -> Result<OfFile, ReadingsError> {
    let (table, remarks) = match instrument_file(file, bytes, options)? {
        Some(spectra) => instrument_table(file, spectra, options, references)?,
        None if references.is_some() || options.values == Some(StatedValues::Counts) => {
            return Err(ReadingsError::CsvOfCounts(file.to_owned()));
        }
        None => csv_table(file, bytes, options, spectra_only)?,
    };
    Ok((table, Input::new(file, bytes), remarks))
}

/// Opened files of white, dark and tile.
struct References {
    /// The white as the caller named it.
    white: String,
    assumes_tile: bool,
    opened: OpenedReferences,
}

impl References {
    fn open(files: &ReferenceFiles) -> Result<Self, ReferenceFilesError> {
        let assumes_tile = files.tile == TileSource::Fraction(1.0);
        Ok(Self { white: files.white.clone(), assumes_tile, opened: files.open()? })
    }

    fn remark(&self) -> Option<Remark> {
        let note = Remark::note("the white is taken to reflect everything");
        self.assumes_tile.then(|| note.with_hint("state its reflectance with [tile]"))
    }
}

/// The instrument's file in `bytes`. You get `None` for the measurement CSV, and for unknown content, so
/// that the CSV's reader reports the first fault.
fn instrument_file(
    file: &str,
    bytes: &[u8],
    options: &ReadingOptions,
) -> Result<Option<InstrumentFile>, InstrumentError> {
    let format = match options.format {
        Some(ReadingFormat::Csv) => return Ok(None),
        Some(ReadingFormat::Instrument(format)) => Some(format),
        None => None,
    };
    let wavelengths_nm = options.wavelengths_nm.clone();
    let known = FileOptions { format, values: options.values, wavelengths_nm };
    if known.format.is_some() || known.wavelengths_nm.is_some() {
        return read_with(file, bytes, &known).map(Some);
    }
    let Some(content) = FileText::of(file, bytes)? else {
        return read_with(file, bytes, &known).map(Some);
    };
    let text = &content.text;
    let detected = if begins_with_samples(text) { None } else { Format::detect(file, text) };
    // If a table has no numbers below its headings, we do not read it as columns of numbers.
    let detected =
        detected.filter(|format| *format != Format::Columns || !is_measurement_csv(text));
    detected.map(|_| read_with(file, bytes, &known)).transpose()
}

fn instrument_table(
    file: &str,
    mut content: InstrumentFile,
    options: &ReadingOptions,
    references: Option<&References>,
) -> Result<(MeasurementTable, Vec<Remark>), ReadingsError> {
    if let Some(References { white, opened, .. }) = references {
        let reflectances = opened.referencing.reflectances(&content.spectra);
        content.spectra = reflectances.map_err(|reason| ReadingsError::Referencing {
            file: file.to_owned(),
            white: white.clone(),
            reason,
        })?;
    }
    let choice = RecordChoice {
        scale: options.scale_choice(),
        transmittance_is_reflectance: options.transmittance_is_reflectance,
    };
    let table = MeasurementTable::from_records(file, &content.spectra, choice)?;
    let count = table.readings.len();
    let spectra = if count == 1 { "spectrum" } else { "spectra" };
    let summary = format!("{file}: {}, {count} {spectra}", content.format.title());
    let remarks = remarks(&summary, &table, references.is_some());
    Ok((table, remarks))
}

fn csv_table(
    file: &str,
    bytes: &[u8],
    options: &ReadingOptions,
    spectra_only: bool,
) -> Result<(MeasurementTable, Vec<Remark>), MeasurementError> {
    let table = if spectra_only {
        MeasurementTable::spectra_from_csv(file, bytes, options.scale_choice())?
    } else {
        MeasurementTable::from_csv_with(
            file,
            bytes,
            options.scale_choice(),
            options.pigments.as_deref(),
        )?
    };
    let content = FileText::of(file, bytes).map_err(MeasurementError::Instrument)?;
    let (file, encoding) = content.map_or((file.to_owned(), "UTF-8"), |c| (c.file, c.encoding));
    let is_utf8 = encoding == "UTF-8";
    let encoding = if is_utf8 { String::new() } else { format!(" ({encoding})") };
    let summary = format!("{file}{encoding}: {}", counted(table.readings.len(), "reading"));
    let remarks = remarks(&summary, &table, false);
    Ok((table, remarks))
}

/// The table of a large measurement CSV, which we read in pieces. `None` for any other file.
fn large_csv(
    path: &Path,
    options: &ReadingOptions,
    spectra_only: bool,
) -> Result<Option<OfFile>, ReadingsError> {
    let is_csv = options.format.is_none_or(|format| format == ReadingFormat::Csv)
        && options.wavelengths_nm.is_none();
    if !is_csv || options.references.is_some() {
        return Ok(None);
    }
    let unreadable = |reason| FileError::reading(path, reason);
    let Some(large) = LargeCsv::open(path).map_err(unreadable)? else { return Ok(None) };
    let pigments = options.pigments.as_deref();
    let choice = LargeCsvChoice { scale: options.scale_choice(), pigments, spectra_only };
    let table = large.table(choice).map_err(|error| match error {
        LargeCsvError::System(reason) => unreadable(reason).into(),
        LargeCsvError::Measurement(error) => ReadingsError::Measurement(error),
    })?;
    let content = File::open(path).map_err(unreadable)?;
    let input = Input::of_reader(large.file(), content).map_err(unreadable)?;
    let summary = format!("{}: {}", large.file(), counted(table.readings.len(), "reading"));
    let remarks = remarks(&summary, &table, false);
    Ok(Some((table, input, remarks)))
}

/// Remarks about one file: `summary` with unit and grid, then the remarks of the table as warnings.
fn remarks(summary: &str, table: &MeasurementTable, were_counts: bool) -> Vec<Remark> {
    let unit = match table.scale {
        _ if were_counts => "counts, divided by the white",
        Scale::Percent => "percent",
        Scale::Fraction => "fractions",
    };
    let mut remarks = vec![Remark::note(format!("{summary} in {unit}, {}", table.grid))];
    remarks.extend(table.resampled_from.map(|count| {
        Remark::note(format!(
            "{count} irregular wavelengths brought to that grid by a cubic spline"
        ))
    }));
    remarks.extend(table.remarks.iter().map(|text| match text.split_once("; set [") {
        Some((warning, setting)) => Remark::warning(warning).with_hint(format!("set [{setting}")),
        None => Remark::warning(text),
    }));
    remarks
}

fn content(path: &Path) -> Result<(String, Vec<u8>), FileError> {
    Ok((path.display().to_string(), bytes_of(path)?))
}

/// Format of a measurement file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReadingFormat {
    /// The measurement CSV: columns `sample`, `film`, `backing`, one for each pigment, wavelengths.
    Csv,
    /// A file as an instrument writes it.
    Instrument(Format),
}

impl ReadingFormat {
    /// Name of the CSV among the formats.
    pub const CSV_NAME: &'static str = "csv";

    /// Names of all formats.
    pub fn names() -> impl Iterator<Item = &'static str> {
        std::iter::once(Self::CSV_NAME).chain(Format::ALL.into_iter().map(Format::name))
    }

    /// The format with this name, or `None` for an unknown name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        if name == Self::CSV_NAME {
            return Some(Self::Csv);
        }
        Format::named(name).map(Self::Instrument)
    }
}

/// Options of [`Readings::open_all`](crate::Readings::open_all). The defaults read every file as it describes itself.
#[derive(Debug, Clone, Default)]
pub struct ReadingOptions {
    /// Format of the files. Default: detected from the content of each.
    pub format: Option<ReadingFormat>,
    /// Percent or fraction. Default: what the file states, else what its largest value suggests.
    pub scale: ScaleChoice,
    /// Headings of the columns that are pigments. Default: every column of a CSV that is not known as
    /// something else and holds amounts.
    pub pigments: Option<Vec<String>>,
    /// Whether transmittance counts as reflectance, for spectrometers that measured in transmission
    /// mode over a white tile. Counts and powers of lamps never do.
    pub transmittance_is_reflectance: bool,
    /// Quantity of the values. Default: what the file states. Absorbance and K/S are turned into
    /// reflectance.
    pub values: Option<StatedValues>,
    /// Wavelengths in nm of files that hold values only ([`spectra::WavelengthList`]).
    pub wavelengths_nm: Option<Vec<f64>>,
    /// White, dark and tile with which counts are converted to reflectances. Default: the files hold
    /// reflectances.
    pub references: Option<ReferenceFiles>,
}

impl ReadingOptions {
    /// How values become fractions. An instrument's values are converted already.
    fn scale_choice(&self) -> ScaleChoice {
        match self.values {
            Some(StatedValues::Percent) => ScaleChoice::Known(Scale::Percent),
            Some(StatedValues::Fraction) => ScaleChoice::Known(Scale::Fraction),
            Some(values) if values.conversion().is_some() => ScaleChoice::Converted(values),
            _ => self.scale,
        }
    }
}

/// Measurement files that cannot be read.
#[derive(Debug, thiserror::Error, Explain)]
pub enum ReadingsError {
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// An instrument's file is faulty.
    #[error(transparent)]
    Instrument(#[from] InstrumentError),
    /// Readings are faulty or contradict each other.
    #[error(transparent)]
    Measurement(#[from] MeasurementError),
    /// The recipes are faulty or do not fit the readings.
    #[error(transparent)]
    Recipes(#[from] RecipesError),
    /// White, dark or tile cannot be read.
    #[error(transparent)]
    References(#[from] ReferenceFilesError),
    /// The reflectance of a sample cannot be computed from its counts and the white.
    #[error("{file}: cannot be divided by the white of {white}")]
    #[hint(inner)]
    Referencing {
        /// File of the samples.
        file: String,
        /// White as the caller named it.
        white: String,
        /// Reason with the wavelength.
        #[source]
        reason: ReferencingError,
    },
    /// A white is given, but the file is a measurement CSV, which holds reflectances.
    #[error("a white needs counts as an instrument writes them, found a CSV: `{0}`")]
    #[hint(
        "give the spectrometer's own file, or two columns `nm counts`, or leave out [white_reading]"
    )]
    #[fault(Setting)]
    CsvOfCounts(String),
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Instant;

    fn read(file: &str, text: &str, options: &ReadingOptions) -> Result<Readings, ReadingsError> {
        Readings::spectra_from_files(&[(file, text)], options)
    }

    #[test]
    fn many_samples_take_time_in_proportion() {
        let started = Instant::now();
        let count = 60_000;
        let rows: String = (0..count).map(|at| format!("a{at},0.1,0.2,0.3\n")).collect();
        let names: Vec<String> = (0..count).map(|at| format!("b{at}")).collect();
        let values = vec!["0.1"; count].join(",");
        let columns = format!("nm,{}\n400,{values}\n410,{values}\n420,{values}\n", names.join(","));
        for text in [format!("sample,400,410,420\n{rows}"), columns] {
            let found = read("f", &text, &ReadingOptions::default()).unwrap();
            assert_eq!(found.table.averaged().spectra.len(), count);
        }
        // Where every name is searched among all others, it takes more than a minute.
        assert!(started.elapsed().as_secs() < 20, "{:?}", started.elapsed());
    }

    #[test]
    fn what_the_values_are_may_be_stated() {
        let of = |values| ReadingOptions { values: Some(values), ..ReadingOptions::default() };
        let columns = "nm,Counts\n400,0.3\n500,0.3\n600,0.3\n700,0.3\n";
        let rows = "sample,400,500,600,700\nA,0.3,0.3,0.3,0.3\n";
        for (values, wanted) in [
            (StatedValues::Reflectance, 0.3),
            (StatedValues::Percent, 0.003),
            (StatedValues::Absorbance, 0.501_187),
            (StatedValues::KubelkaMunk, 0.469_338),
        ] {
            for text in [columns, rows] {
                let found = read("f.csv", text, &of(values)).unwrap();
                let value = found.table.readings[0].reflectance[1];
                assert!((value - wanted).abs() < 1e-6, "{values:?} {text}: {value}");
                let told = found.remarks.iter().any(|r| r.text.contains("is turned into"));
                assert_eq!(told, values.conversion().is_some(), "{:?}", found.remarks);
            }
        }
        for (text, words) in [(columns, "counts"), (rows, "CSV")] {
            let error = read("f.csv", text, &of(StatedValues::Counts)).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
    }

    #[test]
    fn values_without_wavelengths_take_those_that_you_state() {
        let nm = vec![400.0, 500.0, 600.0, 700.0];
        let options = ReadingOptions { wavelengths_nm: Some(nm), ..ReadingOptions::default() };
        let text = "\"Red\"\t10\t20\t60\t70\n\"Blue\"\t50\t40\t20\t10\n";
        let found = read("f.txt", text, &options).unwrap();
        assert_eq!(found.table.grid, spectra::Grid::from_nm(400.0, 100.0, 4).unwrap());
        assert_eq!(
            (found.table.readings[1].sample.as_str(), found.table.scale),
            ("Blue", Scale::Percent)
        );
        let own = read("f.csv", "sample,400,500,600,700\nA,1,2,3,4\n", &options).unwrap_err();
        assert!(own.to_string().contains("states its own wavelengths"), "{own}");
    }
}
