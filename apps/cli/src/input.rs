//! Options and inputs that several verbs share: light, observer and pigment library.

use std::path::Path;

use calibrate::evaluate::Viewing;
use calibrate::library::PigmentLibrary;
use calibrate::matching::ViewingCondition;
use calibrate::visible_band::check_visible_band;
use clap::Args;
use documents::file::is_standard_input;
use spectra::color::{Adaptation, Rgb, RgbSpace, Xyz};
use spectra::{Grid, Observer, TristimulusWeights, light_from_text};

use crate::console::Console;
use crate::failure::{Failure, Result};

/// Options for the light and the observer.
#[derive(Debug, Clone, Args)]
pub(crate) struct ViewingOptions {
    /// Light: a CIE illuminant (D65, A, FL11, LED-B3 ..), a black body (5600K), daylight (D5600K),
    /// or a lamp's file: an instrument's (FILE#NAME for one of several spectra), or lines `nm,power`
    ///
    /// The power may have any unit. Negative noise down to -1 % of the peak counts as 0.
    #[arg(long, value_name = "LIGHT", default_value = "D65")]
    illuminant: String,
    /// Observer: 1931-2 (or 2), 1964-10 (or 10), 2015-2, 2015-10
    #[arg(long, value_name = "NAME", default_value = "1931-2")]
    observer: String,
}

impl ViewingOptions {
    pub(crate) fn viewing(&self) -> Result<Viewing> {
        viewing(&self.illuminant, &self.observer)
    }
}

/// Reads the light and looks up the observer that the texts of two options name.
pub(crate) fn viewing(illuminant: &str, observer: &str) -> Result<Viewing> {
    Ok(Viewing { illuminant: light_from_text(illuminant)?, observer: Observer::named(observer)? })
}

/// Reads a light with its weight among several, `LIGHT` or `LIGHT=WEIGHT`.
pub(crate) fn condition(text: &str, observer: &str) -> Result<ViewingCondition> {
    let weighted = text.rsplit_once('=').and_then(|(light, weight)| {
        let weight: f64 = weight.parse().ok()?;
        Some((light, weight))
    });
    let (light, weight) = weighted.unwrap_or((text, 1.0));
    Ok(ViewingCondition { viewing: viewing(light, observer)?, weight })
}

/// Converts a colour to encoded sRGB, adapted from `white` by Bradford's transform.
pub(crate) fn srgb(xyz: Xyz, white: Xyz) -> Rgb {
    RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford)
}

/// Computes the weights that turn spectra on `grid` into XYZ. Warns if `grid` covers only a part
/// of the visible band.
pub(crate) fn color_weights(
    viewing: &Viewing,
    grid: Grid,
    console: &mut Console<'_>,
) -> Result<TristimulusWeights> {
    remark_coverage(grid, console)?;
    Ok(viewing.weights(grid)?)
}

/// Warns if `grid` covers only a part of the visible band; an error if it has no visible
/// wavelength.
pub(crate) fn remark_coverage(grid: Grid, console: &mut Console<'_>) -> Result<()> {
    console.remarks(&check_visible_band(grid)?)
}

/// Reads a pigment library from a file.
pub(crate) fn library(path: &Path) -> Result<PigmentLibrary> {
    Ok(PigmentLibrary::open(path)?)
}

/// Whether a file is TOML: by its ending, standard input by what it holds.
pub(crate) fn is_toml(path: &Path) -> bool {
    match is_standard_input(path) {
        true => holds_toml(&documents::file::read(path).unwrap_or_default()),
        false => path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")),
    }
}

/// Whether the first line that is no comment is one of TOML: a table, or a key with its value.
fn holds_toml(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let mut lines = text.lines().map(str::trim);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with('#'));
    first
        .is_some_and(|line| line.starts_with('[') || (line.contains('=') && !line.starts_with('{')))
}

/// Reads a file of text, or standard input.
pub(crate) fn text(path: &Path) -> Result<String> {
    let name = path.display();
    String::from_utf8(documents::file::read(path)?).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        Failure::data(format!("{name}, byte {at}: text must be UTF-8"), "save the file in UTF-8")
    })
}

#[cfg(test)]
mod tests {
    use super::holds_toml;

    #[test]
    fn toml_is_told_from_models_json_and_pictures() {
        for toml in
            ["format = \"paint-volumes\"\n", "# guides\n\n[[guide]]\n", "[edges]\nstrength = 2"]
        {
            assert!(holds_toml(toml.as_bytes()), "{toml}");
        }
        for other in [
            &b"# a tent\nmtllib tent.mtl\nv 0 0 1\n"[..],
            b"ply\nformat ascii 1.0\ncomment a = b\n",
            b"{\"asset\": {\"generator\": \"a=b\"}}",
            b"\x89PNG\r\n\x1a\n= \xff",
            b"# a comment alone\n",
            b"",
        ] {
            assert!(!holds_toml(other), "{other:?}");
        }
    }
}
