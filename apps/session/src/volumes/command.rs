//! Commands of the front end to a scene.

use std::path::PathBuf;

use graphics::camera::Camera;

use super::look::Look;
use super::subject::Subject;
use super::tool::{Grip, ScenePen};

/// A request to the worker of scenes. Commands are carried out in their order, between steps.
#[derive(Debug, Clone)]
pub enum VolumeCommand {
    /// Opens a scene in place of the open one.
    Open(Subject),
    /// Sets the pen down with a tool; the gesture becomes an event of the recording.
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
    /// Sees the scene from here.
    Camera(Camera),
    /// Sets width and height of the picture in pixels.
    Size([usize; 2]),
    /// Sets what is shown.
    Look(Look),
    /// Dries all paint.
    DryAll,
    /// Sees pigments under this light: an illuminant's name, or a temperature such as `5600K`.
    Illuminant(String),
    /// Fills the tubes from the library in this file.
    Library(PathBuf),
    /// Puts the pigment of this name into a tube, by its number from 0.
    Tube(usize, String),
    /// Removes the event that was added last, and replays the scene without it.
    Undo,
    /// Removes an event by its number in the list, and replays the scene without it.
    Remove(usize),
    /// Asks for the picture as it is now, drawn at this size with all samples. The answer is
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
    /// Whether `later`, which follows at once, makes this command superfluous.
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
