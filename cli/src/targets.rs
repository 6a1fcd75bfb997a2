//! Colours to be met: `#rrggbb`, Lab, or measured spectra.

use calibrate::matching::{Sight, Target};
use calibrate::measurement::Film;
use spectra::color::ColorCode;
use spectra::{Reflectance, Spectrum};

use crate::console::Console;
use crate::failure::Refusal;
use crate::input::remark_coverage;
use crate::named_spectra::{Chosen, NamedSpectrum, chosen};
use crate::readings::ReadingOptions;

/// The targets that `text` names: one colour, or the spectra of FILE or
/// FILE#SAMPLE.
///
/// A colour without a spectrum is wanted to look the same under every sight. An
/// sRGB colour is adapted (Bradford) from the display's white to the light's.
pub(crate) fn targets(
    text: &str,
    sights: &[Sight],
    reading: &ReadingOptions,
    console: &mut Console<'_>,
) -> anyhow::Result<Vec<Target>> {
    if let Some(chosen) = chosen(text, reading, console)? {
        return measured(chosen, sights, console);
    }
    let Ok(code) = text.parse::<ColorCode>() else {
        return Err(Refusal::usage(
            format!("a target is #rrggbb, L,a,b or a file of spectra that exists, found `{text}`"),
            "try \"#4a7d8c\", 52,-10.5,8 or swatches.csv#NAME",
        ));
    };
    let name = match code {
        ColorCode::Srgb(rgb) => rgb.to_hex(),
        ColorCode::Lab(_) => format!("Lab {text}"),
    };
    Ok(vec![Target::from_lab(&name, code.lab(), sights)])
}

/// The paint among `chosen`. Bare cards are read to tell the paint's K/S and not to be matched,
/// unless one is named or there is nothing else.
fn measured(
    chosen: Chosen,
    sights: &[Sight],
    console: &mut Console<'_>,
) -> anyhow::Result<Vec<Target>> {
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
        Ok(Target::from_reflectance(&one.name, &reflectance, sights)?)
    };
    spectra.into_iter().map(target).collect()
}
