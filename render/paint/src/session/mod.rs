//! The easel: a canvas, a palette to mix on, and brushes that go between them.
//!
//! An [`PaintingSession`] carries out [`Action`](crate::strokes::Action)s, whether a
//! hand makes them, a script tells them or a recording is played again: one form
//! for all three. Numbers are rounded as a script has them before anything is
//! painted, so that what was recorded replays to the bit.
//!
//! **Brushes** go by name. The paint on one is where it was last used; a stroke
//! on the other surface takes it there, and that is part of the stroke: undone,
//! the paint is back where it was.
//!
//! **One history** for both surfaces, in the order in which things were done. Each
//! painting keeps its part of it within its own share of the memory; an action
//! that one of them had to forget makes all before it unreachable, so that
//! nothing is ever taken back out of order. Loading, wiping and washing a brush
//! are no actions of the history, as in a painting alone: a stroke taken back
//! takes its brush back to what it held before.
//!
//! **The recording** holds all that was done since the easel was set up, undo and
//! redo too, as a script of `strokes/1`.

mod failure;

mod brushes;

mod history;

mod record;

mod label;

mod state;

mod acting;

mod adjusting;

mod live;

mod undoing;

mod replay;

#[cfg(test)]
mod tests;

pub use failure::SessionError;
pub use replay::{ReplayError, ReplayReport};
pub use state::{Outcome, PaintingSession};
