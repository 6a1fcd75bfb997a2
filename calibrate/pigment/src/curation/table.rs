//! K and S as a CSV: one row a curve, columns `pigment`, `quantity` and the
//! wavelengths in nm.

use spectra::Grid;
use spectra::csv_table::{CellPlace, CsvTableError, wavelength_of_header};
use spectra::optics::Surface;

use super::error::CurationError;
use crate::digits::rounded;
use crate::library::{AmountKind, LibraryError, Pigment, PigmentLibrary};

/// The names of the curves, in the order in which they are written; the last is
/// all that is known of a pigment whose S was not identified.
const QUANTITIES: [&str; 5] =
    ["absorption", "scattering", "absorption_sd", "scattering_sd", "absorption_over_scattering"];

/// What a library says of its pigments, and no table of curves does.
#[derive(Debug, Clone, PartialEq)]
pub struct LibraryFrame {
    /// What the library is.
    pub title: String,
    /// Licence of the figures.
    pub licence: String,
    /// Where they come from.
    pub source: String,
    /// Whether K and S are relative to a white.
    pub amounts: AmountKind,
    /// The white; if not told, the only pigment whose S is 1 throughout.
    pub reference: Option<String>,
    /// The surface of the measured films.
    pub saunderson: Surface,
}

/// The curves of `library`; deviations where there are any.
///
/// # Panics
/// Never: memory takes what is written.
#[must_use]
pub fn to_csv(library: &PigmentLibrary) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header = vec!["pigment".to_owned(), "quantity".to_owned()];
    header.extend(library.grid.wavelengths_nm().map(|nm| nm.to_string()));
    writer.write_record(&header).expect("memory takes a record");
    for pigment in &library.pigments {
        let ratio = || pigment.absorption.iter().zip(&pigment.scattering).map(|(k, s)| k / s);
        let curves = if pigment.identified {
            let (k, s) = (pigment.absorption.clone(), pigment.scattering.clone());
            [k, s, pigment.absorption_sd.clone(), pigment.scattering_sd.clone(), Vec::new()]
        } else {
            [vec![], vec![], vec![], vec![], ratio().map(rounded).collect()]
        };
        for (quantity, curve) in QUANTITIES.iter().zip(curves).filter(|(_, c)| !c.is_empty()) {
            let mut record = vec![pigment.name.clone(), (*quantity).to_owned()];
            record.extend(curve.iter().map(f64::to_string));
            writer.write_record(&record).expect("memory takes a record");
        }
    }
    let bytes = writer.into_inner().expect("memory takes all records");
    String::from_utf8(bytes).expect("records of text are text")
}

/// The library whose curves stand in `text`, the content of `file`, as
/// [`to_csv`] writes them; `K`, `S` and `K/S` are read for the words. A pigment of
/// which only K/S stands there is one whose S is not known.
///
/// # Errors
/// [`TableError`], with row and column.
pub fn from_csv(file: &str, text: &str, frame: LibraryFrame) -> Result<PigmentLibrary, TableError> {
    let text = text.trim_start_matches('\u{feff}');
    let mut reader =
        csv::ReaderBuilder::new().flexible(true).trim(csv::Trim::All).from_reader(text.as_bytes());
    let broken =
        |error: csv::Error| TableError::Syntax { file: file.to_owned(), reason: error.to_string() };
    let header = reader.headers().map_err(broken)?.clone();
    let (grid, columns) = grid(file, &header)?;
    let mut curves: Vec<(String, [Vec<f64>; 5])> = Vec::new();
    for record in reader.records() {
        let record = record.map_err(broken)?;
        let row = record.position().map_or(0, csv::Position::line);
        if record.iter().all(str::is_empty) {
            continue;
        }
        if record.len() != header.len() {
            let (wanted, found) = (header.len(), record.len());
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
        let (name, quantity) = (&record[columns.0], &record[columns.1]);
        if name.is_empty() || name.contains(char::is_control) {
            return Err(wrong(columns.0, "a pigment's name"));
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

/// The grid, and the columns of pigment and quantity.
fn grid(file: &str, header: &csv::StringRecord) -> Result<(Grid, (usize, usize)), TableError> {
    let column = |wanted: &'static str| {
        let found = header.iter().position(|name| name.eq_ignore_ascii_case(wanted));
        found.ok_or_else(|| {
            TableError::Sheet(CsvTableError::MissingColumn {
                file: file.to_owned(),
                column: wanted,
            })
        })
    };
    let columns = (column("pigment")?, column("quantity")?);
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
    Ok((grid.ok_or_else(|| TableError::Irregular { file: file.to_owned() })?, columns))
}

fn pigment(file: &str, name: String, curves: [Vec<f64>; 5]) -> Result<Pigment, TableError> {
    let [mut absorption, mut scattering, absorption_sd, scattering_sd, ratio] = curves;
    let identified = !(absorption.is_empty() && scattering.is_empty() && !ratio.is_empty());
    if !identified {
        scattering = vec![1.0; ratio.len()];
        absorption = ratio;
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
        notes: if identified {
            Vec::new()
        } else {
            vec!["only K/S is known; S = 1 stands for an unknown scattering".to_owned()]
        },
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
        return Err(TableError::Empty { file: file.to_owned() });
    }
    if frame.amounts == AmountKind::Absolute {
        return Ok(library);
    }
    library.reference = match (frame.reference, whites.as_slice()) {
        (Some(name), _) => {
            let index = library
                .find(&name)
                .map_err(|error| CurationError::Pigment { file: file.to_owned(), error })?;
            let name = library.pigments[index].name.clone();
            if !whites.contains(&name) {
                let relative = super::rescale::with_reference(file, &library, &name)?;
                return Ok(relative);
            }
            Some(name)
        }
        (None, [only]) => Some(only.clone()),
        (None, _) => return Err(TableError::NoReference { file: file.to_owned(), whites }),
    };
    // What comes from a program's own file has been checked the same way.
    Ok(PigmentLibrary::from_json(file, &library.to_json())?)
}

/// Why a table of curves cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TableError {
    /// The sheet is faulty.
    #[error(transparent)]
    Sheet(CsvTableError),
    /// No CSV.
    #[error("{file}: {reason}")]
    Syntax {
        /// The file.
        file: String,
        /// What the parser said.
        reason: String,
    },
    /// Wavelengths at no constant step.
    #[error("{file}, row 1: wavelengths must rise at a constant step")]
    Irregular {
        /// The file.
        file: String,
    },
    /// A pigment without K or S.
    #[error("{file}: pigment {pigment} has no row of `{quantity}`")]
    MissingCurve {
        /// The file.
        file: String,
        /// The pigment.
        pigment: String,
        /// What it lacks.
        quantity: &'static str,
    },
    /// No rows.
    #[error("{file}: the table holds no pigment")]
    Empty {
        /// The file.
        file: String,
    },
    /// No pigment, or several, with S = 1.
    #[error("{file}: one pigment with S = 1 at every wavelength is wanted, found `{}`", whites.len())]
    NoReference {
        /// The file.
        file: String,
        /// Those with S = 1.
        whites: Vec<String>,
    },
    /// Scaling to the reference.
    #[error(transparent)]
    Curation(#[from] CurationError),
    /// No library.
    #[error(transparent)]
    Library(#[from] LibraryError),
}

impl TableError {
    /// What to try, where there is something.
    #[must_use]
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::Sheet(CsvTableError::MissingColumn { .. } | CsvTableError::Cell { place: CellPlace { row: 1, .. }, .. }) => {
                "the columns are pigment, quantity, then wavelengths such as 400; `library export --to csv` writes one".into()
            }
            Self::Irregular { .. } => "resample the curves to a regular grid first".into(),
            Self::Sheet(CsvTableError::RowLength { .. }) => "numbers take a decimal point, not a comma".into(),
            Self::NoReference { whites, .. } if whites.is_empty() => {
                "name the white to scale by, --reference WHITE, or say --amounts absolute".into()
            }
            Self::NoReference { whites, .. } => {
                format!("name it, --reference WHITE: {}", whites.join(", "))
            }
            Self::Curation(error) => return error.hint(),
            _ => return None,
        })
    }
}
