//! A session of painting: the thread that owns the paint, and what keeps it safe.
//!
//! A front end (a window, a browser, a test) sends [`Command`]s to the [`Worker`] and
//! reads its [`Event`]s. [`Session`] keeps autosaves on the disk and finds those of
//! programs that were killed.
//!
//! Out of scope: windows, pens and pictures on a screen (crate `studio`).

mod command;

mod event;

mod state;

mod fresh;

mod backend;

mod srgb;

mod tiles;

mod colors;

mod thumbnail;

mod layers;

mod pick;

mod room;

mod meter;

mod inbox;

mod outbox;

mod opening;

mod telling;

mod live;

mod playing;

mod workshop;

mod doing;

mod staging;

mod thread;

mod failure;

pub mod whole;

mod autosave;

pub use autosave::{LostSession, Session, SessionMeta, now};
pub use command::{Command, Origin, Pace, PenSample};
pub use event::{Event, HeadOnCanvas, Picked, PickedLayer, Snapshot, TilePixels};
pub use failure::FileFailure;
pub use fresh::{bare, brushes, fresh, mixing};
pub use state::{BrushState, EaselState, Figures, LayerState, Thumbnail};
pub use thread::{Worker, WorkerOptions};
