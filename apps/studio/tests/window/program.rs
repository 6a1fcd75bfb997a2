//! The program as a child process.

use std::io::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};

use studio::files::{Home, Preferences};

use crate::screen::{CONTROL, Screen, until};

pub(crate) fn keep_preferences(home: &Path, preferences: &Preferences) {
    let path = Home::in_folder(home).preferences();
    std::fs::create_dir_all(path.parent().expect("it is in a folder")).expect("a folder is made");
    preferences.write(&path).expect("preferences are written");
}

pub(crate) struct Program<'a> {
    pub(crate) screen: &'a Screen,
    /// Columns and rows of the screen in which the program shows the canvas.
    pub(crate) room: (Range<usize>, Range<usize>),
    pub(crate) child: Child,
    figures: PathBuf,
}

impl<'a> Program<'a> {
    /// Starts the program with its own home folder, and waits for its window and first
    /// picture.
    pub(crate) fn start(screen: &'a Screen, home: &Path, size: &str, arguments: &[&Path]) -> Self {
        let figures = home.join("figures.jsonl");
        let _ = std::fs::remove_file(&figures);
        let child = Command::new(env!("CARGO_BIN_EXE_impasto-studio"))
            .env("DISPLAY", &screen.name)
            .env_remove("WAYLAND_DISPLAY")
            .env("LC_ALL", "C")
            .arg("--home")
            .arg(home)
            .arg("--figures")
            .arg(&figures)
            .args(["--window", size, "--backend", "cpu"])
            .args(arguments)
            .stdout(Stdio::null())
            .spawn()
            .expect("the program starts");
        let mut program = Self { screen, room: (0..0, 0..0), child, figures };
        program.must_run();
        screen.focus_window();
        program.room = until("the program tells where its canvas is", || {
            program.must_run();
            program.fitted()
        });
        program
    }

    /// Position in the canvas view by shares of its width and height.
    pub(crate) fn at(&self, across: f64, down: f64) -> (i32, i32) {
        fn place(range: &Range<usize>, share: f64) -> i32 {
            (range.start as f64 + share * range.len() as f64) as i32
        }
        (place(&self.room.0, across), place(&self.room.1, down))
    }

    /// Position of the canvas on the screen in pixels: left, top, right, bottom. The program logs
    /// it once a second. The window has no frame and stands in the corner.
    pub(crate) fn canvas(&self) -> Option<[f64; 4]> {
        let lines = self.figures().ok()?;
        let line = lines.last()?;
        let sides = line["canvas_px"].as_array()?.iter().map(serde_json::Value::as_f64);
        sides.collect::<Option<Vec<f64>>>()?.try_into().ok()
    }

    /// Lines of the log so far.
    pub(crate) fn figures(&self) -> Result<Vec<serde_json::Value>, Box<dyn std::error::Error>> {
        let text = std::fs::read_to_string(&self.figures)?;
        Ok(text.lines().map(serde_json::from_str).collect::<Result<_, _>>()?)
    }

    /// Columns and rows of the screen that the canvas covers at the start, when it is fitted. At
    /// any zoom, you see nothing but the canvas there.
    fn fitted(&self) -> Option<(Range<usize>, Range<usize>)> {
        let [left, top, right, bottom] = self.canvas()?;
        let [x, y] = [(left, right), (top, bottom)]
            .map(|(from, to): (f64, f64)| from.ceil() as usize..to.floor() as usize);
        // The window gets its size shortly after it appears.
        let (width, height) = self.screen.size();
        let wide = x.len() > width / 2;
        (left > 0.0 && top > 0.0 && wide && x.end < width && y.end < height).then_some((x, y))
    }

    /// Closes the program through its menu key.
    pub(crate) fn quit(mut self) -> ExitStatus {
        self.screen.key(u32::from('q'), &[CONTROL]);
        until("the program ends", || self.child.try_wait().expect("the process state is readable"))
    }

    /// Kills the process, as a crash would.
    pub(crate) fn kill(mut self) {
        self.child.kill().expect("it was running");
        self.child.wait().expect("it ended");
    }

    fn must_run(&mut self) {
        let ended = self.child.try_wait().expect("the process state is readable");
        assert!(ended.is_none(), "the program ended: {ended:?}");
    }
}

impl Drop for Program<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            let path = self.screen.all().keep("failed");
            let _ = writeln!(std::io::stderr(), "the screen is in {path}");
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
