//! Replay of recordings, pictures of the canvas along the history, reported tiles, refused
//! commands, and free space of the palette.

use std::convert::Infallible;
use std::ops::ControlFlow;
use std::sync::Arc;

use graphics::export::png8;
use graphics::gpu::BackendChoice;
use paint::brush::HeadShape;
use paint::document::{Document, Lighting};
use paint::light::Light;
use paint::scene::{picture, scene};
use paint::strokes::{
    Action, BrushSpec, LayerRef, Load, SampleDecimals, Squeeze, StrokeScript, SurfaceId,
};
use spectra::color::Rgb;
use web_time::Instant;

use super::strokes::{assert_same, session};
use super::window::{Window, load, small, stroke, wander};
use session::{Command, Event, HistoryShot, Origin, Pace, Snapshot};

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
    assert!(text.contains("9 of 9 actions"), "the message says what was played: {text}");
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
    assert_pictures(&mut window, &snapshot);
    // You can paint after the replay.
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
        Action::Opacity { layer: LayerRef::Dry(3), value: 0.5 },
        load("round", "Vermilion"),
    ]);
    let mut window = Window::open(BackendChoice::Cpu);
    window.ask(Command::Replay {
        script: script.clone(),
        library: library.clone(),
        pace: Pace::Fast,
    });
    let (text, _, failed) = window.message();
    assert!(failed && text.contains("after 1 of 3 actions, at action 2 (opacity)"), "{text}");
    window.wait("the end", |event| matches!(event, Event::Replayed).then_some(()));
    // If a script cannot be played, the painting stays as it was.
    let before = window.snapshot();
    let mut hopeless = script;
    hopeless.actions = vec![Action::Load(lacking)];
    window.ask(Command::Replay { script: hopeless, library, pace: Pace::Fast });
    let (text, hint, failed) = window.message();
    assert!(failed && text.contains("Viridian"), "{text}");
    assert!(hint.is_some_and(|hint| hint.contains("Vermilion")), "the hint names the palette");
    assert_eq!(window.snapshot().revision, before.revision, "nothing was changed");
}

/// Side of a pixel of the history's pictures, in cells. The canvas of 320 cells gives 160 pixels.
const STEP: usize = 2;

fn shots(window: &Window) -> Vec<Option<&HistoryShot>> {
    window.state().history_shots.shots.iter().map(Option::as_ref).collect()
}

/// Mean light of the cells of a pixel, from the tiles that the window received, in 8-bit sRGB.
fn seen(window: &Window, x: usize, y: usize) -> [u8; 3] {
    let cells = (0..STEP * STEP).map(|i| (STEP * x + i % STEP, STEP * y + i / STEP));
    let mut sum = [0.0; 3];
    for (x, y) in cells {
        let [r, g, b, _] = window.pictures.canvas[y * 320 + x];
        let light = Rgb([r, g, b].map(|byte| f64::from(byte) / 255.0)).linear().0;
        sum.iter_mut().zip(light).for_each(|(sum, light)| *sum += light);
    }
    Rgb(sum.map(|sum| sum / (STEP * STEP) as f64)).encoded().to_bytes()
}

fn heap(on: SurfaceId) -> Action {
    let recipe = [("Vermilion".to_owned(), 1.0)].into();
    Action::Squeeze(Squeeze { on, recipe, vehicle: 0.0, x_mm: 5.0, y_mm: 4.0, volume_mm3: 3.0 })
}

#[test]
fn every_action_has_a_picture_of_the_canvas_after_it() {
    let mut window = Window::open(BackendChoice::Cpu);
    let samples = wander(5, 120, 32.0, 20.0);
    window.act(load("round", "Bone Black"));
    window.stroke(SurfaceId::Canvas, "round", samples.chunks(20));
    window.act(heap(SurfaceId::Palette));
    window.act(heap(SurfaceId::Canvas));
    let snapshot = window.snapshot();
    window.wait_until("all pictures", |window| {
        let shots = shots(window);
        window.state().revision == snapshot.revision
            && shots.len() == 4
            && shots.iter().all(Option::is_some)
    });
    let shots: Vec<HistoryShot> = shots(&window).into_iter().flatten().cloned().collect();
    assert_eq!((shots[0].picture.width, shots[0].picture.height), (160, 100));
    assert_eq!(shots[0].changed, None, "nothing comes before the beginning");
    assert!(shots[1].changed.is_some(), "the stroke is outlined");
    assert_eq!(shots[2].changed, None, "the palette is not on the picture");
    assert!(Arc::ptr_eq(&shots[1].picture, &shots[2].picture), "kept once");
    // The heap has 3 mm3 and lies at 5, 4 mm. Its radius is 0.94 of the cube root, so it is 27
    // cells across.
    let [left, top, width, height] = shots[3].changed.expect("the heap is outlined");
    assert!(
        left <= 25 && left + width >= 25 && top <= 20 && top + height >= 20,
        "{:?}",
        shots[3].changed
    );
    assert!(width < 30 && height < 30, "only the heap: {:?}", shots[3].changed);
    let three = window.state().history_shots.bytes;
    assert_eq!(three, 3 * 160 * 100 * 4, "three different pictures");
    window.wait_until("the picture", |window| {
        window.pictures.canvas.iter().all(|cell| cell[3] == 255)
    });
    let mut far = 0;
    for (index, pixel) in shots[3].picture.pixels.iter().enumerate() {
        let seen = seen(&window, index % 160, index / 160);
        let apart = pixel.iter().zip(seen).map(|(a, b)| a.abs_diff(b)).max().expect("three bytes");
        far += usize::from(apart > 8);
    }
    // The screen clips highlights cell by cell, the picture after averaging.
    assert!(far < 160, "{far} of 16000 pixels are not those that the window shows");
}

#[test]
fn pictures_stay_with_their_actions_through_undo_and_adjustments() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(heap(SurfaceId::Canvas));
    window.act(Action::Dry { fraction: 1.0 });
    window.ask(Command::GoTo(1));
    let opened = window.snapshot();
    window.wait_until("two pictures", |window| {
        window.state().revision == opened.revision && shots(window).iter().flatten().count() == 3
    });
    let before: Vec<_> = shots(&window).into_iter().map(Option::<&HistoryShot>::cloned).collect();
    assert_eq!(window.state().history_done, 1);
    let [first, last] = [10.0, 200.0]
        .map(|azimuth_deg| Action::Light(Lighting { azimuth_deg, ..Lighting::default() }));
    window.ask(Command::Adjust(first));
    window.ask(Command::Adjust(last));
    window.ask(Command::EndAdjustment);
    let adjusted = window.snapshot();
    window.wait_until("the adjusted picture", |window| {
        let shots = shots(window);
        let light = window.state().history.last().is_some_and(|last| last.starts_with("light"));
        window.state().revision == adjusted.revision && light && shots[2].is_some()
    });
    let after: Vec<_> = shots(&window).into_iter().map(Option::<&HistoryShot>::cloned).collect();
    assert_eq!(after[..2], before[..2], "what was before stays");
    let [_, _, width, height] = after[2].as_ref().and_then(|shot| shot.changed).expect("a change");
    assert!(width > 150 && height > 90, "light from another side changes all: {width} x {height}");
}

/// Renders the document as an export does.
pub(crate) fn exported(document: &Document, light: &Light) -> Vec<[u8; 4]> {
    let picture = picture(document, &scene(document, light));
    let bytes = png8(&picture, document.cell_mm).unwrap().bytes;
    let file = image::load_from_memory(&bytes).unwrap().into_rgba8();
    file.pixels().map(|pixel| pixel.0).collect()
}

/// Asserts that the received tiles equal the rendered document, to the byte.
pub(crate) fn assert_pictures(window: &mut Window, snapshot: &Snapshot) {
    let light = Arc::clone(&window.state().light);
    let Lighting { illuminant, observer, .. } = &snapshot.canvas.lighting;
    assert_eq!(
        (illuminant, observer),
        (&window.state().lighting.illuminant, &window.state().lighting.observer),
        "the state tells of this light"
    );
    let canvas = exported(&snapshot.canvas, &light);
    let palette = exported(&snapshot.palette, &light);
    window.wait_until("the canvas as it is", |window| window.pictures.canvas == canvas);
    window.wait_until("the palette as it is", |window| window.pictures.palette == palette);
}

type Step<'a> = &'a dyn Fn(&mut Window);

#[test]
fn tiles_cover_every_change() {
    let mut window = Window::open(BackendChoice::Cpu);
    let lamp = Lighting { illuminant: "A".to_owned(), ..Lighting::default() };
    let far = wander(11, 150, 32.0, 20.0);
    let near = wander(12, 80, 10.0, 8.0);
    window.act(load("round", "Ultramarine"));
    window.act(load("flat", "Chrome Yellow"));
    let opacity = Action::Opacity { layer: LayerRef::Dry(0), value: 0.3 };
    let swap = Action::Swap {
        layer: LayerRef::Dry(0),
        from: "Ultramarine".to_owned(),
        to: "Emerald Green".to_owned(),
    };
    let steps: [(&str, Step<'_>); 12] = [
        ("a stroke", &|w| w.stroke(SurfaceId::Canvas, "round", far.chunks(9))),
        ("mixing", &|w| w.stroke(SurfaceId::Palette, "flat", near.chunks(4))),
        ("drying", &|w| w.act(Action::Dry { fraction: 0.6 })),
        ("a stroke over it", &|w| w.stroke(SurfaceId::Canvas, "flat", far.chunks(50))),
        ("undo", &|w| w.act(Action::Undo {})),
        ("another lamp", &|w| w.act(Action::Light(lamp.clone()))),
        ("a thinner layer", &|w| w.act(opacity.clone())),
        ("other pigments", &|w| w.act(swap.clone())),
        ("the first state", &|w| w.ask(Command::GoTo(1))),
        ("the last state", &|w| w.ask(Command::GoTo(6))),
        ("a lamp that turns", &|w| {
            for azimuth_deg in [10.0, 120.0] {
                let turned = Lighting { azimuth_deg, ..Lighting::default() };
                w.ask(Command::Adjust(Action::Light(turned)));
            }
            w.ask(Command::EndAdjustment);
        }),
        ("scraping", &|w| w.act(Action::Scrape { on: SurfaceId::Palette })),
    ];
    for (what, step) in steps {
        println!("after {what}");
        step(&mut window);
        let snapshot = window.snapshot();
        window.wait_until("the state", |window| window.state().revision == snapshot.revision);
        assert_pictures(&mut window, &snapshot);
    }
    assert!(
        !window.events.iter().any(|event| matches!(event, Event::Message { failed: true, .. })),
        "nothing was refused"
    );
}

#[test]
fn a_second_light_has_its_own_picture() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("round", "Vermilion"));
    let lamp = Lighting { illuminant: "FL11".to_owned(), ..Lighting::default() };
    window.ask(Command::SetSecondLight(Some(lamp.clone())));
    let samples = wander(13, 100, 32.0, 20.0);
    window.stroke(SurfaceId::Canvas, "round", samples.chunks(10));
    let snapshot = window.snapshot();
    window.wait_until("the state", |window| window.state().second_lighting.as_ref() == Some(&lamp));
    assert_pictures(&mut window, &snapshot);
    let Lighting { illuminant, observer, .. } = &lamp;
    let light = Light::named(&snapshot.canvas.library, illuminant, observer).unwrap();
    let under = Document { lighting: lamp.clone(), ..(*snapshot.canvas).clone() };
    let second = exported(&under, &light);
    window.wait_until("the second picture", |window| window.pictures.second == second);
    assert!(second != window.pictures.canvas, "the lights differ");
    let under = Document { lighting: lamp.clone(), ..(*snapshot.palette).clone() };
    let palette = exported(&under, &light);
    window.wait_until("the palette", |window| window.pictures.second_palette == palette);
    assert!(palette != window.pictures.palette, "the wood differs too");
    window.ask(Command::SetSecondLight(None));
    window.wait_until("no second light", |window| window.state().second_lighting.is_none());
}

#[test]
fn refusals_come_with_a_hint_and_leave_the_painting_alone() {
    let mut window = Window::open(BackendChoice::Cpu);
    window.act(load("round", "Ultramarine"));
    window.stroke(SurfaceId::Canvas, "round", [&wander(31, 40, 32.0, 20.0)[..]]);
    let before = window.snapshot();
    let moon = Lighting { illuminant: "moonlight".to_owned(), ..Lighting::default() };
    let other = Action::Palette(paint::strokes::PaletteSpec::from_names(["Zinc White"]));
    let broom = BrushSpec { shape: HeadShape::Round, size_mm: 4000.0 };
    let missing = Action::Opacity { layer: LayerRef::Dry(2), value: 0.5 };
    let refused = [
        (Command::Apply(load("rond", "Ultramarine")), "rond", Some("round")),
        (Command::Apply(load("round", "Ultramarin Blau")), "Ultramarin Blau", Some("Ultramarine")),
        (Command::Apply(missing.clone()), "dry layers", None),
        (Command::Adjust(missing), "dry layers", None),
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
    // These are moves after a PenDown with an unknown brush.
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

fn lay(window: &mut Window, pigment: &str, places: &[[f64; 2]]) {
    window.ask(Command::SqueezeInFreeSpace {
        recipe: [(pigment.to_owned(), 1.0)].into(),
        vehicle: 0.0,
        volume_mm3: 0.5,
        places: places.to_vec(),
        reach_mm: 1.0,
    });
}

/// Positions of the heaps in the recording, in mm.
fn heaps(window: &mut Window) -> Vec<[f64; 2]> {
    let recording = window.recording();
    let heaps = recording.actions.iter().filter_map(|action| match action {
        Action::Squeeze(Squeeze { on: SurfaceId::Palette, x_mm, y_mm, .. }) => Some([*x_mm, *y_mm]),
        _ => None,
    });
    heaps.collect()
}

#[test]
fn heaps_take_the_first_free_place_or_else_the_emptiest() {
    let mut window = Window::open(BackendChoice::Cpu);
    let places = [[-3.0, 2.0], [2.0, 2.0], [2.5, 2.5], [6.0, 2.0]];
    lay(&mut window, "Vermilion", &places);
    lay(&mut window, "Ultramarine", &places);
    assert_eq!(
        heaps(&mut window),
        [[2.0, 2.0], [6.0, 2.0]],
        "a place outside the surface is not used"
    );
    // Because the last place has more paint, the first has the least.
    lay(&mut window, "Zinc White", &[[6.0, 2.0]]);
    lay(&mut window, "Zinc White", &[[6.0, 2.0], [2.0, 2.0]]);
    assert_eq!(heaps(&mut window)[2..], [[6.0, 2.0], [2.0, 2.0]]);
    window.act(Action::Undo {});
    window.act(Action::Undo {});
    window.act(Action::Undo {});
    lay(&mut window, "Bone Black", &places);
    assert_eq!(heaps(&mut window).last(), Some(&[6.0, 2.0]), "undone paint leaves the place free");
}

#[test]
fn without_a_place_nothing_is_squeezed_and_a_message_is_reported() {
    let mut window = Window::open(BackendChoice::Cpu);
    lay(&mut window, "Vermilion", &[[50.0, 2.0]]);
    let (text, hint, failed) = window.message();
    assert!(failed && text.contains("no place") && hint.is_some(), "{text}");
    assert!(heaps(&mut window).is_empty(), "the palette is bare");
}
