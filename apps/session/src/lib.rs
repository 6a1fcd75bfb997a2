//! A session of painting: the thread that owns the paint, and the autosaves that protect it.
//!
//! A front end (e.g. a window, a browser or a test) sends [`Command`]s to the [`Worker`] and reads
//! its [`Event`]s. [`Autosave`] saves the paintings to the disk, and [`LostSession`] finds the
//! autosaves of programs that were killed.
//!
//! ```text
//! front end -- Command --> Worker: open stroke or dispatch -> PaintingSession -> paint engine
//!     ^                                                                              |
//!     +------- Event (state, tiles, snapshots, messages) <---------------------------+
//! ```
//!
//! ```
//! use std::{sync::mpsc::channel, time::Instant};
//!
//! use pigment::PigmentLibrary;
//! use paint::{pose::Sample, strokes::{SampleDecimals, SurfaceId}};
//! use session::{Command, Event, PenSample, Worker, WorkerOptions, blank_canvas};
//!
//! let (wake, woken) = channel();
//! let worker = Worker::start(WorkerOptions::default(), move || wake.send(()).unwrap_or(()));
//! worker.ask(Command::Open(blank_canvas(PigmentLibrary::van_gogh_oils(), 20.0, 15.0, 0.2)));
//! let (surface, decimals) = (SurfaceId::Canvas, SampleDecimals::PEN);
//! worker.ask(Command::PenDown { surface, brush: "round".to_owned(), decimals });
//! let sample = Sample::upright(0.0, 10.0, 8.0, 0.5);
//! worker.ask(Command::PenMove(vec![PenSample { sample, arrived: Instant::now() }]));
//! worker.ask(Command::PenUp);
//! worker.ask(Command::Snapshot(1));
//! let painted = loop {
//!     woken.recv()?;
//!     let snapshot = worker.events().find_map(|event| match event {
//!         Event::Snapshot(snapshot) => Some(snapshot),
//!         _ => None,
//!     });
//!     if let Some(snapshot) = snapshot {
//!         break snapshot;
//!     }
//! };
//! assert_eq!(painted.canvas.wet.width(), 100);
//! # Ok::<(), std::sync::mpsc::RecvError>(())
//! ```
//!
//! This crate knows nothing of windows, pens and pictures on a screen: see the crate `studio`.
mod state;
mod event;
mod command;
mod backend;
mod srgb;
pub mod warm_up;
mod miniature;
mod meter;
mod outbox;
mod prepare;
mod report;
mod replay;
pub mod thread;
mod worker;
mod dispatch;
mod open;
mod failure;
mod autosave;
pub mod brushes;
pub mod swatches;
pub mod volumes;

#[cfg(test)]
mod tests;

pub use autosave::{Autosave, LostSession, RecoveredWork, SessionMeta, now};
pub use command::{Command, Origin, Pace, PenSample};
pub use event::{Event, HeadOnCanvas, KeptPainting, Picked, PickedLayer, Snapshot, TilePixels};
pub use failure::FileFailure;
pub use prepare::{blank_canvas, default_brushes, default_mixing_canvas, initial_commands};
pub use state::{
    BrushState, BrushSwatch, FilmColor, HistoryShot, HistoryShots, LayerState, MaskState,
    PaintingState, Performance, Thumbnail,
};
pub use thread::Wait;
pub use worker::{Worker, WorkerOptions};
