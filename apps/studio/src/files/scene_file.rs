//! Files of a scene: what can be made of it, and the painter's answers.

use std::path::PathBuf;

use super::exporting::Export;
use session::LostSession;

/// A file that a scene makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SceneExport {
    /// The picture as it is seen.
    Picture,
    /// The painting: an OpenEXR file with its pigments.
    Painting,
    /// An export of the painting: layers, spectra, maps of its pigments, a picture.
    OfPainting(Export),
    /// The script of all events.
    Script,
    /// Pictures from the start to the end.
    Animation,
}

/// A choice of the painter for a scene.
#[derive(Debug)]
pub enum SceneAnswer {
    /// Opens this file.
    Open(PathBuf),
    /// Fills the tubes from this library.
    Library(PathBuf),
    /// Writes this file.
    Export(SceneExport, PathBuf),
    /// Opens the scene that a killed program kept.
    Recover(LostSession),
}

/// The purpose of a file of a scene that the painter is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ScenePurpose {
    /// To open it.
    Open,
    /// To fill the tubes from it.
    Library,
    /// To write it.
    Export(SceneExport),
}
