//! A scene of paint volumes at work: the thread that owns it, and its recording.
//!
//! ```text
//! window -- VolumeCommand --> VolumeWorker: inbox -> gesture -> events of the script -> world
//!     ^                                                                                  |
//!     +------ VolumeEvent (pictures, state, what is here) <---- painter <----------------+
//! ```
//!
//! Every gesture becomes an event of the script at whole steps of 1/120 s. What is shown is always
//! the script played from its start, so a moment that is gone to, an event that is taken back and
//! the script that is saved agree to the bit.

mod look;
mod tool;
mod subject;
mod state;
mod image;
mod event;
mod command;
mod pacer;
mod ray;
mod gesture;
mod recorded;
mod inbox;
mod materials;
mod opened;
mod header;
mod timeline;
mod inspect;
mod making;
mod painters;
mod scene;
mod hands;
mod pictures;
mod paints;
mod saving;
mod animation;
mod picture_share;
mod worker;
mod thread;

#[cfg(test)]
mod scene_tests;

#[cfg(test)]
mod paint_tests;

pub use animation::animation;
pub use command::VolumeCommand;
pub use event::{Here, ScenePicture, SceneRecording, VolumeEvent};
pub use image::SceneImage;
pub use look::{Inside, Look, SceneLight};
pub use pacer::STEPS_A_SECOND;
pub use state::{SceneEvent, SceneState, SceneTally, SceneTime, SceneTube};
pub use subject::{SHAPE, Subject};
pub use thread::VolumeWorker;
pub use tool::{Grip, ScenePen, SceneTool};
pub use volumes::painter::Show;
