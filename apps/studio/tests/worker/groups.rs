//! Strokes of a group are undone and repeated together, and replay to the bit.

use graphics::gpu::BackendChoice;
use paint::strokes::{Action, SurfaceId};
use session::{Command, Pace};

use super::pen::{load, stroke, wander};
use super::strokes::{assert_same, session};
use super::window::{Window, small};

/// Paints a stroke with a brush of the default set.
fn paint(window: &mut Window, seed: u64) {
    let samples = wander(seed, 60, 32.0, 20.0);
    window.stroke(SurfaceId::Canvas, "round", samples.chunks(20));
}

/// Waits until so many actions are done, of as many as the history has.
fn wait_for(window: &mut Window, done: usize, all: usize) {
    window.wait_until("the history", |window| {
        (window.state().history_done, window.state().history.len()) == (done, all)
    });
}

#[test]
fn one_undo_takes_back_the_strokes_of_a_group_and_one_redo_repeats_them() {
    let mut window = Window::open(BackendChoice::Cpu);
    let mut session = session();
    window.act(load("round", "Ultramarine"));
    session.apply(&load("round", "Ultramarine")).unwrap();
    paint(&mut window, 1);
    session.apply(&stroke(SurfaceId::Canvas, "round", &wander(1, 60, 32.0, 20.0))).unwrap();
    window.ask(Command::BeginGroup);
    (2..5).for_each(|seed| paint(&mut window, seed));
    window.ask(Command::EndGroup);
    paint(&mut window, 5);
    wait_for(&mut window, 5, 5);
    let whole = window.snapshot();
    for done in [4, 1, 0] {
        window.act(Action::Undo {});
        wait_for(&mut window, done, 5);
        if done == 1 {
            assert_same(&window.snapshot(), &mut session, "after the undo of the group");
        }
    }
    for done in [1, 4, 5] {
        window.act(Action::Redo {});
        wait_for(&mut window, done, 5);
    }
    let again = window.snapshot();
    assert!(*again.canvas == *whole.canvas, "all is repeated");
    // The recording holds an undo for each stroke, and replays to the bit.
    let recording = window.recording();
    let undos = recording.actions.iter().filter(|action| matches!(action, Action::Undo {})).count();
    assert_eq!(undos, 5);
    let session::Origin::Blank { library, .. } = small() else { panic!("a bare canvas") };
    window.ask(Command::Replay { script: Box::new(recording), library, pace: Pace::Fast });
    window.wait("the replay", |event| matches!(event, session::Event::Replayed).then_some(()));
    assert!(*window.snapshot().canvas == *whole.canvas, "to the bit");
}

#[test]
fn a_group_with_another_action_among_its_strokes_is_none() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("round", "Ultramarine"));
    window.ask(Command::BeginGroup);
    paint(&mut window, 1);
    window.act(Action::Dry { fraction: 0.5 });
    paint(&mut window, 2);
    window.ask(Command::EndGroup);
    wait_for(&mut window, 3, 3);
    window.act(Action::Undo {});
    wait_for(&mut window, 2, 3);
    // Reading does not disturb a group.
    window.ask(Command::BeginGroup);
    paint(&mut window, 3);
    window.snapshot();
    paint(&mut window, 4);
    window.ask(Command::EndGroup);
    wait_for(&mut window, 4, 4);
    window.act(Action::Undo {});
    wait_for(&mut window, 2, 4);
}
