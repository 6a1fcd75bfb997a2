//! The option `--over`: the ground under a film, a grey or a measured spectrum.

use calibrate::Backing;
use documents::name_list;
use spectra::{Reflectance, Spectrum};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::readings::ReadingOptions;
use crate::selected_spectra::{SelectedSpectra, select_spectra};

/// Maximum number of names that the hint lists; chosen by eye.
const LISTED: usize = 8;

/// Parses `--over`: a reflectance from 0 to 1, `white`, `black`, or one spectrum of a file.
pub(crate) fn ground(text: &str, console: &mut Console<'_>) -> Result<Backing> {
    if let Ok(backing) = text.parse() {
        return Ok(backing);
    }
    let selected = select_spectra(text, &ReadingOptions::default(), console)?;
    let Some(SelectedSpectra { file, averaged }) = selected else {
        return Err(Failure::usage(
            format!("--over takes 0 to 1, white, black or an existing file, found `{text}`"),
            "try --over 0.85 or --over paper.csv#SAMPLE",
        ));
    };
    let [spectrum] = averaged.spectra.as_slice() else {
        let names: Vec<&str> = averaged.spectra.iter().map(|s| s.name.as_str()).collect();
        return Err(Failure::data(
            format!("{file}: expected one spectrum of a ground, found `{}`", names.len()),
            format!(
                "select one by --over \"{file}#NAME\", with NAME {}",
                name_list(&names, LISTED, " or ")
            ),
        ));
    };
    Ok(Backing::Measured(Spectrum::<Reflectance>::new(
        averaged.grid,
        spectrum.reflectance.clone(),
    )?))
}
