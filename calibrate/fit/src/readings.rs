//! Measurement files of any known format, read together, with the options and errors of reading them.

use std::fs::File;
use std::path::Path;

use documents::hint::Explain;
use documents::{counted, file::FileError};
use pigment::library::Input;
use pigment::remark::Remark;
use spectra::instrument::{FileText, Format, InstrumentError, InstrumentFile, bytes_of, read};
use spectra::referencing::{
    OpenedReferences, ReferenceFiles, ReferenceFilesError, ReferencingError, TileSource,
};

use crate::measurement::{
    LargeCsv, LargeCsvChoice, LargeCsvError, MeasurementError, MeasurementTable, Recipes,
    RecipesError, RecordChoice, Scale, ScaleChoice, begins_with_samples, is_measurement_csv,
    joined_over_files, split_by_file,
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
    let (table, remarks) = match instrument_file(file, bytes, options.format)? {
        Some(spectra) => instrument_table(file, spectra, options, references)?,
        None if references.is_some() => {
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
    format: Option<ReadingFormat>,
) -> Result<Option<InstrumentFile>, InstrumentError> {
    match format {
        Some(ReadingFormat::Csv) => return Ok(None),
        Some(ReadingFormat::Instrument(format)) => {
            return read(file, bytes, Some(format)).map(Some);
        }
        None => {}
    }
    let Some(content) = FileText::of(file, bytes)? else {
        return read(file, bytes, None).map(Some);
    };
    let text = &content.text;
    let known = if begins_with_samples(text) { None } else { Format::detect(file, text) };
    // If a table has no numbers below its headings, we do not read it as columns of numbers.
    let known = known.filter(|format| *format != Format::Columns || !is_measurement_csv(text));
    known.map(|_| read(file, bytes, None)).transpose()
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
        scale: options.scale,
        transmittance_is_reflectance: options.transmittance_is_reflectance,
    };
    let table = MeasurementTable::from_records(file, &content.spectra, choice)?;
    let count = table.readings.len();
    let spectra = if count == 1 { "spectrum" } else { "spectra" };
    let summary = format!("{file}: {}, {count} {spectra}", content.format.title());
    let remarks = remarks(&summary, &table);
    Ok((table, remarks))
}

fn csv_table(
    file: &str,
    bytes: &[u8],
    options: &ReadingOptions,
    spectra_only: bool,
) -> Result<(MeasurementTable, Vec<Remark>), MeasurementError> {
    let table = if spectra_only {
        MeasurementTable::spectra_from_csv(file, bytes, options.scale)?
    } else {
        MeasurementTable::from_csv_with(file, bytes, options.scale, options.pigments.as_deref())?
    };
    let content = FileText::of(file, bytes).map_err(MeasurementError::Instrument)?;
    let (file, encoding) = content.map_or((file.to_owned(), "UTF-8"), |c| (c.file, c.encoding));
    let is_utf8 = encoding == "UTF-8";
    let encoding = if is_utf8 { String::new() } else { format!(" ({encoding})") };
    let summary = format!("{file}{encoding}: {}", counted(table.readings.len(), "reading"));
    let remarks = remarks(&summary, &table);
    Ok((table, remarks))
}

/// The table of a large measurement CSV, which we read in pieces. `None` for any other file.
fn large_csv(
    path: &Path,
    options: &ReadingOptions,
    spectra_only: bool,
) -> Result<Option<OfFile>, ReadingsError> {
    let is_csv = options.format.is_none_or(|format| format == ReadingFormat::Csv);
    if !is_csv || options.references.is_some() {
        return Ok(None);
    }
    let unreadable = |reason| FileError::reading(path, reason);
    let Some(large) = LargeCsv::open(path).map_err(unreadable)? else { return Ok(None) };
    let pigments = options.pigments.as_deref();
    let choice = LargeCsvChoice { scale: options.scale, pigments, spectra_only };
    let table = large.table(choice).map_err(|error| match error {
        LargeCsvError::System(reason) => unreadable(reason).into(),
        LargeCsvError::Measurement(error) => ReadingsError::Measurement(error),
    })?;
    let content = File::open(path).map_err(unreadable)?;
    let input = Input::of_reader(large.file(), content).map_err(unreadable)?;
    let summary = format!("{}: {}", large.file(), counted(table.readings.len(), "reading"));
    let remarks = remarks(&summary, &table);
    Ok(Some((table, input, remarks)))
}

/// Remarks about one file: `summary` with unit and grid, then the remarks of the table as warnings.
fn remarks(summary: &str, table: &MeasurementTable) -> Vec<Remark> {
    let unit = match table.scale {
        Scale::Percent => "percent",
        Scale::Fraction => "fractions",
    };
    let mut remarks = vec![Remark::note(format!("{summary} in {unit}, {}", table.grid))];
    remarks.extend(table.resampled_from.map(|count| {
        Remark::note(format!(
            "{count} irregular wavelengths brought to that grid by a cubic spline"
        ))
    }));
    remarks.extend(table.remarks.iter().map(Remark::warning));
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
    /// White, dark and tile with which counts are converted to reflectances. Default: the files hold
    /// reflectances.
    pub references: Option<ReferenceFiles>,
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
