//! Formats that kept mixtures are written in, and what is read from them.

use std::path::Path;

use documents::file::write_whole;
use documents::hint::Explain;
use pigment::library::PigmentLibrary;
use session::swatches::SwatchBook;
use spectra::TristimulusWeights;
use spectra::swatch_file::{SwatchFile, read_aco, read_ase, read_gpl, write_ase, write_gpl};

use super::problem::Problem;

/// A format of kept mixtures or of their colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SwatchFormat {
    /// Recipes with their colours: JSON that the studio reads again.
    Json,
    /// Colours alone, for GIMP, Inkscape and Krita.
    Gpl,
    /// Colours alone, for Adobe programs.
    Ase,
}

/// Content of a file of swatches.
#[derive(Debug)]
pub enum ReadSwatches {
    /// Recipes with their colours.
    Mixtures(SwatchBook),
    /// Colours without recipes.
    Colors(SwatchFile),
}

impl SwatchFormat {
    /// Extension of its files.
    #[must_use]
    pub fn ending(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Gpl => "gpl",
            Self::Ase => "ase",
        }
    }

    /// Writes mixtures to a file; colours are those under the light of `weights`.
    ///
    /// # Errors
    /// [`Problem`] if the format cannot hold a name, or the file cannot be written.
    pub fn write(
        self,
        path: &Path,
        book: &SwatchBook,
        (library, weights): (&PigmentLibrary, &TristimulusWeights),
    ) -> Result<(), Problem> {
        let colors = || book.colors(library, weights);
        let refused = |error: &dyn Explain| Problem::from_error(error);
        let bytes = match self {
            Self::Json => book.to_json().into_bytes(),
            Self::Gpl => write_gpl(&colors()).map_err(|error| refused(&error))?.into_bytes(),
            Self::Ase => write_ase(&colors()).map_err(|error| refused(&error))?,
        };
        Ok(write_whole(path, &bytes)?)
    }
}

/// Reads mixtures or colours, by the extension of the file.
///
/// # Errors
/// [`Problem`] naming the file and what is wrong in it.
pub(super) fn read_swatches(path: &Path) -> Result<ReadSwatches, Problem> {
    let name = path.display().to_string();
    let bytes = documents::file::read(path)?;
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let colors = match ending.to_ascii_lowercase().as_str() {
        "gpl" => read_gpl(&name, &bytes),
        "ase" => read_ase(&name, &bytes),
        "aco" => read_aco(&name, &bytes),
        _ => {
            let text = String::from_utf8_lossy(&bytes);
            let book = SwatchBook::from_json(&name, &text);
            return book.map(ReadSwatches::Mixtures).map_err(|error| Problem::from_error(&error));
        }
    };
    colors.map(ReadSwatches::Colors).map_err(|error| Problem::from_error(&error))
}

#[cfg(test)]
mod tests {
    use pigment::evaluate::Viewing;
    use session::swatches::{KeptMixture, SwatchChange};

    use super::*;

    #[test]
    fn mixtures_come_back_from_json_and_their_colours_from_the_other_formats() {
        let folder = tempfile::tempdir().unwrap();
        let library = PigmentLibrary::van_gogh_oils();
        let weights = Viewing::default().weights(library.grid).unwrap();
        let recipe = [("Vermilion".to_owned(), 3.0), ("Zinc White".to_owned(), 1.0)].into();
        let kept = KeptMixture::of(&library, recipe, 0.1, (&weights, "D65")).unwrap();
        let mut book = SwatchBook::default();
        book.apply(SwatchChange::Keep(Box::new(kept.clone())));
        for format in [SwatchFormat::Json, SwatchFormat::Gpl, SwatchFormat::Ase] {
            let path = folder.path().join(format!("kept.{}", format.ending()));
            format.write(&path, &book, (&library, &weights)).unwrap();
            match read_swatches(&path).unwrap() {
                ReadSwatches::Mixtures(read) => {
                    assert_eq!((format, &read), (SwatchFormat::Json, &book));
                }
                ReadSwatches::Colors(read) => {
                    assert_ne!(format, SwatchFormat::Json);
                    let [entry] = &read.swatches[..] else { panic!("{read:?}") };
                    let hex = entry.color.srgb().unwrap().to_hex();
                    assert_eq!(
                        (entry.name.as_str(), hex),
                        (kept.name.as_str(), kept.color.clone())
                    );
                }
            }
        }
        let missing = read_swatches(&folder.path().join("none.json")).unwrap_err();
        assert!(missing.text.contains("none.json"), "{missing:?}");
        std::fs::write(folder.path().join("wrong.json"), "{}").unwrap();
        let wrong = read_swatches(&folder.path().join("wrong.json")).unwrap_err();
        assert!(wrong.text.contains("`format`") && wrong.hint.is_some(), "{wrong:?}");
    }
}
