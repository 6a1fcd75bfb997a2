//! Target colours: `#rrggbb`, CIELAB, or measured spectra.

use calibrate::matching::ColorTarget;
use calibrate::measurement::{AveragedSpectra, AveragedSpectrum, Film};
use documents::counted_as;
use spectra::{Reflectance, Spectrum};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::input::remark_coverage;
use crate::readings::ReadingOptions;
use crate::selected_spectra::{SelectedSpectra, select_spectra};

/// Parses a target: one colour as `#rrggbb` or `L,a,b`, or the spectra of `FILE` or `FILE#SAMPLE`.
pub(crate) fn targets(
    text: &str,
    reading: &ReadingOptions,
    console: &mut Console<'_>,
) -> Result<Vec<ColorTarget>> {
    if let Some(selected) = select_spectra(text, reading, console)? {
        return measured(selected, console);
    }
    let target = text.parse().map_err(|_| {
        Failure::usage(
            format!("a target takes #rrggbb, L,a,b or an existing file of spectra, found `{text}`"),
            "try \"#4a7d8c\", 52,-10.5,8 or swatches.csv#NAME",
        )
    })?;
    Ok(vec![target])
}

/// Makes targets of the spectra of paint in `selected`. Spectra of bare cards are skipped unless
/// nothing else was selected.
fn measured(selected: SelectedSpectra, console: &mut Console<'_>) -> Result<Vec<ColorTarget>> {
    let SelectedSpectra { file, averaged: AveragedSpectra { grid, mut spectra } } = selected;
    remark_coverage(grid, console)?;
    let count = spectra.len();
    if spectra.iter().any(|spectrum| spectrum.film == Film::Paint) {
        spectra.retain(|spectrum| spectrum.film == Film::Paint);
    }
    if spectra.len() < count {
        let bare = count - spectra.len();
        console.remark(format!(
            "{file}: skipped {} only if selected by name",
            counted_as(bare, "bare card, which is a target", "bare cards, which are targets")
        ))?;
    }
    spectra
        .into_iter()
        .map(|spectrum: AveragedSpectrum| {
            let reflectance = Spectrum::<Reflectance>::new(grid, spectrum.reflectance)?;
            Ok(ColorTarget::measured(spectrum.name, reflectance))
        })
        .collect()
}
