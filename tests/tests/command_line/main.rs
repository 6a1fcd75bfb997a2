//! The program `impasto`, run in process: output, files, errors and exit status.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod artmap;
mod errors;
mod matching;
mod named_files;
mod painterly;
mod request_page;
mod requests;
mod stencil;
mod strangers;
mod verbs;
mod vocabulary;
