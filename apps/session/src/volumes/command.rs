//! Requests of the front end to a scene: commands, the tools of the pen, and subjects to open.

use std::path::{Path, PathBuf};

use graphics::camera::Camera;

use super::look::Look;

/// A request to the worker of scenes, which carries out commands in order, between steps.
#[derive(Debug, Clone)]
pub enum VolumeCommand {
    /// Opens a scene and closes the open one.
    Open(Subject),
    /// Sets the pen down with a tool. The gesture becomes an event of the recording.
    PenDown(Grip, ScenePen),
    /// Moves the pen that is down.
    PenMove(ScenePen),
    /// Lifts the pen, which ends the gesture.
    PenUp,
    /// Asks what is at a place of the picture, given as [`ScenePen::at`]. The answer is
    /// [`VolumeEvent::Here`](super::VolumeEvent::Here).
    Pick([f32; 2]),
    /// Lets time run, or stops it.
    Play(bool),
    /// Takes one step of 1/120 s and stops.
    StepOnce,
    /// Goes to a moment, in steps from the start, and stops there.
    Seek(u64),
    /// Views the scene with this camera.
    Camera(Camera),
    /// Sets width and height of the picture in pixels.
    Size([usize; 2]),
    /// Sets what is shown.
    Look(Look),
    /// Dries all paint.
    DryAll,
    /// Lights pigments with an illuminant of this name, or of a temperature, e.g. `5600K`.
    Illuminant(String),
    /// Fills the tubes from the library in this file.
    Library(PathBuf),
    /// Puts the pigment of this name into a tube, by its number from 0.
    Tube(usize, String),
    /// Removes the event that was added last, and replays the scene without it.
    Undo,
    /// Removes an event by its number in the list, and replays the scene without it.
    Remove(usize),
    /// Asks for the present picture at this size with all samples. The answer is
    /// [`VolumeEvent::Drawn`](super::VolumeEvent::Drawn) with this number.
    Draw(u64, [usize; 2]),
    /// Asks for the painting that the scene makes. The answer is
    /// [`VolumeEvent::Painted`](super::VolumeEvent::Painted) with this number.
    Paint(u64, [usize; 2]),
    /// Asks for the script of all events. The answer is
    /// [`VolumeEvent::Recording`](super::VolumeEvent::Recording) with this number.
    Recording(u64),
    /// Ends the thread.
    Quit,
}

impl VolumeCommand {
    /// Whether `later`, which follows immediately, makes this command superfluous.
    pub(super) fn is_outdated_by(&self, later: &Self) -> bool {
        matches!(
            (self, later),
            (Self::Camera(_), Self::Camera(_))
                | (Self::Size(_), Self::Size(_))
                | (Self::Look(_), Self::Look(_))
                | (Self::Illuminant(_), Self::Illuminant(_))
                | (Self::Seek(_), Self::Seek(_))
                | (Self::PenMove(_), Self::PenMove(_))
        )
    }
}

/// A tool of the pen in a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SceneTool {
    /// Pours paint from a tube onto the surface.
    #[default]
    Pour,
    /// Blows volumes and paint along the drag.
    Push,
    /// Takes paint up, as a sponge does.
    Lift,
    /// Dries the volumes below the pen: their paint stays, and their shape no longer changes.
    Dry,
}

impl SceneTool {
    /// All tools, in the order of the toolbar.
    pub const ALL: [Self; 4] = [Self::Pour, Self::Push, Self::Lift, Self::Dry];

    /// Its name in menus and lists.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Pour => "Pour",
            Self::Push => "Push",
            Self::Lift => "Lift",
            Self::Dry => "Dry",
        }
    }
}

/// A tool and its settings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grip {
    /// The tool in hand.
    pub tool: SceneTool,
    /// Tube to pour from, by its number from 0.
    pub tube: usize,
    /// Paint poured per second at full pressure, in mm3.
    pub rate_mm3_s: f64,
    /// How far the other tools reach, in mm.
    pub radius_mm: f64,
    /// Strength of the other tools, 0 to 1.
    pub strength: f64,
}

impl Default for Grip {
    fn default() -> Self {
        let tool = SceneTool::Pour;
        Self { tool, tube: 0, rate_mm3_s: 40.0, radius_mm: 20.0, strength: 0.5 }
    }
}

/// The pen over the picture of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScenePen {
    /// Place as a share of the picture's width and height, 0 to 1 from the upper left corner.
    pub at: [f32; 2],
    /// Pressure, 0 to 1. A mouse has 1.
    pub pressure: f32,
}

/// The names of models that come with the program start with this.
pub const SHAPE: &str = "shape:";

/// The source of a scene that you open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Subject {
    /// A model that comes with the program, e.g. `village`.
    Shape(String),
    /// A model or a photograph in a file.
    File(PathBuf),
    /// A script in a file.
    Script(PathBuf),
    /// The text of a script that was recovered, and the folder for the files that it names.
    Text {
        /// Text of the script.
        text: String,
        /// Folder of its subject.
        folder: PathBuf,
    },
}

impl Subject {
    /// The subject that a text of the command line names: `shape:NAME`, or a file with the
    /// extension of a model or of a script of paint volumes. Returns `None` for a picture, because
    /// it may also be pinned beside a painting. Use [`Subject::of_file`] for it.
    #[must_use]
    pub fn from_text(text: &str) -> Option<Self> {
        if let Some(name) = text.strip_prefix(SHAPE) {
            return Some(Self::Shape(name.to_owned()));
        }
        let path = Path::new(text);
        match ending(path).as_str() {
            "glb" | "gltf" | "obj" | "ply" => Some(Self::File(path.to_owned())),
            "toml" => Some(Self::Script(path.to_owned())),
            _ => None,
        }
    }

    /// The subject in a file that you chose for a scene.
    #[must_use]
    pub fn of_file(path: &Path) -> Self {
        match ending(path).as_str() {
            "toml" => Self::Script(path.to_owned()),
            _ => Self::File(path.to_owned()),
        }
    }
}

/// Extension of a file name in small letters.
fn ending(path: &Path) -> String {
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.unwrap_or_default().to_ascii_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_line_names_shapes_models_and_scripts() {
        let village = Some(Subject::Shape("village".to_owned()));
        assert_eq!(Subject::from_text("shape:village"), village);
        let model = Some(Subject::File(PathBuf::from("a/Jug.GLB")));
        assert_eq!(Subject::from_text("a/Jug.GLB"), model);
        let script = Some(Subject::Script(PathBuf::from("wakes.toml")));
        assert_eq!(Subject::from_text("wakes.toml"), script);
        for other in ["still.png", "oils.json", "painting.exr", "village"] {
            assert_eq!(Subject::from_text(other), None, "{other} is not of a scene alone");
        }
        let photograph = Path::new("still.png");
        assert_eq!(Subject::of_file(photograph), Subject::File(photograph.to_owned()));
    }
}
