//! Events that the worker of scenes sends to the front end.

use std::path::PathBuf;
use std::sync::Arc;

use documents::hint::Hint;
use glam::Vec3;
use paint::document::Document;

use super::image::SceneImage;
use super::state::SceneState;
use crate::event::PickedLayer;

/// The picture of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ScenePicture {
    /// Width in pixels. It is smaller than asked for while the scene moves on a slow machine.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// sRGB and alpha with 8 bits each, row by row.
    pub pixels: Vec<[u8; 4]>,
    /// The moment shown, in steps.
    pub step: u64,
    /// Whether it has all pixels and samples; not while the scene moves.
    pub fine: bool,
}

/// Surface, paint and colour at a place of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Here {
    /// Place on the surface, in the unit of the subject; `None` where there is no surface.
    pub place: Option<Vec3>,
    /// Number of volumes that hold it.
    pub volumes: usize,
    /// Region of the paint there; `None` where there is no paint.
    pub region: Option<String>,
    /// Paint of the volumes there; `None` where there is none.
    pub paint: Option<PickedLayer>,
    /// CIELAB of the colour shown there, against the white of the screen.
    pub lab: [f64; 3],
    /// sRGB of the colour shown there.
    pub srgb: [u8; 3],
}

/// The script of a scene as it would be saved.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneRecording {
    /// Text of the script.
    pub text: Arc<str>,
    /// Folder that the subject lies in.
    pub folder: PathBuf,
    /// File of the subject; `None` for a model that comes with the program.
    pub subject: Option<PathBuf>,
    /// File of the library; `None` for the one that comes with the program.
    pub library: Option<PathBuf>,
    /// Counter of changes that it holds.
    pub revision: u64,
}

/// A message of the worker of scenes.
#[derive(Debug, Clone)]
pub enum VolumeEvent {
    /// Another scene was opened.
    Opened(Arc<SceneState>),
    /// State besides the picture changed.
    State(Arc<SceneState>),
    /// The picture changed.
    Picture(Arc<ScenePicture>),
    /// Answer to [`VolumeCommand::Pick`](super::VolumeCommand::Pick).
    Here(Box<Here>),
    /// Answer to [`VolumeCommand::Draw`](super::VolumeCommand::Draw).
    Drawn(u64, Arc<SceneImage>),
    /// Answer to [`VolumeCommand::Paint`](super::VolumeCommand::Paint).
    Painted(u64, Arc<Document>),
    /// Answer to [`VolumeCommand::Recording`](super::VolumeCommand::Recording).
    Recording(u64, Arc<SceneRecording>),
    /// A message for the painter.
    Message {
        /// Text of the message, one sentence.
        text: String,
        /// Advice on what to do, if there is any.
        hint: Option<Hint>,
        /// Whether something failed.
        failed: bool,
    },
}
