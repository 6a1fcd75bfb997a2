//! Rules for the files of this repository: dependencies, imports, length, sources, wording.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod crates;
mod figures;
mod modules;
mod sources;
mod words;
