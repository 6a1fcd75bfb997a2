//! The ground under a film: a grey, or a measured spectrum.

use calibrate::Backing;
use spectra::{Reflectance, Spectrum};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::named_spectra::{Chosen, chosen, first_few};
use crate::readings::ReadingOptions;

/// The ground that `--over` names: a number, a word, or a spectrum of a file.
pub(crate) fn ground(text: &str, console: &mut Console<'_>) -> Result<Backing> {
    if let Ok(even) = text.parse() {
        return Ok(even);
    }
    let Some(Chosen { file, grid, spectra }) = chosen(text, &ReadingOptions::default(), console)?
    else {
        return Err(Failure::usage(
            format!("--over takes 0 to 1, white, black or a file that exists, found `{text}`"),
            "try --over 0.85 or --over paper.csv#SAMPLE",
        ));
    };
    let [one] = spectra.as_slice() else {
        let names: Vec<&str> = spectra.iter().map(|one| one.name.as_str()).collect();
        return Err(Failure::data(
            format!("{file}: one ground is wanted, found `{}` spectra", names.len()),
            format!("name one: --over \"{file}#NAME\", with NAME {}", first_few(&names, " or ")),
        ));
    };
    let spectrum = Spectrum::<Reflectance>::new(grid, one.reflectance.clone())?;
    Ok(Backing::Measured(spectrum))
}
