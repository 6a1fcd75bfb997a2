//! Spectra of a measurement file that an option names as `FILE` or `FILE#NAME`.

use std::path::{Path, PathBuf};

use calibrate::measurement::AveragedSpectra;
use documents::file::is_there;
use spectra::instrument::split_file_and_name;

use crate::console::Console;
use crate::failure::Result;
use crate::readings::{ReadingOptions, spectra};

/// Spectra of one file.
pub(crate) struct SelectedSpectra {
    /// Path of the file.
    pub(crate) file: String,
    /// One or more spectra, in the order of the file.
    pub(crate) averaged: AveragedSpectra,
}

/// Reads the spectra that `text` selects: all of `FILE`, or those of `FILE#NAME`. Returns `None` if
/// there is no such file.
pub(crate) fn select_spectra(
    text: &str,
    reading: &ReadingOptions,
    console: &mut Console<'_>,
) -> Result<Option<SelectedSpectra>> {
    let (file, name) = split_file_and_name(text);
    if !is_there(Path::new(file)) {
        return Ok(None);
    }
    let mut averaged = spectra(&[PathBuf::from(file)], reading, console)?.averaged();
    if let Some(name) = name {
        averaged.spectra = averaged.find(name)?.into_iter().cloned().collect();
    }
    Ok(Some(SelectedSpectra { file: file.to_owned(), averaged }))
}
