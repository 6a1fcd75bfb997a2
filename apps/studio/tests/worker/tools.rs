//! Tools that work wet paint, masks, and their replay.

use std::ops::ControlFlow;
use web_time::Instant;

use graphics::gpu::BackendChoice;
use paint::strokes::{Action, MaskChange, SampleDecimals, StrokeTool, SurfaceId};
use session::{Command, Event, PenSample};

use super::pen::{load, stroke, wander};
use super::strokes::{assert_same, session};
use super::window::Window;

#[test]
fn tools_and_masks_of_the_worker_are_those_of_the_session_and_replay_to_the_bit() {
    let mut window = Window::open(BackendChoice::Cpu);
    let mut session = session();
    let samples = wander(1, 300, 32.0, 20.0);
    let mask = MaskChange::PolygonMm(vec![[2.0, 1.0], [30.0, 5.0], [9.0, 19.0]]);
    for action in
        [load("flat", "Vermilion"), stroke(SurfaceId::Canvas, "flat", &samples), Action::Mask(mask)]
    {
        session.apply(&action).unwrap();
        window.act(action);
    }
    for (seed, tool) in [
        (2, StrokeTool::Blend { strength: 0.7 }),
        (3, StrokeTool::Scrape { height_mm: 0.02 }),
        (4, StrokeTool::Erase { strength: 0.123_456_789 }),
    ] {
        let samples = wander(seed, 200, 32.0, 20.0);
        window.ask(Command::ToolDown { tool, surface: SurfaceId::Canvas, brush: "flat".into() });
        let arrived = Instant::now();
        let moved = samples.iter().map(|&sample| PenSample { sample, arrived });
        window.ask(Command::PenMove(moved.collect()));
        window.ask(Command::PenUp);
        session
            .begin_stroke_as(tool, SurfaceId::Canvas, "flat", SampleDecimals::PEN)
            .and_then(|()| session.extend(&samples))
            .and_then(|()| session.end_stroke())
            .unwrap();
    }
    let snapshot = window.snapshot();
    assert_same(&snapshot, &mut session, "after all tools");
    let recording = window.recording();
    assert_eq!(recording, *session.recording().unwrap());
    let text = recording.to_json().unwrap();
    let read = paint::StrokeScript::from_json("recording", text.as_bytes()).unwrap();
    assert_eq!(read, recording, "it is read as it was written");
    let mut again = super::strokes::session();
    read.replay(
        &mut again,
        |_: &str, _: &mut _| Ok::<(), std::io::Error>(()),
        || ControlFlow::Continue(()),
    )
    .unwrap();
    assert_same(&snapshot, &mut again, "after a replay");
    // The worker plays it too.
    let library = session.canvas().library().clone();
    let pace = session::Pace::Fast;
    window.ask(Command::Replay { script: Box::new(read), library: Box::new(library), pace });
    window.wait("the end", |event| matches!(event, Event::Replayed).then_some(()));
    let replayed = window.snapshot();
    assert!(replayed.canvas.wet == snapshot.canvas.wet, "the worker replays something else");
}
