//! A scene of paint volumes: the thread that owns it, and its recording.
//!
//! ```text
//! window -- VolumeCommand --> VolumeWorker: inbox -> gesture -> events of the script -> world
//!     ^                                                                                  |
//!     +------ VolumeEvent (pictures, state, what is here) <---- painter <----------------+
//! ```
//!
//! Every gesture becomes an event of the script at whole steps of 1/120 s. You always see the
//! script played from its start. So when you go to another moment, undo an event or save the
//! script, they all agree to the bit.

mod look;
mod command;
mod event;
mod gesture;
mod recorded;
mod inbox;
mod materials;
mod header;
mod timeline;
mod painters;
mod scene;
mod hands;
mod pictures;
mod animation;
mod worker;
#[cfg(test)]
mod paint_tests;

pub use animation::animation;
pub use command::{Grip, SHAPE, ScenePen, SceneTool, Subject, VolumeCommand};
pub use event::{
    Here, SceneEvent, SceneImage, ScenePicture, SceneRecording, SceneState, SceneTally, SceneTime,
    SceneTube, VolumeEvent,
};
pub use look::{Inside, Look, SceneLight};
pub use timeline::STEPS_A_SECOND;
pub use volumes::painter::Show;
pub use worker::VolumeWorker;
