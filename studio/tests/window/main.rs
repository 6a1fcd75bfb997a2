//! The program itself, in a window on a screen that nobody sees: started,
//! painted with, saved, killed.
//!
//! It needs Xvfb and an adapter (software will do). Without them the tests pass
//! and say so; if the variable `IMPASTO_GPU_TESTS` names a file, each adds a line
//! to it: the adapter, or `none`.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod screen;

mod program;

mod export;

mod painting;

mod recovery;

use std::io::Write;

use render::gpu::{BackendChoice, choose};
use screen::Screen;

/// A screen to show a window on, where that can be had.
fn screen(width: u16, height: u16) -> Option<Screen> {
    let device = choose(BackendChoice::Gpu).ok().flatten();
    let adapter = device.map_or_else(|| "none".to_owned(), |is| is.adapter().name.clone());
    let screen = Screen::start(width, height);
    let name = if screen.is_some() { adapter.as_str() } else { "none" };
    if let Some(path) = std::env::var_os("IMPASTO_GPU_TESTS") {
        let mut file = std::fs::File::options().append(true).create(true).open(path).unwrap();
        file.write_all(format!("{name}\n").as_bytes()).unwrap();
    }
    if name == "none" {
        let _ = writeln!(std::io::stderr(), "no graphics adapter, or no Xvfb: not tested");
        return None;
    }
    screen
}
