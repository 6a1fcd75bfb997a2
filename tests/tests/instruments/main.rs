//! Files of instruments: readings in text and XML, references and lamps.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod readings;
mod xml;
