//! Checks that do not run tests: format, lints, reference pages, figures.

use std::path::PathBuf;

use xtask::figures::{Figures, Mark};
use xtask::files::{files_below, root, text, texts};
use xtask::rules;
use xtask::versions::agree_on_rust;

use crate::runs::{Outcome, Run, is_installed};
use crate::wheel::python;

/// Other workspaces, which we must ask cargo to format one by one.
const OTHER_WORKSPACES: [&str; 2] = ["apps/python/Cargo.toml", "apps/web/Cargo.toml"];

/// `fmt [--check]`: formats the Rust of all workspaces, or checks its format.
pub(crate) fn fmt(check: bool) -> Outcome {
    let check = if check { "--check" } else { "" };
    Run::cargo("fmt --all").words(check).go()?;
    for manifest in OTHER_WORKSPACES {
        Run::cargo("fmt --all --manifest-path").args([manifest]).words(check).go()?;
    }
    Ok(())
}

/// `lint [CRATE ..]`: clippy on all crates, and on the program without pictures, or on the crates
/// that you name; the oldest Rust, licences of dependencies.
pub(crate) fn lint(crates: &[String]) -> Outcome {
    agree_on_rust()?;
    if crates.is_empty() {
        Run::cargo("clippy --workspace --all-targets --locked -- -D warnings").go()?;
        Run::cargo("clippy -p impasto --no-default-features --locked -- -D warnings").go()?;
    } else {
        let chosen = crates.iter().flat_map(|name| ["-p", name]);
        Run::cargo("clippy --all-targets --locked").args(chosen).words("-- -D warnings").go()?;
    }
    deny()
}

/// `texts`: spelling and shell scripts.
pub(crate) fn texts_and_scripts() -> Outcome {
    let programs = python()?.join("bin");
    Run::new(programs.join("typos")).go()?;
    let scripts = files_below("").into_iter().filter(|path| is_shell_script(path));
    let of_ci = [".ci/run", ".ci/release"].map(str::to_owned);
    Run::new(programs.join("shellcheck")).args(scripts.chain(of_ci)).go()
}

/// Whether the first line of the file at `path` names a shell.
fn is_shell_script(path: &str) -> bool {
    let name = path.rsplit('/').next().unwrap_or_default();
    let named = !name.contains('.') || name.ends_with(".sh");
    let first = named.then(|| std::fs::read(root().join(path)).unwrap_or_default());
    let shells: [&[u8]; 2] = [b"#!/usr/bin/env bash", b"#!/bin/sh"];
    first.is_some_and(|bytes| shells.iter().any(|shell| bytes.starts_with(shell)))
}

/// Checks dependencies: licences, sources and duplicate versions, and advisories if their database is on this
/// machine. `cargo deny fetch` gets it from a network.
fn deny() -> Outcome {
    if !is_installed("cargo-deny") {
        println!("licences are not checked: `cargo install cargo-deny --locked`");
        return Ok(());
    }
    Run::cargo("deny --offline --locked check bans licenses sources").go()?;
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(std::env::home_dir()?.join(".cargo"))).unwrap_or_default();
    if home.join("advisory-dbs").is_dir() {
        return Run::cargo("deny --offline --locked check advisories").go();
    }
    println!("advisories are not checked: `cargo deny fetch`");
    Ok(())
}

/// `docs`: the reference pages of the workspace. A warning is an error here.
pub(crate) fn docs() -> Outcome {
    Run::cargo("doc --workspace --no-deps --locked").env("RUSTDOCFLAGS", "-D warnings").go()
}

/// `figures [--write | --list MARK] [FOLDER ..]`: prints what the house test counts, for all files
/// or in the folders that you name.
pub(crate) fn figures(arguments: &[String]) -> Outcome {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (listed, folders) = match words[..] {
        ["--write"] => return write_figures(),
        ["--list", name, ..] => (Some(mark(name)?), &words[2..]),
        _ => (None, &words[..]),
    };
    let mut sources = texts(&[".rs", ".wgsl"]);
    if !folders.is_empty() {
        sources.retain(|path, _| folders.iter().any(|folder| path.starts_with(folder)));
    }
    let figures = Figures::of(&sources);
    match listed {
        Some(mark) => {
            for place in figures.places.get(&mark).into_iter().flatten() {
                println!("{place}");
            }
        }
        None => print(&figures),
    }
    Ok(())
}

fn mark(name: &str) -> Outcome<Mark> {
    let found = Mark::ALL.into_iter().find(|mark| mark.to_string() == name);
    let names: Vec<_> = Mark::ALL.iter().map(ToString::to_string).collect();
    found.ok_or_else(|| format!("{name} is not counted; one of {}", names.join(", ")))
}

fn print(figures: &Figures) {
    let Figures { files, lines, code, words, .. } = figures;
    println!("{files} Rust files, {lines} lines, {code} of code, {words} words of comments");
    println!("longest file: {}, {} lines\n", figures.longest_path, figures.longest);
    for rule in &rules::RULES {
        let kept = if rule.is_kept(figures) { ' ' } else { '!' };
        println!(
            "{kept} {:8.2}  {:<14} {}",
            rule.figure(figures),
            rule.limit.to_string(),
            rule.name
        );
    }
}

/// Rewrites the table in ARCHITECTURE.md.
fn write_figures() -> Outcome {
    let figures = Figures::of(&texts(&[".rs", ".wgsl"]));
    let page = rules::with_table(&text("ARCHITECTURE.md"), &rules::table(&figures));
    let page = page.ok_or_else(|| format!("ARCHITECTURE.md has no line {}", rules::HEAD))?;
    std::fs::write(root().join("ARCHITECTURE.md"), page).map_err(|error| error.to_string())
}
