//! Target colours: `#rrggbb`, CIELAB, or measured spectra.

use calibrate::matching::ColorTarget;
use calibrate::measurement::Film;
use spectra::{Reflectance, Spectrum};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::input::remark_coverage;
use crate::named_spectra::{Chosen, NamedSpectrum, chosen};
use crate::readings::ReadingOptions;

/// Targets that `text` names: one colour, or the spectra of `FILE` or `FILE#SAMPLE`.
pub(crate) fn targets(
    text: &str,
    reading: &ReadingOptions,
    console: &mut Console<'_>,
) -> Result<Vec<ColorTarget>> {
    if let Some(chosen) = chosen(text, reading, console)? {
        return measured(chosen, console);
    }
    let target = text.parse().map_err(|_| {
        Failure::usage(
            format!("a target is #rrggbb, L,a,b or a file of spectra that exists, found `{text}`"),
            "try \"#4a7d8c\", 52,-10.5,8 or swatches.csv#NAME",
        )
    })?;
    Ok(vec![target])
}

/// Spectra of paint among `chosen`. Bare cards are left out, unless one is named or there is nothing
/// else.
fn measured(chosen: Chosen, console: &mut Console<'_>) -> Result<Vec<ColorTarget>> {
    let Chosen { file, grid, mut spectra } = chosen;
    remark_coverage(grid, console)?;
    let count = spectra.len();
    if spectra.iter().any(|one| one.film == Film::Paint) {
        spectra.retain(|one| one.film == Film::Paint);
    }
    if spectra.len() < count {
        let bare = count - spectra.len();
        console.remark(format!("{file}: {bare} bare cards are no targets unless named"))?;
    }
    let target = |one: NamedSpectrum| {
        let reflectance = Spectrum::<Reflectance>::new(grid, one.reflectance)?;
        Ok(ColorTarget::measured(one.name, reflectance))
    };
    spectra.into_iter().map(target).collect()
}
