//! A client of the worker that collects its events, with synthetic strokes and brush loads.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

use graphics::gpu::BackendChoice;
use paint::pose::Sample;
use paint::strokes::{Action, Load, SampleDecimals, Stroke, StrokeScript, StrokeTool, SurfaceId};
use pigment::library::PigmentLibrary;
use session::{
    Command, Event, Origin, PaintingState, PenSample, Performance, Snapshot, Worker, WorkerOptions,
    default_brushes, default_mixing_canvas,
};
use web_time::{Duration, Instant};

const PATIENCE: Duration = Duration::from_secs(60);

pub(crate) struct Window {
    worker: Worker,
    woken: Receiver<()>,
    pub(crate) state: Option<Arc<PaintingState>>,
    pub(crate) pictures: Pictures,
    pub(crate) events: Vec<Event>,
    /// Brushes reported to be dirty.
    pub(crate) dirty: Vec<String>,
    numbers: u64,
}

/// Pictures assembled from tiles: canvas and palette, each also under the second light. Cells that
/// we never received are 0.
#[derive(Default)]
pub(crate) struct Pictures {
    pub(crate) canvas: Vec<[u8; 4]>,
    pub(crate) second: Vec<[u8; 4]>,
    pub(crate) second_palette: Vec<[u8; 4]>,
    pub(crate) palette: Vec<[u8; 4]>,
}

impl Window {
    /// Starts a worker without a painting.
    pub(crate) fn new(backend: BackendChoice) -> Self {
        let (wake, woken) = channel();
        let options = WorkerOptions { backend, ..WorkerOptions::default() };
        let worker = Worker::start(options, move || {
            let _ = wake.send(());
        });
        Self {
            worker,
            woken,
            state: None,
            pictures: Pictures::default(),
            events: Vec::new(),
            dirty: Vec::new(),
            numbers: 0,
        }
    }

    /// Starts a worker with a small blank canvas.
    pub(crate) fn open(backend: BackendChoice) -> Self {
        let mut window = Self::new(backend);
        window.ask(Command::Open(small()));
        window.wait("a painting", |event| matches!(event, Event::Opened(_)).then_some(()));
        window
    }

    pub(crate) fn ask(&mut self, command: Command) {
        self.worker.ask(command);
    }

    pub(crate) fn act(&mut self, action: Action) {
        self.ask(Command::Apply(action));
    }

    /// Paints a stroke. Its samples are sent in pieces.
    pub(crate) fn stroke<'a>(
        &mut self,
        surface: SurfaceId,
        brush: &str,
        pieces: impl IntoIterator<Item = &'a [Sample]>,
    ) {
        self.ask(Command::PenDown {
            surface,
            brush: brush.to_owned(),
            decimals: SampleDecimals::RECORDING,
        });
        for piece in pieces {
            let arrived = Instant::now();
            let samples = piece.iter().map(|&sample| PenSample { sample, arrived });
            self.ask(Command::PenMove(samples.collect()));
        }
        self.ask(Command::PenUp);
    }

    pub(crate) fn handle_events(&mut self) {
        let events: Vec<Event> = self.worker.events().collect();
        for event in events {
            match &event {
                Event::Opened(state) => {
                    let [canvas, palette] = [state.canvas_cells, state.palette_cells]
                        .map(|(width, height)| vec![[0; 4]; width * height]);
                    self.pictures = Pictures {
                        second: canvas.clone(),
                        second_palette: palette.clone(),
                        canvas,
                        palette,
                    };
                    self.state = Some(Arc::clone(state));
                }
                Event::DirtyBrush(brush) => self.dirty.push(brush.clone()),
                Event::State(state) => self.state = Some(Arc::clone(state)),
                Event::Tiles { surface, second, tiles, .. } => {
                    let state = self.state.as_ref().expect("a painting was opened first");
                    let (picture, width) = match (surface, second) {
                        (SurfaceId::Canvas, false) => {
                            (&mut self.pictures.canvas, state.canvas_cells.0)
                        }
                        (SurfaceId::Canvas, true) => {
                            (&mut self.pictures.second, state.canvas_cells.0)
                        }
                        (SurfaceId::Palette, true) => {
                            (&mut self.pictures.second_palette, state.palette_cells.0)
                        }
                        (SurfaceId::Palette, false) => {
                            (&mut self.pictures.palette, state.palette_cells.0)
                        }
                    };
                    for tile in tiles {
                        let rows = tile.pixels.chunks(tile.rect.width).enumerate();
                        for (y, row) in rows {
                            let first = (tile.rect.y + y) * width + tile.rect.x;
                            picture[first..first + row.len()].copy_from_slice(row);
                        }
                    }
                }
                _ => {}
            }
            self.events.push(event);
        }
    }

    /// Waits for the first event, past or future, for which `wanted` returns a value. This drops
    /// all earlier events.
    pub(crate) fn wait<T>(&mut self, what: &str, wanted: impl Fn(&Event) -> Option<T>) -> T {
        let end = Instant::now() + PATIENCE;
        loop {
            self.handle_events();
            let found = self.events.iter().enumerate();
            if let Some((index, found)) =
                found.filter_map(|(i, event)| Some((i, wanted(event)?))).next()
            {
                self.events.drain(..=index);
                return found;
            }
            let left = end.saturating_duration_since(Instant::now());
            assert!(self.woken.recv_timeout(left).is_ok(), "{what} within {PATIENCE:?}");
        }
    }

    /// Handles events until `wanted` holds.
    pub(crate) fn wait_until(&mut self, what: &str, wanted: impl Fn(&Self) -> bool) {
        let end = Instant::now() + PATIENCE;
        loop {
            self.handle_events();
            if wanted(self) {
                return;
            }
            let left = end.saturating_duration_since(Instant::now());
            assert!(self.woken.recv_timeout(left).is_ok(), "{what} within {PATIENCE:?}");
        }
    }

    /// Snapshot of the painting after all commands so far.
    pub(crate) fn snapshot(&mut self) -> Snapshot {
        self.numbers += 1;
        let wanted = self.numbers;
        self.ask(Command::Snapshot(wanted));
        self.wait("a snapshot", |event| match event {
            Event::Snapshot(snapshot) if snapshot.number == wanted => Some(snapshot.clone()),
            _ => None,
        })
    }

    /// Recording after all commands so far.
    pub(crate) fn recording(&mut self) -> StrokeScript {
        self.numbers += 1;
        let wanted = self.numbers;
        self.ask(Command::Recording(wanted));
        self.wait("a recording", |event| match event {
            Event::Recording { number, script } if *number == wanted => Some((**script).clone()),
            _ => None,
        })
    }

    /// Next message: text, hint, and whether this is an error.
    pub(crate) fn message(&mut self) -> (String, Option<String>, bool) {
        self.wait("a message", |event| match event {
            Event::Message { text, hint, failed } => {
                Some((text.clone(), hint.as_ref().map(ToString::to_string), *failed))
            }
            _ => None,
        })
    }

    /// Next performance figures that are not empty.
    pub(crate) fn figures(&mut self) -> Performance {
        self.wait("figures", |event| match event {
            Event::Performance(figures) if figures.mean_latency_ms > 0.0 => Some(*figures),
            _ => None,
        })
    }

    pub(crate) fn state(&self) -> &PaintingState {
        self.state.as_ref().expect("a painting was opened")
    }
}

/// A linen canvas of 320 x 200 cells with a palette of 100 x 80 cells.
pub(crate) fn small() -> Origin {
    let Origin::Blank { mut script, library } =
        session::blank_canvas(PigmentLibrary::van_gogh_oils(), 32.0, 20.0, 0.1)
    else {
        panic!("a bare canvas");
    };
    let mixing =
        paint::strokes::Canvas { width_mm: 10.0, height_mm: 8.0, ..default_mixing_canvas(0.1) };
    script.mixing = Some(mixing);
    script.brushes = default_brushes();
    Origin::Blank { script, library }
}

/// Samples of a wandering stroke of sines within `width_mm` x `height_mm`, at 120 samples per
/// second. `seed` selects the phase.
pub(crate) fn wander(seed: u64, count: usize, width_mm: f64, height_mm: f64) -> Vec<Sample> {
    let phase = seed as f64 * 1.7;
    (0..count)
        .map(|index| {
            let seconds = index as f64 / 120.0;
            let a = phase + 2.1 * seconds;
            let b = 1.3 * phase + 1.7 * seconds;
            Sample {
                seconds,
                x_mm: width_mm * (0.5 + 0.45 * a.sin()),
                y_mm: height_mm * (0.5 + 0.45 * b.cos()),
                pressure: 0.4 + 0.3 * (3.0 * seconds + phase).sin(),
                tilt_x_deg: 20.0 * (seconds + phase).sin(),
                tilt_y_deg: 15.0 * (seconds - phase).cos(),
                twist_deg: 40.0 * (0.5 * seconds).sin(),
            }
        })
        .collect()
}

pub(crate) fn load(brush: &str, pigment: &str) -> Action {
    Action::Load(Load {
        brush: brush.to_owned(),
        recipe: [(pigment.to_owned(), 1.0)].into(),
        vehicle: 0.1,
        amount_mm: 0.3,
    })
}

pub(crate) fn stroke(surface: SurfaceId, brush: &str, samples: &[Sample]) -> Action {
    Action::Stroke(Stroke {
        brush: brush.to_owned(),
        on: surface,
        tool: StrokeTool::Paint,
        samples: samples.to_vec(),
    })
}
