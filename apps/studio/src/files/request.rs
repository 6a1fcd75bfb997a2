//! File actions that you can request in menus and panels, and the formats of drawings on the
//! reference picture and of kept mixtures.

use std::path::{Path, PathBuf};

use artmap::passages::Marks;
use documents::file::write_whole;
use graphics::tile::Rect;
use painterly::guides::Guides;
use pigment::library::PigmentLibrary;
use session::swatches::{SwatchBook, SwatchChange};
use spectra::TristimulusWeights;
use spectra::swatch_file::{SwatchFile, read_aco, read_ase, read_gpl, write_ase, write_gpl};

use super::problem::Problem;
use crate::language::english;

/// A file action. Long work runs in the background.
#[derive(Debug, Clone, PartialEq)]
pub enum FileRequest {
    /// Opens a painting, a library or a recording. Without a path, this asks for the file. A
    /// picture is pinned beside the canvas, a lamp lights the painting.
    Open(Option<PathBuf>),
    /// Saves to the painting's file, or asks for one.
    Save,
    /// Asks for a file and saves to it.
    SaveAs,
    /// Keeps a numbered revision beside the painting's file.
    KeepRevision,
    /// Opens a revision as a new painting.
    OpenRevision(PathBuf),
    /// Deletes a revision after asking.
    DeleteRevision(PathBuf),
    /// Asks what to export and where, and exports it.
    Export,
    /// Exports a timelapse of the recording, after asking for its form and file.
    ExportTimelapse,
    /// Asks for a file and saves the recording of all strokes to it.
    SaveRecording,
    /// Pins a picture beside the canvas. Without a path, this asks for the file.
    OpenReference(Option<PathBuf>),
    /// Removes the picture beside the canvas.
    CloseReference,
    /// Asks for a file and saves lines drawn on this picture to it.
    SaveDrawing(DrawnFile),
    /// Asks for a file with lines for the picture in this file, and opens them.
    OpenDrawing(DrawingKind, PathBuf),
    /// Asks for the file of a measured lamp, and lights the painting with it.
    OpenLamp,
    /// Changes the list of kept mixtures.
    Swatches(SwatchChange),
    /// Asks for a file and adds its mixtures or colours.
    ImportSwatches,
    /// Asks for a file and writes the kept mixtures to it.
    ExportSwatches(SwatchFormat),
    /// Crops the painting to these cells.
    Crop(Rect),
    /// Asks for a canvas and begins a new painting.
    New,
    /// Opens the sample painting.
    Sample,
    /// Asks for a file and takes over its brushes.
    ImportBrushes,
    /// Asks for a file and exports the shown set of brushes to it.
    ExportBrushes,
    /// Shows the preferences.
    Preferences,
}

/// A kind of drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawingKind {
    /// Marks of samples.
    Marks,
    /// Guides of strokes.
    Guides,
}

/// Lines drawn on the reference picture.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawing {
    /// Marks of samples.
    Marks(Marks),
    /// Guides of strokes.
    Guides(Guides),
}

/// A drawing and its file.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnFile {
    /// The lines.
    pub drawing: Drawing,
    /// The file of these lines, or the file that we suggest for them.
    pub path: PathBuf,
}

impl DrawingKind {
    /// Word for drawings of this kind.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Marks => english("marks"),
            Self::Guides => english("guides"),
        }
    }

    /// File beside a picture that we suggest for its drawing, e.g. `orchard.marks.toml` for
    /// `orchard.png`.
    #[must_use]
    pub fn beside(self, picture: &Path) -> PathBuf {
        picture.with_extension(format!("{}.toml", self.name()))
    }

    /// Reads a drawing of this kind.
    ///
    /// # Errors
    /// [`Problem`] with the place in the file.
    pub(super) fn open(self, path: &Path) -> Result<Drawing, Problem> {
        match self {
            Self::Marks => {
                Marks::open(path).map(Drawing::Marks).map_err(|error| Problem::from_error(&error))
            }
            Self::Guides => {
                Guides::open(path).map(Drawing::Guides).map_err(|error| Problem::from_error(&error))
            }
        }
    }
}

impl Drawing {
    /// The kind of the drawing.
    #[must_use]
    pub fn kind(&self) -> DrawingKind {
        match self {
            Self::Marks(_) => DrawingKind::Marks,
            Self::Guides(_) => DrawingKind::Guides,
        }
    }

    /// Writes the drawing.
    ///
    /// # Errors
    /// [`Problem`] if the file cannot be written.
    pub(super) fn save(&self, path: &Path) -> Result<(), Problem> {
        match self {
            Self::Marks(marks) => marks.save(path).map_err(|error| Problem::from_error(&error)),
            Self::Guides(guides) => guides.save(path).map_err(|error| Problem::from_error(&error)),
        }
    }
}

/// A change of the picture beside the canvas.
#[derive(Debug, Clone, PartialEq)]
pub enum ReferenceChange {
    /// Pins the picture in this file.
    Open(PathBuf),
    /// Pins the picture in a file again, with lines that may be in no file.
    Restore {
        /// File of the picture.
        picture: PathBuf,
        /// The lines.
        drawings: Vec<DrawnFile>,
    },
    /// Removes the picture.
    Close,
    /// Shows lines read from a file, in place of those of the same kind.
    Draw(DrawnFile),
    /// These lines were saved.
    Saved(DrawnFile),
}

/// A format of kept mixtures or of their colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SwatchFormat {
    /// Recipes with their colours. This is JSON that the studio reads again.
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

    /// Writes mixtures to a file, with their colours under the light of `weights`.
    ///
    /// # Errors
    /// [`Problem`] if the format does not allow a name, or the file cannot be written.
    pub fn write(
        self,
        path: &Path,
        book: &SwatchBook,
        (library, weights): (&PigmentLibrary, &TristimulusWeights),
    ) -> Result<(), Problem> {
        let bytes = match self {
            Self::Json => book.to_json().into_bytes(),
            Self::Gpl => {
                let file = write_gpl(&book.colors(library, weights));
                file.map_err(|error| Problem::from_error(&error))?.into_bytes()
            }
            Self::Ase => write_ase(&book.colors(library, weights))
                .map_err(|error| Problem::from_error(&error))?,
        };
        Ok(write_whole(path, &bytes)?)
    }
}

/// Reads mixtures or colours, by the extension of the file.
///
/// # Errors
/// [`Problem`] that names the file and its fault.
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
    use super::*;
    use pigment::evaluate::Viewing;
    use session::swatches::{KeptMixture, SwatchChange};

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
