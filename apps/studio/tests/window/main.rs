//! The program in a window on a virtual screen: starting, painting, saving, killing.
//!
//! You need Xvfb and a graphics adapter (software is enough). Without them the tests pass and
//! print a note. If the variable `IMPASTO_GPU_TESTS` names a file, each test appends the adapter's
//! name or `none`.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod screen;
mod program;
mod painting;
mod painter;

use std::io::Write;

use graphics::gpu::{BackendChoice, choose};
use screen::Screen;

/// Starts a virtual screen, if Xvfb and an adapter are available.
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
