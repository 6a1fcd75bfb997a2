//! The program `impasto-studio`.

use std::io::{Write, stderr, stdout};
use std::process::ExitCode;

use studio::arguments::{Start, Stop};
use studio::window;

fn main() -> ExitCode {
    documents::file::end_cleanly_on_signals();
    let started = Start::from_arguments(std::env::args_os());
    match started.and_then(|start| window::run(start).map_err(Stop::from)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(stop) => report(&stop),
    }
}

/// Prints help to standard output and errors to standard error.
fn report(stop: &Stop) -> ExitCode {
    let _ = match stop.status {
        0 => stdout().write_all(stop.text.as_bytes()),
        _ => stderr().write_all(stop.text.as_bytes()),
    };
    ExitCode::from(stop.status)
}
