//! Paintings and pictures as files, read back by our readers and by others.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod export;
mod painting;
