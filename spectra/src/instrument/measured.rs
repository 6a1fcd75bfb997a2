//! One spectrum from an instrument's file, how you choose one by name, and errors that name their
//! place in the file.

use std::collections::BTreeSet;
use std::path::Path;

use documents::file::disk::is_file;
use documents::hint::Explain;

use super::quantity::MeasuredQuantity;
use crate::grid::Grid;
use crate::spectrum::{
    IrregularSpectrum, IrregularSpectrumError, Reflectance, Spectrum, SpectrumError,
};

/// The unit of the values of a [`MeasuredSpectrum`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Percent: white is near 100.
    Percent,
    /// A fraction: white is near 1.
    Fraction,
    /// Another unit, or none stated.
    Unstated,
}

/// The role of a spectrum in its file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The spectrum for which the file was written.
    Main,
    /// Counts of the sample, from which the main spectrum was computed.
    Sample,
    /// Counts of the white reference.
    White,
    /// Counts without light.
    Dark,
}

/// One spectrum as its file contains it.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSpectrum {
    /// Name of the sample in the file. If it has none, we make one from its place in the file.
    pub name: String,
    /// The quantity that was measured.
    pub quantity: MeasuredQuantity,
    /// The role of the spectrum in the file.
    pub role: Role,
    /// Unit of `values`.
    pub unit: Unit,
    /// Wavelengths in nm, strictly rising, at least one.
    pub wavelengths_nm: Vec<f64>,
    /// One finite value for each wavelength, as written in the file.
    pub values: Vec<f64>,
    /// Number of the line on which the spectrum begins, from 1.
    pub line: usize,
    /// Number of the line of each value. Empty if we do not keep them, e.g. if one line holds all values.
    pub point_lines: Vec<usize>,
    /// Other facts that the file states about the spectrum, e.g. geometry, instrument or integration time:
    /// pairs of keyword and text in the order of the file.
    pub details: Vec<(String, String)>,
    /// Assumptions and corrections made in reading the spectrum, as messages for the user.
    pub remarks: Vec<String>,
}

impl MeasuredSpectrum {
    /// Number of the line of the value at `nm`, from 1.
    #[must_use]
    pub fn line_at(&self, nm: f64) -> usize {
        let index = self.wavelengths_nm.iter().position(|own| *own == nm);
        index.and_then(|index| self.point_lines.get(index)).copied().unwrap_or(self.line)
    }

    /// Whether the values are in percent. If the file does not state this, they are when any
    /// exceeds 2.
    #[must_use]
    pub fn is_percent(&self) -> bool {
        match self.unit {
            Unit::Percent => true,
            Unit::Fraction => false,
            Unit::Unstated => self.values.iter().any(|&value| value > 2.0),
        }
    }

    /// Whether the values are relative to a white. We see this from their unit or from a white
    /// reading in the file, even if the file does not name the quantity.
    #[must_use]
    pub fn is_relative_to_white(&self) -> bool {
        self.unit != Unit::Unstated
            || self.details.iter().any(|(key, value): &(String, String)| {
                key == "Reference Spectrum Present" && value.starts_with("Yes")
            })
    }

    /// The reflectance as a fraction on a regular grid ([`Grid::suited_to`] the wavelengths). This
    /// interpolates irregular wavelengths by a spline.
    ///
    /// # Errors
    /// [`ReflectanceError`] if the spectrum is another quantity, or has a value outside 0 to 2.
    pub fn reflectance(&self) -> Result<Spectrum<Reflectance>, ReflectanceError> {
        use MeasuredQuantity::{Reflectance, Unstated};
        if !matches!(self.quantity, Reflectance | Unstated) {
            return Err(ReflectanceError::Quantity {
                name: self.name.clone(),
                found: self.quantity,
            });
        }
        let scale = if self.is_percent() { 0.01 } else { 1.0 };
        let values = self.values.iter().map(|value| value * scale).collect();
        let irregular = IrregularSpectrum::new(self.wavelengths_nm.clone(), values)
            .map_err(|reason| ReflectanceError::Wavelengths(self.name.clone(), reason))?;
        let grid = Grid::suited_to(&self.wavelengths_nm)
            .expect("an irregular spectrum has rising wavelengths");
        Spectrum::new(grid, irregular.on_grid(grid))
            .map_err(|reason| ReflectanceError::Values(self.name.clone(), reason))
    }
}

/// A measured spectrum that is not a reflectance.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ReflectanceError {
    /// The spectrum is another quantity.
    #[error("`{name}` must be a reflectance, found `{found}`")]
    #[hint(if *found == MeasuredQuantity::Counts, "reference counts to a white and a dark reading first")]
    #[hint(
        if *found == MeasuredQuantity::Power,
        "the light of a lamp is not a reflectance; it can be the light under which colours are seen"
    )]
    #[hint("export the spectrum as reflectance")]
    Quantity {
        /// Name of the spectrum.
        name: String,
        /// The quantity that the file states.
        found: MeasuredQuantity,
    },
    /// A value is outside 0 to 2.
    #[error("`{0}` has a value that is not a reflectance")]
    Values(String, #[source] SpectrumError),
    /// The wavelengths do not rise, or there is not one for each value.
    #[error("`{0}` is not a spectrum")]
    Wavelengths(String, #[source] IrregularSpectrumError),
}

/// Makes a name for a spectrum without one: the file name without folder and extension.
pub(super) fn stem(file: &str) -> String {
    let path = Path::new(file);
    path.file_stem().map_or_else(|| file.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// Which of `names`, the headings of columns or the names of rows, hold the standard deviations or errors of
/// others: `std` beside `mean`, or `Red std` beside `Red` or `Red mean`.
#[must_use]
pub fn deviations(names: &[&str]) -> Vec<bool> {
    let is_deviation =
        |word: &String| MeasuredQuantity::of_words(word) == MeasuredQuantity::Deviation;
    let all_words = names.iter().map(|name: &&str| {
        let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
        words.map(str::to_lowercase).collect()
    });
    let all_words: Vec<Vec<String>> = all_words.collect();
    let without = |words: &[String], left_out: &[&str]| -> Vec<String> {
        let kept = words.iter().filter(|word| !left_out.contains(&word.as_str()));
        kept.filter(|word| !is_deviation(word)).cloned().collect()
    };
    let means = all_words.iter().filter(|words| !words.is_empty());
    let means = means.filter(|words| !words.iter().any(is_deviation));
    let means: BTreeSet<Vec<String>> =
        means.map(|words| without(words, &["mean", "avg", "average"])).collect();
    let are_deviations = all_words.iter().map(|words| {
        words.iter().any(is_deviation) && means.contains(&without(words, &["standard"]))
    });
    are_deviations.collect()
}

/// Maximum number of names listed in an error.
const LISTED: usize = 8;

/// Splits `FILE#NAME` into file and name. A plain `FILE` has the name `None`. This does not split
/// the text if a file has the whole of it as path.
#[must_use]
pub fn split_file_and_name(text: &str) -> (&str, Option<&str>) {
    match text.rsplit_once('#') {
        Some((file, name)) if !is_file(Path::new(text)) => (file, Some(name)),
        _ => (text, None),
    }
}

/// Selects the spectrum called `name` from `spectra`, the content of `file`. If you pass no name,
/// you get the only main spectrum ([`Role::Main`]), or the only spectrum if there is no main one.
///
/// # Errors
/// [`ChoiceError`] if no spectrum or more than one qualifies.
pub fn choose_spectrum<'a>(
    file: &str,
    spectra: &'a [MeasuredSpectrum],
    name: Option<&str>,
) -> Result<&'a MeasuredSpectrum, ChoiceError> {
    let has_main = spectra.iter().any(|spectrum| spectrum.role == Role::Main);
    let found: Vec<&MeasuredSpectrum> = spectra
        .iter()
        .filter(|spectrum| match name {
            Some(name) => is_called(spectrum, file, spectra, name),
            None => spectrum.role == Role::Main || !has_main,
        })
        .collect();
    let file = file.to_owned();
    match (found.as_slice(), name) {
        ([one], _) => Ok(one),
        ([], Some(name)) => {
            Err(ChoiceError::Unknown { file, name: name.to_owned(), names: names(spectra.iter()) })
        }
        _ => {
            let names = names(found.iter().copied());
            Err(ChoiceError::Several { file, count: found.len(), names })
        }
    }
}

/// Whether `spectrum` has this name. A number selects the spectrum that we named by its column in a file
/// without headings.
fn is_called(
    spectrum: &MeasuredSpectrum,
    file: &str,
    spectra: &[MeasuredSpectrum],
    name: &str,
) -> bool {
    if name.parse::<usize>().is_err() || spectra.iter().any(|other| other.name == name) {
        return spectrum.name == name;
    }
    spectrum.name == format!("{} {name}", stem(file))
}

fn names<'a>(spectra: impl Iterator<Item = &'a MeasuredSpectrum>) -> Vec<String> {
    spectra.take(LISTED).map(|spectrum| spectrum.name.clone()).collect()
}

/// The selection does not fit exactly one spectrum.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ChoiceError {
    /// No spectrum has the name.
    #[error("{file}: no spectrum is called `{name}`")]
    #[hint(verbatim, "spectra: {}", names.join(", "))]
    Unknown {
        /// Path of the file.
        file: String,
        /// The name that was given.
        name: String,
        /// Names of the first few spectra of the file.
        names: Vec<String>,
    },
    /// Several spectra qualify and no name was given, or they share the name.
    #[error("{file}: expected one spectrum, found `{count}`")]
    #[hint(verbatim, "name one: \"{file}#{}\"", names.join("\" or \"#"))]
    Several {
        /// Path of the file.
        file: String,
        /// Number of spectra that qualify.
        count: usize,
        /// Names of the first few of them.
        names: Vec<String>,
    },
}

/// We cannot read an instrument's file. Every variant names the file, and the line where possible.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum InstrumentError {
    /// The content matches none of the formats in `Format`.
    #[error("{0}: no known format of an instrument")]
    #[hint("name the format with [format], or save as CSV: a column `sample`, then wavelengths")]
    Unrecognised(String),
    /// We know the format of the file but do not read it.
    #[error("{file}: this is {kind}, which is not read")]
    #[hint("{way}")]
    NotRead {
        /// Path of the file.
        file: String,
        /// The kind of file with its article, e.g. `a PDF file`.
        kind: &'static str,
        /// Advice on how you get a file that we read.
        way: &'static str,
    },
    /// A binary file, or a part of it, does not follow its format.
    #[error("{file}: faulty {format} file: {fault}")]
    #[hint("the file may be cut off: copy it again, or export text from the instrument's program")]
    Faulty {
        /// Path of the file.
        file: String,
        /// Name of the format in which we read it.
        format: &'static str,
        /// The fault, and its place in the file.
        fault: String,
    },
    /// The file contains no spectrum.
    #[error("{file}: no spectrum in this {format} file")]
    #[hint("check that the export holds spectra, or name the format with [format]")]
    Empty {
        /// Path of the file.
        file: String,
        /// Name of the format in which we read it.
        format: &'static str,
    },
    /// A workbook has no sheet of the wanted name.
    #[error("{file}: no sheet is called `{sheet}`; its sheets are {sheets}")]
    #[hint("name the sheet as the workbook does: FILE.xlsx#SHEET")]
    NoSheet {
        /// Path of the workbook.
        file: String,
        /// The wanted name.
        sheet: String,
        /// Names of the sheets that are not empty.
        sheets: String,
    },
    /// A workbook would take more memory than any table of spectra does.
    #[error("{file}: {what} takes more than {most_mb} MB")]
    #[hint("save the sheet that holds the spectra as CSV, without texts of other kinds")]
    TooLarge {
        /// Path of the file.
        file: String,
        /// The part that is too large.
        what: String,
        /// The limit in MB.
        most_mb: usize,
    },
    /// A line does not follow the format.
    #[error("{file}, line {line}: expected {expected}, found `{text}`")]
    Line {
        /// Path of the file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// Description of the expected content.
        expected: &'static str,
        /// The content of the line or cell, shortened to 60 characters.
        text: String,
    },
    /// A wavelength occurs twice in one spectrum.
    #[error("{file}, line {line}: the wavelength {nm} nm occurs twice, first in line {first}")]
    #[hint("remove one of the two")]
    Duplicate {
        /// Path of the file.
        file: String,
        /// Line number of the second occurrence, from 1.
        line: usize,
        /// The wavelength in nm.
        nm: f64,
        /// Line number of the first occurrence.
        first: usize,
    },
    /// A wavelength occurs more than once, with values too different to be averaged.
    #[error(
        "{file}, line {line}: {nm} nm occurs more than once, with different values from {least} to `{most}`"
    )]
    #[hint("remove the wrong one; nearly equal values would be averaged")]
    Unlike {
        /// Path of the file.
        file: String,
        /// Line number of the last occurrence, from 1.
        line: usize,
        /// The wavelength in nm.
        nm: f64,
        /// Smallest value at the wavelength.
        least: f64,
        /// Largest value at the wavelength.
        most: f64,
    },
    /// The wavelengths neither rise nor fall throughout.
    #[error("{file}, line {line}: wavelengths must rise or fall throughout, found `{nm}` nm")]
    Order {
        /// Path of the file.
        file: String,
        /// Line number of the first wavelength against the direction, from 1.
        line: usize,
        /// That wavelength in nm.
        nm: f64,
    },
    /// The number of values differs from the number of stated wavelengths.
    #[error(
        "{file}, line {line}: one value is needed for each of {wanted} wavelengths, found `{found}`"
    )]
    #[hint("name the wavelengths of these values with [wavelengths=380..730:10] or a file of them")]
    ValuesForWavelengths {
        /// Path of the file.
        file: String,
        /// Line number of the values, from 1.
        line: usize,
        /// Number of wavelengths.
        wanted: usize,
        /// Number of values.
        found: usize,
    },
    /// The first column may hold wavelengths or wavenumbers.
    #[error(
        "{file}, line {line}: the first column runs from {from} to `{to}` and does not say whether these are nm or waves per cm"
    )]
    #[hint("write `nm` or `cm-1` in a line above the first column")]
    AxisUnit {
        /// Path of the file.
        file: String,
        /// Line number of the first row, from 1.
        line: usize,
        /// Smallest number of the column.
        from: f64,
        /// Largest number of the column.
        to: f64,
    },
    /// The wavelengths of a spectrum are not given.
    #[error(
        "{file}, line {line}: {element} has no {missing}, and neither has the specification `{specification}`"
    )]
    #[hint(
        "export the file with its colour specifications, or save as CSV: a column `sample`, then wavelengths"
    )]
    Incomplete {
        /// Path of the file.
        file: String,
        /// Line number of the spectrum, from 1.
        line: usize,
        /// XML element of the spectrum.
        element: String,
        /// The missing attribute.
        missing: &'static str,
        /// The colour specification that the spectrum refers to.
        specification: String,
    },
    /// The number of values differs from the number stated in the file.
    #[error("{file}, line {line}: the file states {expected} {what}, found `{found}`")]
    #[hint("the file may be cut off; export it again")]
    Count {
        /// Path of the file.
        file: String,
        /// Line number of the last value, from 1.
        line: usize,
        /// The things that are counted, in the plural.
        what: &'static str,
        /// The stated number.
        expected: usize,
        /// The number found.
        found: usize,
    },
}

impl InstrumentError {
    /// An error for a line that does not follow the format. This shortens the text and makes it
    /// printable.
    pub(super) fn line(file: &str, line: usize, expected: &'static str, text: &str) -> Self {
        Self::Line { file: file.to_owned(), line, expected, text: documents::excerpt(text) }
    }

    pub(super) fn too_large(file: &str, what: impl Into<String>, most_mb: usize) -> Self {
        Self::TooLarge { file: file.to_owned(), what: what.into(), most_mb }
    }

    pub(super) fn faulty(file: &str, format: &'static str, fault: impl Into<String>) -> Self {
        Self::Faulty { file: file.to_owned(), format, fault: fault.into() }
    }
}
