//! Checks that a painting holds exactly the paint that you get when this machine plays a script of
//! strokes.
//!
//! ```text
//! cargo run -p impasto-session --example same_paint -- strokes.json painting.exr
//! ```
//!
//! The tests of the studio in a browser use this to check a painting that was made there.

#![expect(clippy::print_stdout, reason = "an example prints what it did")]

use std::path::Path;
use std::process::ExitCode;
use std::sync::mpsc::channel;

use graphics::gpu::BackendChoice;
use paint::document::Document;
use paint::strokes::StrokeScript;
use session::{Command, Event, Pace, Worker, WorkerOptions};

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<ExitCode, Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [script, painting] = &arguments[..] else {
        return Err("give a script and a painting: strokes.json painting.exr".into());
    };
    let here = replayed(Path::new(script))?;
    let there = paint::file::read(painting, &documents::file::read(Path::new(painting))?)?;
    let same = [
        ("size", here.wet.width() == there.wet.width() && here.wet.height() == there.wet.height()),
        ("wet paint", here.wet == there.wet && here.slots == there.slots),
        ("dry layers", here.dry == there.dry),
        ("ground", here.ground == there.ground),
    ];
    for (what, same) in same {
        println!("{what}: {}", if same { "the same" } else { "DIFFERENT" });
    }
    println!("quanta of wet paint: {:?}", here.wet.totals());
    Ok(ExitCode::from(u8::from(same.iter().any(|(_, same)| !same))))
}

fn replayed(path: &Path) -> Result<Document, Failure> {
    let script =
        StrokeScript::from_json(&path.display().to_string(), &documents::file::read(path)?)?;
    let library = script.open_library(path.parent().unwrap_or(Path::new("")))?.library;
    let (wake, woken) = channel();
    let options = WorkerOptions { backend: BackendChoice::Cpu, ..WorkerOptions::default() };
    let worker = Worker::start(options, move || wake.send(()).unwrap_or_default());
    let script = Box::new(script);
    let library = Box::new(library);
    worker.ask(Command::Replay { script, library, pace: Pace::Fast });
    loop {
        woken.recv()?;
        for event in worker.events() {
            match event {
                Event::Replayed => worker.ask(Command::Snapshot(1)),
                Event::Snapshot(snapshot) => return Ok((*snapshot.canvas).clone()),
                Event::Message { text, failed: true, .. } => return Err(text.into()),
                _ => {}
            }
        }
    }
}
