//! A session of painting: the thread that owns the paint, and what keeps it safe.
//!
//! A front end (a window, a browser, a test) sends [`Command`]s to the [`Worker`] and
//! reads its [`Event`]s. [`Autosave`] keeps the paintings on the disk, and [`LostSession`]
//! finds the autosaves of programs that were killed.
//!
//! Out of scope: windows, pens and pictures on a screen (crate `studio`).

mod state;

mod event;

mod command;

mod defaults;

mod backend;

mod srgb;

mod tiles;

mod colors;

mod thumbnail;

mod layers;

mod pick;

mod free_space;

mod meter;

mod inbox;

mod outbox;

mod prepare;

mod report;

mod stroke_timing;

mod replay;

mod worker;

mod dispatch;

mod open;

mod thread;

mod failure;

mod autosave;

#[cfg(test)]
mod tests;

pub use autosave::{Autosave, LostSession, SessionMeta, now};
pub use command::{Command, Origin, Pace, PenSample};
pub use defaults::{blank_canvas, default_brushes, default_mixing_canvas, initial_commands};
pub use event::{Event, HeadOnCanvas, Picked, PickedLayer, Snapshot, TilePixels};
pub use failure::FileFailure;
pub use state::{BrushState, LayerState, PaintingState, Performance, Thumbnail};
pub use thread::{Worker, WorkerOptions};
