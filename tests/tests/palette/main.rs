//! What a palette can do: known answers, laws, and the oils.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod charts;
mod figures;
mod gamut;
mod graded;
mod hiding;
mod lights;
mod made;
mod tinting;
mod washes;
