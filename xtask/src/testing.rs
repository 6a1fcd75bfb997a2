//! Tests the whole workspace, and counts how many tests passed and on which graphics adapter.

use std::collections::BTreeMap;

use crate::runs::{Environment, Outcome, Run, is_installed};

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) passed: usize,
    pub(crate) failed: usize,
    pub(crate) skipped: usize,
}

impl Counts {
    /// Adds the counts in a line of `cargo test` or nextest.
    fn add_line(&mut self, line: &str) {
        let line = line.trim_start();
        let of_cargo = line.starts_with("test result:");
        let of_nextest = line.starts_with("Summary [") && line.contains("tests run:");
        if !of_cargo && !of_nextest {
            return;
        }
        let mut before = 0;
        for word in line.split([' ', ';', ',', '(', ')']).filter(|word| !word.is_empty()) {
            match word {
                "passed" => self.passed += before,
                "failed" => self.failed += before,
                "ignored" | "skipped" => self.skipped += before,
                _ => {}
            }
            before = word.parse().unwrap_or(0);
        }
    }
}

impl std::fmt::Display for Counts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} passed, {} failed, {} skipped", self.passed, self.failed, self.skipped)
    }
}

/// `test [--nextest] [ARGUMENT ..]`: all tests, or the ones that you choose by arguments of
/// `cargo test`.
pub(crate) fn test(arguments: &[String]) -> Outcome {
    let all = ["--workspace".to_owned()];
    let nextest = arguments.first().is_some_and(|first| first == "--nextest");
    let arguments = if nextest { &arguments[1..] } else { arguments };
    let arguments = if arguments.is_empty() { &all[..] } else { arguments };
    let (counts, worked) = if nextest {
        by_nextest(arguments)?
    } else {
        by_cargo(arguments, &Environment::new(), || Ok(()))?
    };
    println!("{counts}");
    if worked { Ok(()) } else { Err("tests failed".to_owned()) }
}

/// Runs `cargo test ARGUMENTS`. This calls `at_first` when the first program of tests begins,
/// because cargo has built everything by then. You get the counts, and whether all went well.
pub(crate) fn by_cargo(
    arguments: &[String],
    environment: &Environment,
    at_first: impl FnOnce() -> Outcome,
) -> Outcome<(Counts, bool)> {
    let run = Run::cargo("test --no-fail-fast").args(arguments);
    let run = environment.iter().fold(run, |run, (name, value)| run.env(name, value));
    let mut counts = Counts::default();
    let mut at_first = Some(at_first);
    let mut begun = Ok(());
    let worked = run.lines(|line| {
        println!("{line}");
        counts.add_line(line);
        if line.trim_start().starts_with("Running ")
            && let Some(begin) = at_first.take()
        {
            begun = begin();
        }
    })?;
    begun.map(|()| (counts, worked))
}

/// Runs nextest, then the doc tests by cargo, because nextest leaves them out.
fn by_nextest(arguments: &[String]) -> Outcome<(Counts, bool)> {
    if !is_installed("cargo-nextest") {
        return Err("nextest is missing: `cargo install cargo-nextest --locked`".to_owned());
    }
    let mut counts = Counts::default();
    let mut worked = true;
    for command in ["nextest run --no-fail-fast --no-tests=pass", "test --doc --no-fail-fast"] {
        worked &= Run::cargo(command).args(arguments).lines(|line| {
            println!("{line}");
            counts.add_line(line);
        })?;
    }
    Ok((counts, worked))
}

/// `pictures [--accept]`: compares the reference pictures, or replaces them by new ones.
pub(crate) fn pictures(accept: bool) -> Outcome {
    let run = Run::cargo("test -p suite --test pictures");
    let run = if accept { run.env("IMPASTO_ACCEPT_PICTURES", "1") } else { run };
    run.go()
}

/// Number of tests on each graphics adapter. Each test appends its adapter to a file. Pass the text
/// of this file.
///
/// # Errors
/// If a test did not find an adapter, or no test asked for one.
pub(crate) fn adapters(names: &str) -> Outcome<BTreeMap<&str, usize>> {
    let mut found: BTreeMap<&str, usize> = BTreeMap::new();
    for name in names.lines() {
        *found.entry(name).or_default() += 1;
    }
    if found.is_empty() || found.contains_key("none") {
        return Err("tests that want a graphics adapter did not find one".to_owned());
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_of_both_programs_are_counted() {
        let mut counts = Counts::default();
        for line in [
            "test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 3 filtered out; finished in 0.1s",
            "test result: FAILED. 4 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out",
            "     Summary [  12.345s] 30 tests run: 28 passed (1 slow), 2 failed, 5 skipped",
            "test summary_of_5_passed ... ok",
        ] {
            counts.add_line(line);
        }
        assert_eq!(counts, Counts { passed: 44, failed: 4, skipped: 6 });
        assert_eq!(counts.to_string(), "44 passed, 4 failed, 6 skipped");
    }

    #[test]
    fn a_test_without_an_adapter_is_found() {
        let found = adapters("llvmpipe\nRTX\nllvmpipe\n").map(|found| found["llvmpipe"]);
        assert_eq!(found, Ok(2));
        assert!(adapters("llvmpipe\nnone\n").is_err(), "a test without adapter");
        assert!(adapters("").is_err(), "no test at all");
    }
}
