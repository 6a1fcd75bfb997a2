//! Refused commands report a message and change nothing.

use std::sync::Arc;

use graphics::gpu::BackendChoice;
use paint::brush::HeadShape;
use paint::document::Lighting;
use paint::strokes::{Action, BrushSpec, LayerRef, SampleDecimals, SurfaceId};
use session::{Command, Event, Origin};

use super::pen::{load, wander};
use super::window::{Window, small};

#[test]
fn refusals_come_with_a_hint_and_leave_the_painting_alone() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("round", "Ultramarine"));
    window.stroke(SurfaceId::Canvas, "round", [&wander(31, 40, 32.0, 20.0)[..]]);
    let before = window.snapshot();
    let moon = Lighting { illuminant: "moonlight".to_owned(), ..Lighting::default() };
    let other = Action::Palette(paint::strokes::PaletteSpec::from_names(["Zinc White"]));
    let broom = BrushSpec { shape: HeadShape::Round, size_mm: 4000.0 };
    let missing = |layer| Action::Opacity { layer: LayerRef::Dry(layer), value: 0.5 };
    let refused = [
        (Command::Apply(load("rond", "Ultramarine")), "rond", Some("round")),
        (Command::Apply(load("round", "Ultramarin Blau")), "Ultramarin Blau", Some("Ultramarine")),
        (Command::Apply(missing(2)), "dry layers", None),
        (Command::Adjust(missing(2)), "dry layers", None),
        (Command::Apply(Action::Light(moon.clone())), "moonlight", None),
        (Command::SetSecondLight(Some(moon)), "moonlight", None),
        (Command::Apply(other), "Ultramarine is still wet", Some("dry the painting")),
        (Command::SetBrush { name: "broom".to_owned(), spec: broom }, "4000", None),
        (
            Command::PenDown {
                surface: SurfaceId::Canvas,
                brush: "fann".to_owned(),
                decimals: SampleDecimals::RECORDING,
            },
            "fann",
            Some("fan"),
        ),
    ];
    for (command, words, hinted) in refused {
        let asked = format!("{command:?}");
        window.ask(command);
        let (text, hint, failed) = window.message();
        assert!(failed && text.contains(words), "{asked}: {text}");
        if let Some(hinted) = hinted {
            assert!(hint.as_ref().is_some_and(|hint| hint.contains(hinted)), "{asked}: {hint:?}");
        }
    }
    // Pen moves after a PenDown with an unknown brush.
    window.ask(Command::PenUp);
    let after = window.snapshot();
    assert!(after.canvas == before.canvas && after.palette == before.palette, "nothing changed");
    assert_eq!(after.revision, before.revision, "the revision is unchanged");
}

#[test]
fn a_command_without_effect_reports_a_message() {
    let mut window = Window::open(BackendChoice::Cpu);
    for (action, words) in [
        (Action::Undo {}, "nothing to undo"),
        (Action::Redo {}, "nothing to redo"),
        (Action::Dry { fraction: 1.0 }, "no wet paint"),
    ] {
        window.act(action);
        let (text, _, failed) = window.message();
        assert!(text.contains(words) && !failed, "{text}");
    }
}

#[test]
fn commands_without_a_painting_fail_and_a_failed_open_keeps_the_painting() {
    let mut window = Window::new(BackendChoice::Cpu);
    window.act(Action::Undo {});
    let (text, hint, failed) = window.message();
    assert!(failed && text.contains("no painting is open for undo"), "{text}");
    assert!(hint.is_some(), "with a hint");
    window.ask(Command::Open(small()));
    window.wait("a painting", |event| matches!(event, Event::Opened(_)).then_some(()));
    let before = window.snapshot();
    let Origin::Blank { mut script, library } = small() else { panic!("a bare canvas") };
    script.canvas.width_mm = 1e5;
    window.ask(Command::Open(Origin::Blank { script, library }));
    let (text, _, failed) = window.message();
    assert!(failed && text.contains("canvas"), "{text}");
    assert!(Arc::clone(&window.snapshot().canvas) == before.canvas, "the painting is still open");
}

#[test]
fn a_painting_with_a_missing_lamp_file_opens_under_daylight() {
    let mut window = Window::open(BackendChoice::Cpu);
    let mut document = (*window.snapshot().canvas).clone();
    document.lighting.illuminant = "lost-lamp.csv".to_owned();
    document.title = "study".to_owned();
    window.ask(Command::Open(Origin::Painting(Box::new(document.clone()))));
    let (text, _, failed) = window.message();
    assert!(!failed && text.contains("lost-lamp.csv") && text.contains("D65"), "{text}");
    let lighting = window.wait("the painting", |event| match event {
        Event::Opened(state) => Some(state.lighting.clone()),
        _ => None,
    });
    assert_eq!(lighting.illuminant, "D65");
    assert_eq!(window.state().title, "study");
    assert_eq!(window.recording().start.as_deref(), Some("study.exr"));
    // A recovered session continues without a recording.
    let palette = Box::new((*window.snapshot().palette).clone());
    document.lighting = Lighting::default();
    let canvas = Box::new(document);
    window.ask(Command::Open(Origin::Recovered { canvas, palette, kept: None }));
    window.wait("the session", |event| matches!(event, Event::Opened(_)).then_some(()));
    window.ask(Command::Recording(7));
    let (text, _, _) = window.message();
    assert!(text.contains("no recording"), "{text}");
}
