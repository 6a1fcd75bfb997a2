//! The pages for browsers: lints, builds and tests in Chromium.

use xtask::files::root;

use crate::runs::{Outcome, Run, is_installed, target};

const WASM: &str = "wasm32-unknown-unknown";

const LINTED: &str = "-p impasto-web-calibration -p impasto-web-scan -p impasto-web-told";

fn has_wasm() -> bool {
    let installed = Run::new("rustup").words("target list --installed").output();
    installed.is_ok_and(|list| list.lines().any(|line| line == WASM))
}

/// Why we cannot test the pages on this machine, or `None` if we can.
pub(crate) fn obstacle() -> Option<&'static str> {
    let new_enough = "process.exit(parseInt(process.versions.node) < 20 ? 1 : 0)";
    if !has_wasm() {
        Some("no target wasm32-unknown-unknown")
    } else if !is_installed("npm") || !Run::new("node").args(["-e", new_enough]).works() {
        Some("no Node of version 20 or newer, or no npm")
    } else if !root().join("apps/web/node_modules/playwright-core").is_dir() {
        Some("npm cannot be reached")
    } else {
        None
    }
}

/// Fetches the target and the tools that test the pages, if this machine can reach them.
fn prepare() {
    if !has_wasm() {
        Run::new("rustup").words("target add").args([WASM]).works();
    }
    if has_wasm() && is_installed("npm") {
        let fetched = Run::new("npm").words("ci --prefix apps/web --no-audit --no-fund").go();
        fetched.unwrap_or_else(|reason| println!("{reason}"));
    }
}

/// Prepares a script of `apps/web`, so that it uses the target folder and the programs of the
/// tests.
fn script(words: &str) -> Run {
    let (program, words) = words.split_once(' ').unwrap_or((words, ""));
    let program = root().join("apps/web").join(program);
    Run::new(program).words(words).env("CARGO_TARGET_DIR", target())
}

/// `pages [--prepare | --build [--built] | --test]`: lints, builds and tests the pages, or one of
/// these. Pass `--built` to take the built programs. Cargo, which would wait for other builds, is
/// then not asked.
pub(crate) fn pages(step: Option<&str>, built: bool) -> Outcome {
    if matches!(step, None | Some("--prepare")) {
        prepare();
    }
    let obstacle = obstacle();
    if matches!(step, None | Some("--build")) {
        build(obstacle.is_none(), built)?;
    }
    if matches!(step, None | Some("--test")) {
        if let Some(reason) = obstacle {
            println!("the pages were not tested: {reason}");
            return Ok(());
        }
        script("test --run calibration").go()?;
        // Of the studio: pens, undo, light, download and replay to the bit, reload.
        script("test --run studio-window").go()?;
        script("test --run studio-paint").go()?;
    }
    Ok(())
}

fn build(tested: bool, built: bool) -> Outcome {
    if has_wasm() {
        let clippy = Run::cargo("clippy --locked --target").args([WASM]).words(LINTED);
        let clippy = clippy.words("-- -D warnings").env("CARGO_TARGET_DIR", target());
        clippy.inside("apps/web").go()?;
    }
    if !tested {
        return if has_wasm() { script("build calibration").go() } else { Ok(()) };
    }
    let debug = target().join("debug");
    for words in ["test --build calibration", "test --build --quick studio", "test --quick replay"]
    {
        let run = script(words);
        let run = match built {
            true => {
                let digest = debug.join("examples/replay_digest");
                run.env("IMPASTO", debug.join("impasto")).env("REPLAY_DIGEST", digest)
            }
            false => run,
        };
        run.go()?;
    }
    Ok(())
}
