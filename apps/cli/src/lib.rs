//! The command line `impasto VERB ...`, callable in process.
//!
//! Each verb has a file of its own: its options, one or two calls of a library, and printing. Without the
//! feature `pictures` the verbs that draw, paint or map are left out, and their crates are not compiled.
//! Exit status: 0 done, 1 the data are faulty or a check failed, 2 the command could not run
//! (a wrong option, an unreadable file, a missing device), 128 + n ended by signal n.
#![cfg_attr(
    not(feature = "pictures"),
    allow(dead_code, reason = "verbs without pictures use a part of what prints and writes")
)]

mod failure;
mod request_options;
mod console;
mod progress;
mod csv_rows;
mod library_choice;
mod readings;
mod surface;
mod output;
#[cfg(feature = "pictures")]
mod pictures;
mod verbs;
mod manual;
mod command;

use std::ffi::OsString;
use std::io::Write;
use std::time::Instant;

use clap::FromArgMatches;
use clap::error::{ContextKind, ErrorKind};

use command::{Arguments, Task, left_out_verb};
use console::Console;
pub use console::Screen;

/// Runs the program with `arguments`, the first of which is the program's name, and returns its
/// exit status. We write results to `out`, and remarks, warnings and errors to `err`.
pub fn run(
    arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>,
    out: &mut dyn Write,
    err: &mut dyn Write,
    screen: Screen,
) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
    let typed = arguments.iter().skip(1).map(|word| word.to_string_lossy().into_owned());
    let typed: Vec<String> = typed.collect();
    let words = std::iter::once("impasto").chain(typed.iter().map(String::as_str));
    let command = console::command_line(words);
    let parsed = command::command()
        .try_get_matches_from(arguments)
        .and_then(|matches| Arguments::from_arg_matches(&matches));
    let parsed = match parsed {
        Ok(parsed) => parsed,
        Err(mut error) => {
            // Whoever misspells an option does not want it as a value.
            error.remove(ContextKind::Suggested);
            let left_out = match error.kind() {
                ErrorKind::InvalidSubcommand => left_out_verb(&typed),
                _ => None,
            };
            if left_out.is_some() {
                error.remove(ContextKind::SuggestedSubcommand);
            }
            // Requested help is a result, help after an error is not.
            let text = error.render().to_string();
            let requested = !error.use_stderr();
            if requested {
                let _ = write!(out, "{text}");
            }
            for line in text.lines().filter(|_| !requested) {
                let _ = writeln!(err, "{}", documents::printable(line));
            }
            if let (Some(_), Some(lacking)) = (left_out, verbs::LACKING) {
                let _ = writeln!(err, "\nhint: {lacking}");
            }
            return if requested { 0 } else { 2 };
        }
    };
    let start = Instant::now();
    let voice = parsed.voice();
    let mut console = Console { out, err, screen, command, voice, streamed: false };
    let done = match parsed.task {
        Task::Verb(verb) => verb.run(&mut console),
        Task::Completions(completions) => completions.run(&mut console),
        Task::Man(man) => man.run(&mut console),
    };
    let took = format!("took {:.2} s", start.elapsed().as_secs_f64());
    match done.and_then(|()| console.detail(took)) {
        Ok(()) => 0,
        Err(failure) => failure.report(console.err),
    }
}

/// Compiles the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct ReadmeExample;
