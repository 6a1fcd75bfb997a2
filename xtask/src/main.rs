//! `cargo xtask PART`: the checks and builds of this repository. You can call each part alone.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program for a terminal")]

mod runs;
mod wheel;
mod checks;
mod pages;
mod notices;
mod release;
mod testing;
mod ci;

use std::process::ExitCode;

use runs::Outcome;

const USAGE: &str = "\
cargo xtask PART, where PART is one of

  fmt [--check]              format the Rust of all workspaces, or check its format
  lint [CRATE ..]            clippy, the oldest Rust, licences of dependencies
  texts                      spelling and shell scripts
  test [--nextest] [ARG ..]  every test, or those that the arguments of `cargo test` choose
  pictures [--accept]        compare the reference pictures, or accept those painted now
  golden                     make the golden files anew, read scans and maps with programs of others
  wheel [--build | --test]   build the Python package and test it, or one of both
  pages [--build | --test]   build the pages and test them in Chromium, or one of both
  docs                       the reference pages; a warning is an error
  figures [FOLDER ..]        what the house test counts; --list MARK shows the places,
                             --write renews the table in ARCHITECTURE.md
  package [--programs FOLDER] [FOLDER]
                             pack the programs of the profile `dist`, or those in a folder
  release [FOLDER]           build both programs in the profile `dist` and pack them
  ci                         all checks; `.ci/run` installs what they need before
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match part(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("error: {reason}");
            ExitCode::FAILURE
        }
    }
}

fn part(arguments: &[String]) -> Outcome {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["fmt"] => checks::fmt(false),
        ["fmt", "--check"] => checks::fmt(true),
        ["lint", ..] => checks::lint(&arguments[1..]),
        ["texts"] => checks::texts_and_scripts(),
        ["test", ..] => testing::test(&arguments[1..]),
        ["pictures"] => testing::pictures(false),
        ["pictures", "--accept"] => testing::pictures(true),
        ["golden"] => wheel::golden(false),
        ["golden", "--built"] => wheel::golden(true),
        ["wheel"] => wheel::wheel(None),
        ["wheel", step @ ("--prepare" | "--build" | "--test")] => wheel::wheel(Some(step)),
        ["pages"] => pages::pages(None, false),
        ["pages", step @ ("--prepare" | "--build" | "--test")] => pages::pages(Some(step), false),
        ["pages", "--build", "--built"] => pages::pages(Some("--build"), true),
        ["docs"] => checks::docs(),
        ["figures", ..] => checks::figures(&arguments[1..]),
        ["package"] => release::package(None, None),
        ["package", "--programs", programs] => release::package(Some(programs), None),
        ["package", "--programs", programs, folder] => {
            release::package(Some(programs), Some(folder))
        }
        ["package", folder] => release::package(None, Some(folder)),
        ["release"] => release::release(None),
        ["release", folder] => release::release(Some(folder)),
        ["ci"] => ci::ci(),
        [] | ["help" | "--help" | "-h"] => {
            print!("{USAGE}");
            Ok(())
        }
        _ => Err(format!("`{}` is not a part\n\n{USAGE}", words.join(" "))),
    }
}
