//! Speed of a scene of paint volumes while you work in it. This uses the worker alone, and asks for
//! pictures as a window of 1280 x 800 does.
//!
//! `cargo bench -p impasto-studio --bench volumes` pours paint on the village, turns the view, and
//! does both at once. It prints the pictures per second, how fast the simulation runs compared with
//! real time, and the time from the start of a pour to the first colour.

#![expect(clippy::print_stdout, reason = "a bench prints")]

use std::error::Error;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use web_time::{Duration, Instant};

use graphics::camera::Framing;
use session::volumes::{
    Grip, Inside, Look, ScenePen, ScenePicture, SceneState, Subject, VolumeCommand, VolumeEvent,
    VolumeWorker,
};

/// The picture's size in a window of 1280 x 800.
const SIZE: [usize; 2] = [954, 704];

/// Time of each measurement.
const LASTS: Duration = Duration::from_secs(5);

/// Time between two commands of the simulated hand.
const HAND: Duration = Duration::from_millis(8);

struct Bench {
    worker: VolumeWorker,
    woken: Receiver<()>,
    state: Option<Arc<SceneState>>,
    picture: Option<Arc<ScenePicture>>,
    pictures: usize,
}

impl Bench {
    fn receive(&mut self, wait: Duration) {
        let _ = self.woken.recv_timeout(wait);
        for event in self.worker.events() {
            match event {
                VolumeEvent::Opened(state) | VolumeEvent::State(state) => self.state = Some(state),
                VolumeEvent::Picture(picture) => {
                    self.picture = Some(picture);
                    self.pictures += 1;
                }
                _ => {}
            }
        }
    }

    fn turn(&self, degrees: f32) {
        let Some(state) = &self.state else { return };
        let aspect = SIZE[0] as f32 / SIZE[1] as f32;
        let framing = Framing { azimuth_deg: 30.0 + degrees, aspect, ..Framing::default() };
        self.worker.ask(VolumeCommand::Camera(framing.camera(state.bounds)));
    }

    fn colored(&self) -> usize {
        self.picture.as_ref().map_or(0, |shown| {
            shown
                .pixels
                .iter()
                .filter(|[red, green, blue, _]: &&[u8; 4]| {
                    red.max(green).max(blue) - red.min(green).min(blue) > 24
                })
                .count()
        })
    }

    /// Calls `act` with the elapsed seconds again and again, and prints the pictures per second
    /// meanwhile.
    fn measure(&mut self, what: &str, mut act: impl FnMut(&Self, f32)) {
        let start = Instant::now();
        let pictures = self.pictures;
        let first = self.state.as_ref().map_or(0, |state| state.time.step);
        while start.elapsed() < LASTS {
            act(self, start.elapsed().as_secs_f32());
            self.receive(HAND);
        }
        let seconds = start.elapsed().as_secs_f64();
        let steps = self.state.as_ref().map_or(0, |state| state.time.step) - first;
        let volumes = self.state.as_ref().map_or(0, |state| state.tally.volumes);
        let (width, height) =
            self.picture.as_ref().map_or((0, 0), |shown| (shown.width, shown.height));
        println!(
            "{what:28} {:5.1} pictures/s of {width} x {height}, {:3.0} % of real time, {volumes} volumes",
            (self.pictures - pictures) as f64 / seconds,
            100.0 * steps as f64 / (120.0 * seconds),
        );
    }

    /// Switches what the volumes show inside, and turns the view meanwhile. Prints the longest time
    /// without a new picture, and the time until the paint is mixed.
    fn switch_to(&mut self, inside: Inside) {
        let Some(look) = self.state.as_ref().map(|state| state.look) else { return };
        self.worker.ask(VolumeCommand::Look(Look { inside, ..look }));
        let start = Instant::now();
        let mut last = start;
        let mut longest = Duration::ZERO;
        let mut mixed = Duration::ZERO;
        while start.elapsed() < LASTS {
            self.turn(20.0 * start.elapsed().as_secs_f32());
            let pictures = self.pictures;
            self.receive(HAND);
            let now = Instant::now();
            if self.pictures > pictures {
                longest = longest.max(now - last);
                last = now;
            }
            if self.state.as_ref().is_some_and(|state| state.prepares) {
                mixed = now - start;
            }
        }
        let [longest, mixed] =
            [longest.max(last.elapsed()), mixed].map(|time| 1e3 * time.as_secs_f64());
        println!(
            "switching to {inside:?}: at most {longest:.0} ms without a picture, mixed after {mixed:.0} ms"
        );
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let (wake, woken) = channel();
    let worker = VolumeWorker::start(move || wake.send(()).unwrap_or(()));
    let mut bench = Bench { worker, woken, state: None, picture: None, pictures: 0 };
    let opened = Instant::now();
    bench.worker.ask(VolumeCommand::Open(Subject::Shape("village".to_owned())));
    while bench.state.is_none() {
        bench.receive(HAND);
    }
    bench.worker.ask(VolumeCommand::Size(SIZE));
    bench.turn(0.0);
    while bench.picture.is_none() {
        bench.receive(HAND);
    }
    println!("first picture after {:.0} ms", 1e3 * opened.elapsed().as_secs_f64());
    let pen = |x: f32, y: f32| ScenePen { at: [x, y], pressure: 1.0 };
    let mut waits = Vec::new();
    for _ in 0..8 {
        // The drawing with all samples has come.
        let rest = Instant::now();
        while rest.elapsed() < Duration::from_secs(1) {
            bench.receive(HAND);
        }
        let pressed = Instant::now();
        // This pours on grass.
        bench.worker.ask(VolumeCommand::PenDown(Grip::default(), pen(0.45, 0.8)));
        while bench.colored() == 0 {
            bench.receive(Duration::from_millis(1));
        }
        waits.push(1e3 * pressed.elapsed().as_secs_f64());
        bench.worker.ask(VolumeCommand::PenUp);
        bench.worker.ask(VolumeCommand::Undo);
        bench.worker.ask(VolumeCommand::Seek(0));
        while bench.colored() > 0 || bench.state.as_ref().map_or(0, |state| state.time.step) > 0 {
            bench.receive(HAND);
        }
    }
    waits.sort_by(f64::total_cmp);
    println!("pour to first colour: median {:.0} ms, most {:.0} ms", waits[4], waits[7]);
    bench.measure("turning the grey drawing", |bench, seconds| bench.turn(20.0 * seconds));
    bench.worker.ask(VolumeCommand::PenDown(Grip::default(), pen(0.5, 0.55)));
    let along = |seconds: f32| pen(0.5 + 0.15 * (2.0 * seconds).sin(), 0.55);
    bench.measure("pouring", |bench, seconds| {
        bench.worker.ask(VolumeCommand::PenMove(along(seconds)));
    });
    bench.measure("pouring and turning", |bench, seconds| {
        bench.worker.ask(VolumeCommand::PenMove(along(seconds)));
        bench.turn(100.0 + 20.0 * seconds);
    });
    bench.worker.ask(VolumeCommand::PenUp);
    bench.measure("turning the coloured drawing", |bench, seconds| bench.turn(20.0 * seconds));
    for inside in [Inside::Glaze, Inside::Both, Inside::Glaze] {
        bench.switch_to(inside);
    }
    bench.measure("turning a glaze", |bench, seconds| bench.turn(20.0 * seconds));
    Ok(())
}
