//! `impasto report`: figures, their files, and the page.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]
mod inputs;
mod made;
mod page;
