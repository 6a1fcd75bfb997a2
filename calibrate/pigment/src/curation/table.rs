//! A library as a table or as swatches.
//!
//! The CSV table of K and S has one row per curve, with the columns `pigment`, `quantity` and the
//! wavelengths in nm. You can also make swatches: the masstone of each pigment and its tints.

use documents::hint::Explain;
use documents::{from_spreadsheet_cell, name_violation, spreadsheet_cell};
use spectra::Grid;
use spectra::color::{Adaptation, ColorValues, Lab, adapt};
use spectra::csv_table::{CellPlace, CsvTableError, RowNumbers, wavelength_of_header};
use spectra::optics::Surface;
use spectra::swatch_file::{SwatchColor, SwatchEntry, SwatchFile, d50_white};

use super::change::CurationError;
use crate::evaluate::{Viewing, rounded};
use crate::library::{AmountKind, LibraryError, Pigment, PigmentLibrary};

/// Names of the curves in the order in which we write them. We use the last one for pigments with unknown
/// S.
const QUANTITIES: [&str; 5] =
    ["absorption", "scattering", "absorption_sd", "scattering_sd", "absorption_over_scattering"];

/// The properties of a library that a table of curves lacks.
#[derive(Debug, Clone, PartialEq)]
pub struct LibraryFrame {
    /// Title of the library.
    pub title: String,
    /// Licence of the values.
    pub licence: String,
    /// Source of the measurements.
    pub source: String,
    /// Whether K and S are relative to a white or per unit of amount.
    pub amounts: AmountKind,
    /// Name of the reference white. By default the only pigment with S = 1 at every wavelength.
    pub reference: Option<String>,
    /// Surface of the measured films.
    pub saunderson: Surface,
}

/// Writes the curves of `library`, with standard deviations where there are any.
///
/// # Panics
/// Never: writing to memory does not fail.
#[must_use]
pub fn to_csv(library: &PigmentLibrary) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header = vec!["pigment".to_owned(), "quantity".to_owned()];
    header.extend(library.grid.wavelengths_nm().map(|nm| nm.to_string()));
    writer.write_record(&header).expect("writing to memory does not fail");
    for pigment in &library.pigments {
        let Pigment { absorption, scattering, absorption_sd, scattering_sd, .. } = pigment;
        let pairs = absorption.iter().zip(scattering).filter(|_| !pigment.identified);
        let ratio: Vec<f64> = pairs.map(|(k, s)| rounded(k / s)).collect();
        // K/S alone says that S is unknown, K/S beside K and S that S is assumed.
        let curves = match pigment.identified || !scattering_sd.is_empty() {
            true => [absorption, scattering, absorption_sd, scattering_sd, &ratio],
            false => [&Vec::new(), &Vec::new(), &Vec::new(), &Vec::new(), &ratio],
        };
        for (quantity, curve) in QUANTITIES.iter().zip(curves).filter(|(_, c)| !c.is_empty()) {
            let name = spreadsheet_cell(&pigment.name).into_owned();
            let mut record = vec![name, (*quantity).to_owned()];
            record.extend(curve.iter().map(f64::to_string));
            writer.write_record(&record).expect("writing to memory does not fail");
        }
    }
    let bytes = writer.into_inner().expect("writing to memory does not fail");
    String::from_utf8(bytes).expect("records of text are valid UTF-8")
}

/// Reads a library from `text`, the content of `file`, in the form that [`to_csv`] writes. You may name the
/// quantities `K`, `S` and `K/S`. If you give only K/S of a pigment, its S is unknown. If you give K/S beside K and
/// S, its S is assumed.
///
/// # Errors
/// [`TableError`] with row and column.
pub fn from_csv(file: &str, text: &str, frame: LibraryFrame) -> Result<PigmentLibrary, TableError> {
    let text = text.trim_start_matches('\u{feff}');
    let mut reader =
        csv::ReaderBuilder::new().flexible(true).trim(csv::Trim::All).from_reader(text.as_bytes());
    let broken =
        |error: csv::Error| TableError::Syntax { file: file.to_owned(), reason: error.to_string() };
    let header = reader.headers().map_err(broken)?.clone();
    let (grid, columns) = grid(file, &header)?;
    let mut curves: Vec<(String, [Vec<f64>; 5])> = Vec::new();
    let mut numbers = RowNumbers::of(text.as_bytes());
    for record in reader.records() {
        let record = record.map_err(broken)?;
        let row = numbers.at(record.position().map_or(0, csv::Position::byte));
        if record.iter().all(str::is_empty) {
            continue;
        }
        if record.len() != header.len() {
            let wanted = header.len();
            let found = record.len();
            return Err(TableError::Sheet(CsvTableError::RowLength {
                file: file.to_owned(),
                row,
                wanted,
                found,
            }));
        }
        let wrong = |column: usize, wanted| {
            TableError::Sheet(CsvTableError::Cell {
                place: CellPlace::new(file, row, &header[column]),
                wanted,
                text: record[column].to_owned(),
            })
        };
        let name = from_spreadsheet_cell(&record[columns.0]);
        let quantity = &record[columns.1];
        if let Some(wanted) = name_violation(name) {
            return Err(wrong(columns.0, wanted));
        }
        let spelled = match quantity {
            "K" => "absorption",
            "S" => "scattering",
            "K/S" => "absorption_over_scattering",
            other => other,
        };
        let index = QUANTITIES.iter().position(|known| *known == spelled).ok_or_else(|| {
            wrong(columns.1, "absorption (K), scattering (S), either with _sd, or K/S")
        })?;
        let values = (0..header.len()).filter(|i| *i != columns.0 && *i != columns.1);
        let values = values
            .map(|column| {
                let value =
                    record[column].parse().ok().filter(|v: &f64| v.is_finite() && *v >= 0.0);
                value.map(rounded).ok_or_else(|| wrong(column, "a number of 0 and up"))
            })
            .collect::<Result<Vec<f64>, TableError>>()?;
        let at = curves.iter().position(|(known, _)| known == name).unwrap_or_else(|| {
            curves.push((name.to_owned(), Default::default()));
            curves.len() - 1
        });
        let curve = &mut curves[at].1[index];
        if !curve.is_empty() {
            return Err(wrong(columns.1, "one row for each pigment and quantity"));
        }
        *curve = values;
    }
    let pigments = curves.into_iter().map(|(name, curves)| pigment(file, name, curves));
    framed(file, grid, pigments.collect::<Result<_, _>>()?, frame)
}

/// Grid of the wavelength columns, and the columns of pigment and quantity.
fn grid(file: &str, header: &csv::StringRecord) -> Result<(Grid, (usize, usize)), TableError> {
    let columns = (column(file, header, "pigment")?, column(file, header, "quantity")?);
    let mut wavelengths = Vec::new();
    for (index, name) in header.iter().enumerate() {
        if index == columns.0 || index == columns.1 {
            continue;
        }
        let nm = wavelength_of_header(&name.to_ascii_lowercase());
        wavelengths.push(nm.ok_or_else(|| {
            TableError::Sheet(CsvTableError::Cell {
                place: CellPlace::new(file, 1, name),
                wanted: "a wavelength in nm",
                text: name.to_owned(),
            })
        })?);
    }
    let grid = Grid::through(&wavelengths);
    Ok((grid.ok_or_else(|| TableError::Irregular(file.to_owned()))?, columns))
}

fn column(
    file: &str,
    header: &csv::StringRecord,
    wanted: &'static str,
) -> Result<usize, TableError> {
    let found = header.iter().position(|name| name.eq_ignore_ascii_case(wanted));
    found.ok_or_else(|| {
        let file = file.to_owned();
        TableError::Sheet(CsvTableError::MissingColumn { file, row: 1, column: wanted })
    })
}

fn pigment(file: &str, name: String, curves: [Vec<f64>; 5]) -> Result<Pigment, TableError> {
    let [mut absorption, mut scattering, absorption_sd, scattering_sd, ratio] = curves;
    let identified = ratio.is_empty();
    let mut note = "only K/S is known; S is assumed";
    if !identified && absorption.is_empty() && scattering.is_empty() {
        scattering = vec![1.0; ratio.len()];
        absorption = ratio;
        note = "only K/S is known; S = 1 stands for an unknown scattering";
    }
    for (curve, quantity) in [(&absorption, QUANTITIES[0]), (&scattering, QUANTITIES[1])] {
        if curve.is_empty() {
            return Err(TableError::MissingCurve {
                file: file.to_owned(),
                pigment: name,
                quantity,
            });
        }
    }
    Ok(Pigment {
        name,
        color_index: None,
        absorption,
        scattering,
        absorption_sd,
        scattering_sd,
        identified,
        guessed: false,
        measured_amounts: None,
        notes: if identified { Vec::new() } else { vec![note.to_owned()] },
    })
}

fn framed(
    file: &str,
    grid: Grid,
    pigments: Vec<Pigment>,
    frame: LibraryFrame,
) -> Result<PigmentLibrary, TableError> {
    let whites: Vec<String> = (pigments.iter())
        .filter(|pigment| pigment.identified && pigment.scattering.iter().all(|s| *s == 1.0))
        .map(|pigment| pigment.name.clone())
        .collect();
    let mut library = PigmentLibrary {
        title: frame.title,
        licence: frame.licence,
        source: frame.source,
        grid,
        amounts: frame.amounts,
        reference: None,
        saunderson: frame.saunderson,
        unevenness: 0.0,
        inputs: Vec::new(),
        settings: None,
        pigments,
        evidence: None,
    };
    if library.pigments.is_empty() {
        return Err(TableError::Empty(file.to_owned()));
    }
    if frame.amounts == AmountKind::Absolute {
        return Ok(library);
    }
    library.reference = match (frame.reference, whites.as_slice()) {
        (Some(name), _) => {
            let id = library
                .find(&name)
                .map_err(|error| CurationError::Pigment(file.to_owned(), error))?;
            let name = library[id].name.clone();
            if !whites.contains(&name) {
                let relative = super::change::with_reference(file, &library, &name)?;
                return Ok(relative);
            }
            Some(name)
        }
        (None, [only]) => Some(only.clone()),
        (None, _) => return Err(TableError::NoReference { file: file.to_owned(), whites }),
    };
    // We read the JSON form back, to apply the checks of every library file.
    Ok(PigmentLibrary::from_json(file, &library.to_json())?)
}

/// Why a table of curves cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum TableError {
    /// A cell, row or column of the table is faulty.
    #[error(transparent)]
    #[hint(
        if matches!(
            _0,
            CsvTableError::MissingColumn { .. }
                | CsvTableError::Cell { place: CellPlace { row: 1, .. }, .. }
        ),
        "the columns are pigment, quantity, then wavelengths such as 400; `impasto library export` writes such a table with [to=csv]"
    )]
    #[hint(
        if matches!(_0, CsvTableError::RowLength { .. }),
        "numbers take a decimal point, not a comma"
    )]
    #[hint(none)]
    #[fault(Input)]
    Sheet(CsvTableError),
    /// The text is not valid CSV.
    #[error("{file}: {reason}")]
    Syntax {
        /// File name as the caller gave it.
        file: String,
        /// Message of the CSV parser.
        reason: String,
    },
    /// The wavelengths do not rise at a constant step.
    #[error("{0}, row 1: wavelengths must rise at a constant step")]
    #[hint("resample the curves to a regular grid first")]
    Irregular(String),
    /// A pigment lacks its K or S.
    #[error("{file}: pigment {pigment} has no row of `{quantity}`")]
    MissingCurve {
        /// File name as the caller gave it.
        file: String,
        /// Name of the pigment.
        pigment: String,
        /// Name of the missing curve.
        quantity: &'static str,
    },
    /// The table has no rows.
    #[error("{0}: the table holds no pigment")]
    Empty(String),
    /// None or several pigments have S = 1 at every wavelength.
    #[error("{file}: expected one pigment with S = 1 at every wavelength, found `{}`", whites.len())]
    #[hint(
        if whites.is_empty(),
        "name the white to scale by, [reference=WHITE], or set [amounts=absolute]"
    )]
    #[hint("name it, [reference=WHITE]: {}", whites.join(", "))]
    NoReference {
        /// File name as the caller gave it.
        file: String,
        /// Names of the pigments with S = 1.
        whites: Vec<String>,
    },
    /// The library cannot be scaled to the reference.
    #[error(transparent)]
    #[fault(Input)]
    Curation(#[from] CurationError),
    /// The values do not make a valid library.
    #[error(transparent)]
    Library(#[from] LibraryError),
}

/// Colour of an opaque film of one pigment, alone or with white.
#[derive(Debug, Clone, PartialEq)]
pub struct Swatch {
    /// Name of the pigment.
    pub pigment: String,
    /// Name of the swatch: the pigment's, followed by its ratio to white: `Viridian 1:4`.
    pub name: String,
    /// Measured reflectance on the library's grid, 0 to 1.
    pub reflectance: Vec<f64>,
    /// Its colour.
    pub color: ColorValues,
}

/// Colour space of a swatch in a palette file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SwatchSpace {
    /// sRGB, clipped to its gamut by the file.
    Srgb,
    /// CIELAB under D50, as in graphic arts. Adapted by Bradford's transform.
    LabD50,
}

/// Swatches of a library under one light.
#[derive(Debug, Clone, PartialEq)]
pub struct Swatches {
    /// Swatches in the order of the pigments. A masstone comes before its tints.
    pub swatches: Vec<Swatch>,
    title: String,
    white: spectra::color::Xyz,
    grouped: bool,
}

impl Swatches {
    /// The masstone of each pigment of `library`, followed by its tints with `tints` parts of
    /// the reference white. The white itself and pigments with unknown scattering have none.
    ///
    /// # Errors
    /// [`CurationError`] for tints without a reference white, or with parts outside 0 to 1e6.
    pub fn new(
        library: &PigmentLibrary,
        viewing: &Viewing,
        tints: &[f64],
    ) -> Result<Self, CurationError> {
        let white = library.reference_id();
        if !tints.is_empty() && (white.is_none() || library.amounts == AmountKind::Absolute) {
            return Err(CurationError::NoWhite);
        }
        if let Some(&parts) = tints.iter().find(|parts| !(**parts > 0.0 && **parts <= 1e6)) {
            return Err(CurationError::TintParts(parts));
        }
        let weights = viewing.weights(library.grid).expect("a method for the grid");
        let mut swatches = Vec::new();
        for id in library.ids() {
            let pigment = &library[id];
            let mut recipes = vec![(pigment.name.clone(), vec![(id, 1.0)])];
            if let Some(white) = white.filter(|&white| white != id && pigment.identified) {
                recipes.extend(tints.iter().map(|parts| {
                    (format!("{} 1:{parts}", pigment.name), vec![(id, 1.0), (white, *parts)])
                }));
            }
            for (name, recipe) in recipes {
                let mixture = library.mix(recipe).expect("pigments of the library");
                let reflectance = mixture.hiding(library.saunderson);
                let color = weights.color(&reflectance);
                swatches.push(Swatch { pigment: pigment.name.clone(), name, reflectance, color });
            }
        }
        let title = library.title.clone();
        let grouped = !tints.is_empty();
        Ok(Self { swatches, title, white: weights.white(), grouped })
    }

    /// Names of the swatches outside sRGB.
    #[must_use]
    pub fn outside_srgb(&self) -> Vec<&str> {
        let outside = self.swatches.iter().filter(|swatch| !swatch.color.srgb.in_gamut());
        outside.map(|swatch| swatch.name.as_str()).collect()
    }

    /// The swatches as a palette file, with a group for each pigment that has tints.
    #[must_use]
    pub fn palette(&self, space: SwatchSpace) -> SwatchFile {
        let swatches = self
            .swatches
            .iter()
            .map(|swatch| SwatchEntry {
                group: if self.grouped { swatch.pigment.clone() } else { String::new() },
                name: swatch.name.clone(),
                color: match space {
                    SwatchSpace::Srgb => SwatchColor::Rgb(swatch.color.srgb),
                    SwatchSpace::LabD50 => {
                        let d50 = d50_white();
                        let xyz = adapt(swatch.color.xyz, self.white, d50, Adaptation::Bradford);
                        SwatchColor::Lab(Lab::from_xyz(xyz, d50))
                    }
                },
            })
            .collect();
        SwatchFile { name: self.title.clone(), swatches }
    }
}
