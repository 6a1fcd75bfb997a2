//! Drives the worker without a window: opens a canvas, loads a brush, paints a stroke, undoes it,
//! repeats it and saves the painting. Run it like this:
//!
//! `cargo run --release -p impasto-session --example drive_a_session [PAINTING.exr]`.

#![expect(clippy::print_stdout, reason = "an example prints what it did")]

use std::error::Error;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, channel};
use web_time::Instant;

use paint::pose::Sample;
use paint::strokes::{Action, Load, SampleDecimals, SurfaceId};
use pigment::PigmentLibrary;
use session::{Command, Event, PenSample, Snapshot, Worker, WorkerOptions, blank_canvas};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).map_or_else(|| "stroke.exr".into(), PathBuf::from);
    // The worker wakes the front end after each event.
    let (wake, woken) = channel();
    let worker = Worker::start(WorkerOptions::default(), move || {
        let _ = wake.send(());
    });
    worker.ask(Command::Open(blank_canvas(PigmentLibrary::van_gogh_oils(), 60.0, 40.0, 0.1)));
    let recipe = [("Ultramarine".to_owned(), 1.0), ("Zinc White".to_owned(), 2.0)].into();
    let load = Load { brush: "flat".to_owned(), recipe, vehicle: 0.2, amount_mm: 0.4 };
    worker.ask(Command::Apply(Action::Load(load)));
    worker.ask(Command::PenDown {
        surface: SurfaceId::Canvas,
        brush: "flat".to_owned(),
        decimals: SampleDecimals::PEN,
    });
    let samples = [(0.0, 12.0, 14.0), (0.4, 30.0, 24.0), (0.8, 48.0, 18.0)];
    let samples = samples.map(|(seconds, x_mm, y_mm)| PenSample {
        sample: Sample::upright(seconds, x_mm, y_mm, 0.6),
        arrived: Instant::now(),
    });
    worker.ask(Command::PenMove(samples.to_vec()));
    worker.ask(Command::PenUp);
    worker.ask(Command::Snapshot(1));
    let painted = snapshot(&worker, &woken)?;
    worker.ask(Command::GoTo(0));
    worker.ask(Command::Snapshot(2));
    let undone = snapshot(&worker, &woken)?;
    worker.ask(Command::GoTo(1));
    worker.ask(Command::Snapshot(3));
    let repeated = snapshot(&worker, &woken)?;
    println!(
        "the stroke laid paint: {}; after undo: {}; repeated bit for bit: {}",
        is_wet(&painted),
        is_wet(&undone),
        repeated.canvas.wet == painted.canvas.wet
    );
    painted.canvas.save(&path)?;
    println!("Wrote {}", path.display());
    Ok(())
}

/// Waits for the next snapshot, and prints messages until then.
fn snapshot(worker: &Worker, woken: &Receiver<()>) -> Result<Snapshot, Box<dyn Error>> {
    loop {
        woken.recv()?;
        for event in worker.events() {
            match event {
                Event::Snapshot(snapshot) => return Ok(snapshot),
                Event::Message { text, .. } => println!("{text}"),
                _ => {}
            }
        }
    }
}

fn is_wet(snapshot: &Snapshot) -> bool {
    snapshot.canvas.wet.totals().iter().any(|total| *total > 0)
}
