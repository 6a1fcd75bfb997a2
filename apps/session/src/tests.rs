//! Tests of the worker as a front end uses it.

use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use graphics::gpu::BackendChoice;
use paint::brush::HeadShape;
use paint::pose::Sample;
use paint::strokes::{
    Action, BrushSpec, MAX_NAMES, SampleDecimals, Squeeze, StrokeScript, SurfaceId,
};
use pigment::library::PigmentLibrary;
use web_time::Instant;

use super::{Command, Event, PenSample, Wait, Worker, WorkerOptions, blank_canvas};

/// Events of a worker. A batch may go beyond the event that a test waits for. The next [`wait`]
/// then looks at the rest of the batch.
#[derive(Default)]
struct Events {
    seen: Vec<Event>,
    /// Events that no wait has looked at yet.
    pending: VecDeque<Event>,
}

/// Collects events until `find` gives a value for one of them.
fn wait<T>(
    worker: &Worker,
    woken: &Receiver<()>,
    events: &mut Events,
    find: impl Fn(&Event) -> Option<T>,
) -> T {
    loop {
        events.pending.extend(worker.events());
        while let Some(event) = events.pending.pop_front() {
            let found = find(&event);
            events.seen.push(event);
            if let Some(found) = found {
                return found;
            }
        }
        woken.recv_timeout(Duration::from_secs(60)).expect("the worker sends an event");
    }
}

fn recording(worker: &Worker, woken: &Receiver<()>, events: &mut Events) -> StrokeScript {
    worker.ask(Command::Recording(1));
    wait(worker, woken, events, |event| match event {
        Event::Recording { script, .. } => Some((**script).clone()),
        _ => None,
    })
}

/// Texts of the messages about the end of the recording.
fn endings(events: &[Event]) -> Vec<&str> {
    let texts = events.iter().filter_map(|event| match event {
        Event::Message { text, hint: Some(_), failed: false } => Some(text.as_str()),
        _ => None,
    });
    texts.filter(|text| text.starts_with("the recording ended early")).collect()
}

#[test]
fn a_recording_that_ends_early_is_reported_at_once_and_when_it_is_requested() {
    let (wake, woken) = channel();
    let options = WorkerOptions { backend: BackendChoice::Cpu, ..WorkerOptions::default() };
    let worker = Worker::start(options, move || {
        let _ = wake.send(());
    });
    worker.ask(Command::Open(blank_canvas(PigmentLibrary::van_gogh_oils(), 4.0, 3.0, 0.5)));
    // Each new head gets a name in the recording when you use it, e.g. for a wipe.
    let wipe = Action::Wipe { brush: "round".to_owned(), keep: 0.5 };
    let use_head = |head: usize| {
        let spec = BrushSpec { shape: HeadShape::Round, size_mm: 1.0 + 0.01 * head as f64 };
        worker.ask(Command::SetBrush { name: "round".to_owned(), spec });
        worker.ask(Command::Apply(wipe.clone()));
    };
    let mut events = Events::default();
    (0..MAX_NAMES).for_each(use_head);
    let complete = recording(&worker, &woken, &mut events);
    assert_eq!(complete.brushes.len(), MAX_NAMES);
    assert!(endings(&events.seen).is_empty(), "the recording is complete");

    use_head(MAX_NAMES);
    use_head(MAX_NAMES + 1);
    wait(&worker, &woken, &mut events, |event| {
        (!endings(std::slice::from_ref(event)).is_empty()).then_some(())
    });
    let cut = recording(&worker, &woken, &mut events);
    assert!(cut.actions.len() <= complete.actions.len() + 1, "nothing was added since");
    // After the answer to the request, the worker reports the early end again.
    wait(&worker, &woken, &mut events, |event| {
        (!endings(std::slice::from_ref(event)).is_empty()).then_some(())
    });
    let texts = endings(&events.seen);
    assert_eq!(texts.len(), 2, "{texts:?}");
    assert!(texts[0].ends_with(&format!("a recording holds {MAX_NAMES} brushes")), "{texts:?}");
}

/// Commands that paint two strokes, undo one, and ask for the painting.
fn two_strokes() -> Vec<Command> {
    let mut commands =
        vec![Command::Open(blank_canvas(PigmentLibrary::van_gogh_oils(), 30.0, 20.0, 0.2))];
    for (number, y_mm) in [6.0, 12.0].into_iter().enumerate() {
        let heap = Squeeze {
            on: SurfaceId::Canvas,
            recipe: [("Vermilion".to_owned(), 1.0)].into(),
            vehicle: 0.1,
            x_mm: 5.0,
            y_mm,
            volume_mm3: 6.0,
        };
        commands.push(Command::Apply(Action::Squeeze(heap)));
        let surface = SurfaceId::Canvas;
        let decimals = SampleDecimals::PEN;
        commands.push(Command::PenDown { surface, brush: "round".to_owned(), decimals });
        for step in 0..40 {
            let seconds = f64::from(step) / 100.0;
            let sample = Sample::upright(seconds, 5.0 + 0.4 * f64::from(step), y_mm, 0.6);
            commands.push(Command::PenMove(vec![PenSample { sample, arrived: Instant::now() }]));
        }
        commands.push(Command::PenUp);
        commands.push(Command::Snapshot(number as u64));
    }
    commands.extend([Command::GoTo(3), Command::Snapshot(2)]);
    commands
}

#[test]
fn a_worker_in_turns_paints_like_one_on_a_thread() {
    let options = WorkerOptions { backend: BackendChoice::Cpu, ..WorkerOptions::default() };
    let snapshot = |events: &mut Vec<Event>, found: Event| match found {
        Event::Snapshot(snapshot) => events.push(Event::Snapshot(snapshot)),
        Event::Message { failed: true, text, .. } => panic!("{text}"),
        _ => {}
    };
    let (wake, woken) = channel();
    let threaded = Worker::start(options, move || wake.send(()).unwrap_or_default());
    two_strokes().into_iter().for_each(|command| threaded.ask(command));
    let mut on_thread = Vec::new();
    while on_thread.len() < 3 {
        woken.recv_timeout(Duration::from_secs(60)).expect("the worker sends an event");
        threaded.events().for_each(|event| snapshot(&mut on_thread, event));
    }
    let worker = Worker::in_turns(options, || {});
    two_strokes().into_iter().for_each(|command| worker.ask(command));
    let mut in_turns = Vec::new();
    let mut turns = 0;
    while in_turns.len() < 3 {
        // The deadline is over, so each turn does one slice or command.
        worker.turn(Instant::now());
        worker.events().for_each(|event| snapshot(&mut in_turns, event));
        turns += 1;
    }
    assert!(turns > 10, "it works a little at a time: {turns} turns");
    for pair in on_thread.iter().zip(&in_turns) {
        let (Event::Snapshot(thread), Event::Snapshot(turn)) = pair else { panic!("snapshots") };
        assert_eq!(thread.number, turn.number);
        assert!(thread.canvas == turn.canvas, "snapshot {} differs", thread.number);
        assert!(thread.canvas.wet.totals().iter().any(|&quanta| quanta > 0), "nothing was painted");
    }
    worker.ask(Command::Quit);
    assert_eq!(worker.turn(Instant::now()), Wait::Forever);
}
