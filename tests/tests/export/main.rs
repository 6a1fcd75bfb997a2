//! Exported pictures, read back by readers that are not ours.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod maps;
mod open_exr;
mod portable_network_graphics;
