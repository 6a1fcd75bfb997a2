//! The program `impasto` on the command line, run in process: output, files, errors, exit status.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod artmap;
mod bad_files;
mod correction;
mod demo;
mod errors;
mod exit_status;
mod light;
mod matching;
mod misread;
mod painterly;
mod spectral_match;
mod stencil;
mod verbs;
mod vocabulary;
