//! Instrument files: readings in text and XML formats, references and lamps.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod readings;
mod cases;
mod xml;
