//! Messages of the worker of scenes to the front end: events, the state of a scene, and pictures for
//! export.

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
    /// Width in pixels. It is smaller than you asked for while the scene moves on a slow machine.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// sRGB and alpha with 8 bits each, row by row.
    pub pixels: Vec<[u8; 4]>,
    /// The moment shown, in steps.
    pub step: u64,
    /// Whether it has all pixels and samples. While the scene moves, it has fewer.
    pub fine: bool,
}

/// Surface, paint and colour at a place of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Here {
    /// Place on the surface, in the unit of the subject, if there is a surface.
    pub place: Option<Vec3>,
    /// Number of volumes around it.
    pub volumes: usize,
    /// Region of the paint there, if there is paint.
    pub region: Option<String>,
    /// Paint of the volumes there, if there is any.
    pub paint: Option<PickedLayer>,
    /// CIELAB of the colour shown there, against the white of the screen.
    pub lab: [f64; 3],
    /// sRGB of the colour shown there.
    pub srgb: [u8; 3],
}

/// The script of a scene, ready to be saved.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneRecording {
    /// Text of the script.
    pub text: Arc<str>,
    /// Folder of the subject.
    pub folder: PathBuf,
    /// File of the subject. It is `None` for a model that comes with the program.
    pub subject: Option<PathBuf>,
    /// File of the library. It is `None` for the one that comes with the program.
    pub library: Option<PathBuf>,
    /// Number of changes up to this script. A script with a higher number is newer.
    pub revision: u64,
}

/// A message of the worker of scenes.
#[derive(Debug, Clone)]
pub enum VolumeEvent {
    /// Another scene was opened.
    Opened(Arc<SceneState>),
    /// Something other than the picture changed.
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
    /// The tool that made it. Events that only a script can make have none.
    pub tool: Option<SceneTool>,
    /// Short description, e.g. `pour Ultramarine`.
    pub label: String,
    /// First step at which it acts.
    pub from: u64,
    /// First step at which it no longer acts.
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
    /// Left in the tubes, because there was no room for it.
    pub left_mm3: f64,
    /// Number of volumes.
    pub volumes: usize,
}

/// Time of a scene, in whole steps of 1/120 s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SceneTime {
    /// The moment shown.
    pub step: u64,
    /// The last moment that was reached, or that an event needs.
    pub end: u64,
    /// Whether time runs.
    pub playing: bool,
    /// Speed of time over the last second: 1 in real time, 0 while time stands.
    pub speed: f64,
}

/// Everything about a scene except its picture.
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
    /// Whether the subject is a photograph, seen from the front.
    pub flat: bool,
    /// A camera that frames the subject in a picture of 4 by 3.
    pub framed: Camera,
    /// The camera of its script, if it names one.
    pub seen_from: Option<Camera>,
    /// The library of the tubes.
    pub library: Arc<PigmentLibrary>,
    /// The light on pigments.
    pub light: Arc<Light>,
    /// Name of this light.
    pub illuminant: String,
    /// Whether a painter with the present pigments is still being made. The picture shows its paint
    /// afterwards.
    pub prepares: bool,
    /// The tubes, at most eight.
    pub tubes: Arc<Vec<SceneTube>>,
    /// The look that is shown.
    pub look: Look,
    /// Whether the regions of its script show different things inside their volumes. Only then
    /// [`Inside::ByRegion`](super::Inside::ByRegion) is a choice.
    pub by_region: bool,
    /// The moment shown, and the last one.
    pub time: SceneTime,
    /// All events, sorted by the time at which they begin.
    pub events: Arc<Vec<SceneEvent>>,
    /// Where the paint is.
    pub tally: SceneTally,
    /// Counts changes of the recording: if two numbers are equal, so are the recordings.
    pub revision: u64,
}

/// Width of a pixel of a drawing in mm: 96 per inch, as on the command line.
const PIXEL_MM: f64 = 25.4 / 96.0;

/// A picture of a scene with all samples. The command line makes the same bytes from the
/// recording.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneImage {
    /// Linear sRGB and opacity, row by row.
    pub pixels: Field<[f32; 4]>,
    /// Width of a pixel in mm.
    pub pixel_mm: f64,
}

impl SceneImage {
    pub(super) fn drawing(pixels: Field<[f32; 4]>) -> Self {
        Self { pixels, pixel_mm: PIXEL_MM }
    }

    /// The picture of a painting, with one pixel per cell.
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
