//! The ground under a film as people write it: a number, a word, or a measured spectrum in a file.

use std::path::{Path, PathBuf};

use documents::file::{is_there, looks_like_path};
use documents::hint::Explain;
use documents::{name_list, request::RequestError};
use pigment::{Backing, Remark};
use spectra::instrument::split_file_and_name;
use spectra::{Reflectance, Spectrum, SpectrumError};

use crate::measurement::SpectrumNameError;
use crate::readings::{ReadingOptions, Readings, ReadingsError};

/// Maximum number of names that the hint lists, chosen by eye.
const LISTED: usize = 8;

/// Reads a ground: a reflectance from 0 to 1, `white`, `black`, or one spectrum of a file, for example
/// `paper.csv#White`. Remarks on the file are added to `remarks`, also if this fails later.
///
/// ```
/// use calibrate::{Backing, backing_from_text};
///
/// let mut remarks = Vec::new();
/// assert_eq!(backing_from_text("0.85", &mut remarks)?, Backing::Even(0.85));
/// let error = backing_from_text("bright", &mut remarks).unwrap_err();
/// assert!(error.to_string().ends_with("found `bright`"));
/// # Ok::<(), calibrate::BackingTextError>(())
/// ```
///
/// # Errors
/// [`BackingTextError`] for another text, and for a file with no spectrum or several.
pub fn backing_from_text(
    text: &str,
    remarks: &mut Vec<Remark>,
) -> Result<Backing, BackingTextError> {
    if let Ok(backing) = text.parse() {
        return Ok(backing);
    }
    let (file, name) = split_file_and_name(text);
    if !is_there(Path::new(file)) && !looks_like_path(text) {
        let reason = format!("takes 0 to 1, white, black or a file, found `{text}`");
        let hint = "try [over=0.85] or [over=paper.csv#SAMPLE]";
        return Err(BackingTextError::Text(RequestError::value(reason, hint)));
    }
    let readings = Readings::open_spectra(&[PathBuf::from(file)], &ReadingOptions::default());
    let readings = readings.map_err(Box::new)?;
    remarks.extend(readings.remarks);
    let averaged = readings.table.averaged();
    let selected = match name {
        Some(name) => averaged.find(name)?,
        None => averaged.spectra.iter().collect(),
    };
    let [spectrum] = selected[..] else {
        let names = selected.iter().map(|spectrum| spectrum.name.clone()).collect();
        return Err(BackingTextError::Several { file: file.to_owned(), names });
    };
    let reflectance = spectrum.reflectance.clone();
    Ok(Backing::Measured(Spectrum::<Reflectance>::new(averaged.grid, reflectance)?))
}

/// A text that gives no ground.
#[derive(Debug, thiserror::Error, Explain)]
pub enum BackingTextError {
    /// The text is neither a reflectance nor the name of an existing file.
    #[error("a ground {0}")]
    #[hint(inner)]
    Text(#[source] RequestError),
    /// A file has no spectrum, or several.
    #[error("{file}: expected one spectrum of a ground, found `{}`", names.len())]
    #[hint("select one by [over=\"{file}#NAME\"], with NAME {}", listed(names))]
    Several {
        /// Path of the file.
        file: String,
        /// Names of its spectra.
        names: Vec<String>,
    },
    /// The file cannot be read.
    #[error(transparent)]
    Readings(#[from] Box<ReadingsError>),
    /// No spectrum of the file has this name.
    #[error(transparent)]
    Name(#[from] SpectrumNameError),
    /// The spectrum is faulty.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
}

fn listed(names: &[String]) -> String {
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    name_list(&names, LISTED, " or ")
}
