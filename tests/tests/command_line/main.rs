//! The program as a user meets it, run in process.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod bad_files;
mod demo;
mod errors;
mod matching;
mod verbs;
