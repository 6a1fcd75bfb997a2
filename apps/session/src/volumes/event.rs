//! Events that the worker of scenes sends to the front end.
//!
//! State of a scene besides its picture.
//!
//! A picture of a scene as it is exported.

use std::path::PathBuf;
use std::sync::Arc;

use documents::hint::Hint;
use glam::Vec3;
use graphics::camera::Camera;
use graphics::export::{PictureFormat, picture_file};
use graphics::field::Field;
use paint::document::Document;
use paint::engine::PaintEngine;
use paint::light::Light;
use paint::painting::Painting;
use pigment::library::PigmentLibrary;

use super::command::SceneTool;
use super::look::Look;
use crate::event::PickedLayer;
use crate::failure::FileFailure;

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

/// A tube of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SceneTube {
    /// Name of its pigment.
    pub name: String,
    /// sRGB of an opaque film under the light.
    pub masstone: Option<[u8; 3]>,
    /// sRGB of one part of it in nine parts of white.
    pub tint: Option<[u8; 3]>,
}

/// An event of a scene: what one gesture did.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneEvent {
    /// The tool that made it; `None` for what a script does besides.
    pub tool: Option<SceneTool>,
    /// Short description, such as `pour Ultramarine`.
    pub label: String,
    /// First step at which it acts.
    pub from: u64,
    /// First step at which it acts no more.
    pub to: u64,
}

/// Where all the paint of a scene is, in mm3.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SceneTally {
    /// Poured so far.
    pub poured_mm3: f64,
    /// On the surfaces now.
    pub on_surfaces_mm3: f64,
    /// Taken up by the sponge.
    pub lifted_mm3: f64,
    /// Left in the tubes, as there was no room for it.
    pub left_mm3: f64,
    /// Number of volumes.
    pub volumes: usize,
}

/// Time of a scene, in whole steps of 1/120 s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SceneTime {
    /// The moment shown.
    pub step: u64,
    /// The last moment that was reached or that an event needs.
    pub end: u64,
    /// Whether time runs.
    pub playing: bool,
    /// Speed of time over the last second, 1 in real time; 0 while it stands.
    pub speed: f64,
}

/// State of a scene besides its picture.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneState {
    /// Title of the scene.
    pub title: String,
    /// Lowest and highest corner of the subject, in its unit.
    pub bounds: [Vec3; 2],
    /// Number of triangles of the subject.
    pub triangles: usize,
    /// Length of one unit of the subject in mm.
    pub unit_mm: f64,
    /// Whether the subject is a photograph, which is seen from the front.
    pub flat: bool,
    /// A camera that frames the subject in a picture of 4 by 3.
    pub framed: Camera,
    /// The camera that its script names, if it does.
    pub seen_from: Option<Camera>,
    /// The library of the tubes.
    pub library: Arc<PigmentLibrary>,
    /// The light on pigments.
    pub light: Arc<Light>,
    /// Its name.
    pub illuminant: String,
    /// Whether paint is being mixed for the picture, which shows it when that is done.
    pub prepares: bool,
    /// The tubes, at most eight.
    pub tubes: Arc<Vec<SceneTube>>,
    /// The look that is shown.
    pub look: Look,
    /// Whether the regions of its script show different things inside of their volumes, so that
    /// [`Inside::ByRegion`](super::Inside::ByRegion) is a choice.
    pub by_region: bool,
    /// The moment shown, and the last one.
    pub time: SceneTime,
    /// All events by the time at which they begin.
    pub events: Arc<Vec<SceneEvent>>,
    /// Where the paint is.
    pub tally: SceneTally,
    /// Counter of changes of the recording: equal numbers, equal recordings.
    pub revision: u64,
}

/// Width of a pixel of a drawing in mm: 96 to the inch, as the command line has it.
const PIXEL_MM: f64 = 25.4 / 96.0;

/// A picture of a scene with all samples. The command line makes the same bytes of the recording.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneImage {
    /// Linear sRGB and opacity, row by row.
    pub pixels: Field<[f32; 4]>,
    /// Width of a pixel in mm.
    pub pixel_mm: f64,
}

impl SceneImage {
    /// A drawing in linear sRGB.
    pub(super) fn drawing(pixels: Field<[f32; 4]>) -> Self {
        Self { pixels, pixel_mm: PIXEL_MM }
    }

    /// The picture of a painting, one pixel for each of its cells.
    ///
    /// # Errors
    /// [`FileFailure`] for a light that cannot be used with its library.
    pub(super) fn of_painting(document: Document) -> Result<Self, FileFailure> {
        let lighting = &document.lighting;
        let light = Light::named(&document.library, &lighting.illuminant, &lighting.observer);
        let light = light.map_err(|error| FileFailure::explained(&error))?;
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        let pixel_mm = document.cell_mm;
        let pixels = Painting::open_under(document, light, engine, 0)
            .and_then(|mut painting| painting.picture())
            .map_err(|error| FileFailure::explained(&error))?;
        Ok(Self { pixels, pixel_mm })
    }

    /// The bytes of its file.
    ///
    /// # Errors
    /// [`FileFailure`] if it is too large for the format.
    pub fn file(&self, format: PictureFormat) -> Result<Vec<u8>, FileFailure> {
        let file = picture_file(&self.pixels, self.pixel_mm, format);
        Ok(file.map_err(|error| FileFailure::explained(&error))?.bytes)
    }
}
