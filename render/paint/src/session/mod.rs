//! A painting session: a canvas, a palette to mix on, and brushes that are used on both.
//!
//! A [`PaintingSession`] applies [`Action`](crate::strokes::Action)s of a user, a script or
//! a recording. Numbers are rounded to the digits of a script before anything is painted,
//! so that a recording replays bit for bit.
//!
//! **Brushes** have names. The paint on a brush is on the surface where it was last used. A
//! stroke on the other surface moves it there as part of the stroke, and an undo moves it
//! back.
//!
//! **One history** covers both surfaces, in the order of the actions. Both share its memory. When
//! one of them drops an action, all earlier ones become unreachable and are dropped as well, so
//! that nothing is undone out of order and no memory is lost to them. Loading, wiping and washing a
//! brush are not actions of the history: the undo of a stroke restores the paint that its brush
//! held before.
//!
//! **The recording** holds all actions since the session started, undo and redo included, as
//! a script of the format `strokes/1`.

mod history;
mod state;
mod actions;
mod kept;

#[cfg(test)]
mod tests;

pub use kept::{KeptSession, RecordingTail, ReplayError, ReplayReport};
pub use state::{KeptHead, Outcome, PaintingSession};
