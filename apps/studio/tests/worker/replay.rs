//! Replay of recordings.

use std::convert::Infallible;
use std::ops::ControlFlow;
use web_time::Instant;

use graphics::gpu::BackendChoice;
use paint::strokes::{Action, Load, StrokeScript, SurfaceId};
use session::{Command, Event, Origin, Pace};

use super::pen::{load, stroke, wander};
use super::strokes::{assert_same, session};
use super::window::{Window, small};

/// A script of strokes on both surfaces and other actions.
fn script(actions: Vec<Action>) -> (Box<StrokeScript>, Box<pigment::library::PigmentLibrary>) {
    let Origin::Blank { mut script, library } = small() else { panic!("a bare canvas") };
    script.actions = actions;
    (script, library)
}

fn varied_actions() -> Vec<Action> {
    vec![
        load("round", "Ultramarine"),
        stroke(SurfaceId::Canvas, "round", &wander(21, 90, 32.0, 20.0)),
        Action::Save { path: "half.png".to_owned() },
        Action::Dry { fraction: 1.0 },
        load("knife", "Vermilion"),
        stroke(SurfaceId::Palette, "knife", &wander(22, 50, 10.0, 8.0)),
        stroke(SurfaceId::Canvas, "knife", &wander(23, 40, 32.0, 20.0)),
        Action::Undo {},
        stroke(SurfaceId::Palette, "round", &wander(24, 30, 10.0, 8.0)),
    ]
}

fn assert_replay(pace: Pace) {
    let (script, library) = script(varied_actions());
    let mut session = session();
    script
        .replay(
            &mut session,
            |_: &str, _: &mut _| Ok::<_, Infallible>(()),
            || ControlFlow::Continue(()),
        )
        .unwrap();
    let mut window = Window::new(BackendChoice::Cpu);
    let of = script.actions.len();
    let began = Instant::now();
    window.ask(Command::Replay { script, library, pace });
    let last = window.wait("the last progress", |event| match event {
        Event::Progress { done, of } if done == of => Some((*done, *of)),
        _ => None,
    });
    assert_eq!(last, (of, of), "all actions are played");
    let (text, _, failed) = window.message();
    assert!(text.contains("1 file that") && !failed, "unsaved files are reported: {text}");
    assert!(text.contains("9 of 9 actions"), "what was played is told: {text}");
    window.wait("the end", |event| matches!(event, Event::Replayed).then_some(()));
    if pace == Pace::AsPainted {
        // 89 + 49 + 39 + 29 pauses of 1/120 s.
        assert!(
            began.elapsed().as_secs_f64() >= 206.0 / 120.0,
            "the replay keeps the painted speed"
        );
    }
    let snapshot = window.snapshot();
    assert_same(&snapshot, &mut session, "after a replay");
    window.wait_until("the state", |window| window.state().revision == snapshot.revision);
    super::pictures::assert_pictures(&mut window, &snapshot);
    // Painting can continue after the replay.
    let samples = wander(25, 30, 32.0, 20.0);
    session.apply(&stroke(SurfaceId::Canvas, "knife", &samples)).unwrap();
    window.stroke(SurfaceId::Canvas, "knife", [&samples[..]]);
    assert_same(&window.snapshot(), &mut session, "painted on");
}

#[test]
fn a_fast_replay_equals_the_session_running_the_script() {
    assert_replay(Pace::Fast);
}

#[test]
fn a_replay_at_painted_speed_gives_the_same_painting() {
    assert_replay(Pace::AsPainted);
}

#[test]
fn a_recording_of_the_worker_replays_to_the_same_painting() {
    let mut window = Window::open(BackendChoice::Cpu);
    for action in varied_actions() {
        match action {
            Action::Save { .. } => {}
            Action::Stroke(stroke) => {
                window.stroke(stroke.on, &stroke.brush, stroke.samples.chunks(11));
            }
            action => window.act(action),
        }
    }
    let snapshot = window.snapshot();
    let script = window.recording();
    let script =
        StrokeScript::from_json("recording", script.to_json().unwrap().as_bytes()).unwrap();
    let Origin::Blank { library, .. } = small() else { panic!("a bare canvas") };
    let pace = Pace::Fast;
    window.ask(Command::Replay { script: Box::new(script), library, pace });
    window.wait("the end", |event| matches!(event, Event::Replayed).then_some(()));
    let again = window.snapshot();
    assert!(again.canvas == snapshot.canvas && again.palette == snapshot.palette, "to the bit");
}

#[test]
fn a_replay_can_be_cancelled_and_answers_commands_meanwhile() {
    let mut actions = vec![load("flat", "Vermilion")];
    for seed in 0..200 {
        actions.push(stroke(SurfaceId::Canvas, "flat", &wander(seed, 600, 32.0, 20.0)));
    }
    let (script, library) = script(actions);
    let mut window = Window::new(BackendChoice::Cpu);
    window.ask(Command::Replay { script, library, pace: Pace::Fast });
    window.wait("some progress", |event| match event {
        Event::Progress { done, .. } if *done > 1 => Some(()),
        _ => None,
    });
    let midway = window.snapshot();
    assert!(midway.canvas.wet.totals() != [0; 9], "the paint so far");
    window.ask(Command::Cancel);
    let (done, of) = window.wait("the last progress", |event| match event {
        Event::Progress { done, of } => Some((*done, *of)),
        _ => None,
    });
    let (text, hint, failed) = window.message();
    assert!(text.contains(&format!("stopped after {done} of {of} actions")), "{text}");
    assert!(!failed && hint.is_some_and(|hint| hint.contains("what was played stays")));
    window.wait("the end", |event| matches!(event, Event::Replayed).then_some(()));
    assert!(done < of, "{done} of {of}");
    assert!(window.snapshot().revision >= midway.revision, "the painting is still there");
}

#[test]
fn a_refused_action_ends_the_replay() {
    let lacking = Load {
        brush: "round".to_owned(),
        recipe: [("Viridian".to_owned(), 1.0)].into(),
        vehicle: 0.0,
        amount_mm: 0.1,
    };
    let (script, library) = script(vec![
        load("round", "Vermilion"),
        Action::Opacity { layer: paint::strokes::LayerRef::Dry(3), value: 0.5 },
        load("round", "Vermilion"),
    ]);
    let mut window = Window::open(BackendChoice::Cpu);
    window.ask(Command::Replay {
        script: script.clone(),
        library: library.clone(),
        pace: Pace::Fast,
    });
    let (text, _, failed) = window.message();
    assert!(failed && text.contains("after 1 of 3 actions, at action 1 (opacity)"), "{text}");
    window.wait("the end", |event| matches!(event, Event::Replayed).then_some(()));
    // A script that cannot be played leaves the painting unchanged.
    let before = window.snapshot();
    let mut hopeless = script;
    hopeless.actions = vec![Action::Load(lacking)];
    window.ask(Command::Replay { script: hopeless, library, pace: Pace::Fast });
    let (text, hint, failed) = window.message();
    assert!(failed && text.contains("Viridian"), "{text}");
    assert!(hint.is_some_and(|hint| hint.contains("Vermilion")), "the hint names the palette");
    assert_eq!(window.snapshot().revision, before.revision, "nothing was changed");
}
