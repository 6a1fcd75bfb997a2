//! The program `impasto` on the command line, run in process: output, files, errors, exit status.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod artmap;
mod errors;
mod matching;
mod painterly;
mod requests;
mod stencil;
mod verbs;
mod vocabulary;
