//! State of a scene besides its picture.

use std::sync::Arc;

use glam::Vec3;
use graphics::camera::Camera;
use paint::light::Light;
use pigment::library::PigmentLibrary;

use super::look::Look;
use super::tool::SceneTool;

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
