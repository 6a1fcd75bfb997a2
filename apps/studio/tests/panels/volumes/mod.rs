//! The workspace of scenes: the whole window with a real worker and a synthetic pen.

mod files;

use eframe::egui::{
    Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, TouchPhase, vec2,
};
use egui_kittest::kittest::Queryable;
use pigment::library::PigmentLibrary;
use session::volumes::{Inside, SceneTool, Show, Subject};
use studio::app::Volumes;
use web_time::{Duration, Instant};

use super::harness::{Window, button};
use super::light::drop_file;

pub(super) const PATIENCE: Duration = Duration::from_secs(60);

pub(super) fn scene(name: &'static str) -> Window {
    let mut window = Window::open(name);
    let context = window.harness().ctx.clone();
    window.studio_mut().open_scene(&context, Subject::Shape("village".to_owned()));
    wait(&mut window, "the first picture", |volumes| volumes.picture().is_some());
    window
}

pub(super) fn volumes(window: &Window) -> &Volumes {
    window.studio().volumes.as_ref().unwrap()
}

pub(super) fn wait(window: &mut Window, what: &str, done: impl Fn(&Volumes) -> bool) {
    let start = Instant::now();
    while !done(volumes(window)) {
        assert!(start.elapsed() < PATIENCE, "{what} does not come");
        std::thread::sleep(Duration::from_millis(3));
        window.harness().step();
    }
}

/// A point of the picture by its share of width and height.
pub(super) fn at(window: &Window, x: f32, y: f32) -> Pos2 {
    let rect = volumes(window).rect();
    rect.min + vec2(x, y) * rect.size()
}

/// Number of coloured pixels of the last picture.
fn colored(volumes: &Volumes) -> usize {
    volumes.picture().map_or(0, |picture| {
        picture
            .pixels
            .iter()
            .filter(|[red, green, blue, _]: &&[u8; 4]| {
                red.max(green).max(blue) - red.min(green).min(blue) > 24
            })
            .count()
    })
}

fn in_color(window: &Window) -> Pos2 {
    let picture = volumes(window).picture().unwrap();
    let width = picture.width;
    let height = picture.height;
    let places = (2..height - 2).flat_map(|y| (2..width - 2).map(move |x| (x, y)));
    let mut deep = places.filter(|&(x, y)| {
        let around = (y - 2..=y + 2).flat_map(|y| (x - 2..=x + 2).map(move |x| y * width + x));
        around
            .map(|at| picture.pixels[at])
            .all(|[red, green, blue, _]| red.max(green).max(blue) - red.min(green).min(blue) > 24)
    });
    let (x, y) = deep.next().expect("there is colour");
    at(window, (x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32)
}

/// Holds the pen down until the picture shows colour, moves the pen, and lifts it.
pub(super) fn pour(window: &mut Window) {
    let from = at(window, 0.5, 0.55);
    window.frame(vec![Event::PointerMoved(from)]);
    window.frame(vec![button(from, true)]);
    wait(window, "colour", |volumes| colored(volumes) > 100);
    let to = at(window, 0.55, 0.58);
    window.frame(vec![Event::PointerMoved(to)]);
    wait(window, "time", |volumes| volumes.state().unwrap().time.step > 60);
    window.frame(vec![button(to, false)]);
    wait(window, "the end of the pour", |volumes| {
        let state = volumes.state().unwrap();
        state.events.first().is_some_and(|event| state.time.step > event.to)
    });
}

/// Stops time and waits for the final picture, with all pixels and samples.
pub(super) fn rest(window: &mut Window) {
    if volumes(window).state().unwrap().time.playing {
        window.key(Modifiers::NONE, Key::P);
    }
    wait(window, "rest", |volumes| {
        let time = volumes.state().unwrap().time;
        volumes.picture().is_some_and(|shown| shown.fine && shown.step == time.step)
            && !time.playing
    });
}

fn key(window: &mut Window, key: Key) {
    window.key(Modifiers::NONE, key);
}

#[test]
fn colour_is_poured_played_back_and_taken_back() {
    let mut window = scene("volumes");
    assert_eq!(colored(volumes(&window)), 0, "the drawing is grey");
    pour(&mut window);
    rest(&mut window);
    window.save("volumes");
    let end = volumes(&window).picture().unwrap().clone();
    let size = volumes(&window).rect().size();
    assert_eq!((end.width, end.height), (size.x as usize, size.y as usize), "at rest it is whole");
    assert_eq!(volumes(&window).state().unwrap().events.len(), 1);
    window.click("From the start");
    wait(&mut window, "the start", |volumes| colored(volumes) == 0);
    let track = window.harness().get_by_label("Time").rect();
    let right = Pos2::new(track.right() - 2.0, track.center().y);
    window.pen_stroke(&[track.center(), right, right]);
    wait(&mut window, "the end", |volumes| volumes.state().unwrap().time.step == end.step);
    rest(&mut window);
    assert!(volumes(&window).picture().unwrap() == &end, "the same bytes");
    window.key(Modifiers::COMMAND, Key::Z);
    wait(&mut window, "undo", |volumes| volumes.state().unwrap().events.is_empty());
    wait(&mut window, "a grey drawing", |volumes| colored(volumes) == 0);
}

#[test]
fn the_middle_button_and_the_wheel_move_the_camera_also_while_paint_flows() {
    let mut window = scene("volumes-camera");
    let start = volumes(&window).orbit;
    let pen = at(&window, 0.5, 0.55);
    window.frame(vec![Event::PointerMoved(pen)]);
    window.frame(vec![button(pen, true)]);
    wait(&mut window, "time", |volumes| volumes.state().unwrap().time.step > 5);
    let mut drag = |shift: bool, by| {
        let modifiers = Modifiers { shift, ..Modifiers::NONE };
        let middle = |pos, pressed| Event::PointerButton {
            pos,
            button: PointerButton::Middle,
            pressed,
            modifiers,
        };
        window.frame(vec![Event::ModifiersChanged(modifiers), middle(pen, true)]);
        window.frame(vec![Event::PointerMoved(pen + 0.5 * by)]);
        window.frame(vec![Event::PointerMoved(pen + by)]);
        window.frame(vec![middle(pen + by, false)]);
        window.frame(vec![Event::ModifiersChanged(Modifiers::NONE), Event::PointerMoved(pen)]);
        volumes(&window).orbit.camera()
    };
    let turned = drag(false, vec2(120.0, -30.0));
    assert_eq!(turned.target, start.camera().target, "it turns about the middle");
    assert!(turned.eye.distance(start.camera().eye) > 0.1, "{turned:?}");
    let moved = drag(true, vec2(40.0, 20.0));
    assert!(moved.target.distance(turned.target) > 0.01, "{moved:?}");
    assert!(volumes(&window).state().unwrap().time.playing, "time runs on");
    window.frame(vec![button(pen, false)]);
    window.frame(vec![Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: vec2(0.0, 3.0),
        phase: TouchPhase::Move,
        source: MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    }]);
    window.harness().run_steps(30);
    let near = volumes(&window).orbit.camera();
    let [near, far] = [near, moved].map(|camera| camera.eye.distance(camera.target));
    assert!(near < 0.95 * far, "the wheel comes nearer");
    key(&mut window, Key::Home);
    assert_eq!(volumes(&window).orbit.camera(), start.camera(), "Home frames the scene");
    assert_eq!(volumes(&window).state().unwrap().events.len(), 1, "one pour");
}

#[test]
fn keys_choose_what_is_shown_and_what_is_poured() {
    let mut window = scene("volumes-keys");
    let look = |volumes: &Volumes| volumes.state().unwrap().look;
    key(&mut window, Key::V);
    wait(&mut window, "volumes", move |volumes| look(volumes).show == Show::Volumes);
    key(&mut window, Key::V);
    wait(&mut window, "the picture", move |volumes| look(volumes).show == Show::Final);
    key(&mut window, Key::H);
    wait(&mut window, "no strokes", move |volumes| !look(volumes).hatching);
    key(&mut window, Key::G);
    wait(&mut window, "a glaze", move |volumes| look(volumes).inside == Inside::Glaze);
    key(&mut window, Key::Num4);
    let before = volumes(&window).tools.grip.rate_mm3_s;
    key(&mut window, Key::CloseBracket);
    let grip = volumes(&window).tools.grip;
    assert!(grip.tube == 3 && grip.rate_mm3_s > before, "{grip:?}");
    key(&mut window, Key::OpenBracket);
    assert!((volumes(&window).tools.grip.rate_mm3_s - before).abs() < 1e-9);
    key(&mut window, Key::E);
    assert_eq!(volumes(&window).tools.grip.tool, SceneTool::Lift);
    key(&mut window, Key::Period);
    wait(&mut window, "a step", |volumes| volumes.state().unwrap().time.step == 1);
    key(&mut window, Key::P);
    wait(&mut window, "time", |volumes| volumes.state().unwrap().time.step > 20);
    key(&mut window, Key::P);
    wait(&mut window, "a pause", |volumes| !volumes.state().unwrap().time.playing);
    key(&mut window, Key::R);
    wait(&mut window, "the start", |volumes| volumes.state().unwrap().time.step == 0);
    let end = volumes(&window).state().unwrap().time.end;
    key(&mut window, Key::P);
    wait(&mut window, "the end", move |volumes| {
        let time = volumes.state().unwrap().time;
        time.step == end && !time.playing
    });
    window.key(Modifiers::COMMAND, Key::E);
    assert!(!window.studio().shows_volumes, "back to the easel");
    assert!(window.studio().painting().is_some(), "which is as it was");
    key(&mut window, Key::B);
    assert_eq!(volumes(&window).tools.grip.tool, SceneTool::Lift, "its keys are its own");
}

#[test]
fn a_right_click_tells_what_is_there() {
    let mut window = scene("volumes-here");
    pour(&mut window);
    rest(&mut window);
    let pos = in_color(&window);
    window.frame(vec![Event::PointerMoved(pos)]);
    for pressed in [true, false] {
        window.frame(vec![Event::PointerButton {
            pos,
            button: PointerButton::Secondary,
            pressed,
            modifiers: Modifiers::NONE,
        }]);
    }
    wait(&mut window, "the answer", |volumes| volumes.here().is_some());
    let here = volumes(&window).here().unwrap().clone();
    assert!(here.place.is_some() && here.volumes > 0, "{here:?}");
    let paint = here.paint.as_ref().unwrap();
    let library = &volumes(&window).state().unwrap().library;
    assert_eq!(library[paint.slots[0].unwrap()].name, "Zinc White");
    let height: f64 = paint.amounts_mm.iter().sum();
    assert!(height > 0.0 && height == paint.amounts_mm[0], "{here:?}");
    window.frame(Vec::new());
    window.save("volumes-card");
    // Card and panel show CIELAB, recipe, height and region as the easel's eyedropper does.
    let lab = here.lab.map(|value| format!("{value:.2}")).join(" ");
    let counts = |window: &mut Window| {
        [lab.as_str(), "Zinc White", &format!("{height:.3} mm"), "Copy Paint"]
            .map(|label| window.harness().query_all_by_label(label).count())
    };
    assert!(counts(&mut window).into_iter().all(|count| count > 0), "{:?}", counts(&mut window));
    assert!(window.harness().query_by_label_contains("inside of").is_some());
    assert_eq!(volumes(&window).state().unwrap().events.len(), 1, "it pours nothing");
    key(&mut window, Key::Escape);
    assert!(volumes(&window).here().is_none(), "Escape closes the card");
    window.frame(Vec::new());
    assert_eq!(counts(&mut window)[3], 0, "the card is closed");
    window.click("Here");
    assert!(counts(&mut window).into_iter().all(|count| count > 0), "the panel keeps it");
    window.save("volumes-here-panel");
}

#[test]
fn every_part_of_the_workspace_is_within_the_window() {
    let mut window = scene("volumes-layout");
    let whole = window.whole();
    for tab in ["Light", "Here", "Events", "Export"] {
        window.click(tab);
        window.save(&format!("volumes-{}", tab.to_lowercase()));
    }
    for label in ["Play", "Step", "From the start", "Time", "Script...", "Animation...", "Rate"] {
        let rect = window.harness().get_all_by_label(label).next().unwrap().rect();
        assert!(whole.contains_rect(rect), "{label}: {rect:?}");
    }
    let scene = volumes(&window).rect();
    assert!(scene.width() > 900.0 && scene.height() > 650.0, "{scene:?}");
}

#[test]
fn the_light_on_pigments_is_chosen_in_the_panel() {
    let mut window = scene("volumes-light");
    pour(&mut window);
    window.key(Modifiers::NONE, Key::G);
    wait(&mut window, "a glaze", |volumes| {
        let state = volumes.state().unwrap();
        state.look.inside == Inside::Glaze && !state.prepares
    });
    rest(&mut window);
    let by_day = volumes(&window).picture().unwrap().pixels.clone();
    window.click("Light");
    window.click("Illuminant: D65");
    window.click("A");
    wait(&mut window, "lamplight", |volumes| {
        let state = volumes.state().unwrap();
        state.illuminant == "A" && !state.prepares
    });
    rest(&mut window);
    wait(&mut window, "another picture", move |volumes| {
        volumes.picture().is_some_and(|shown| shown.fine && shown.pixels != by_day)
    });
    window.save("volumes-lamp");
    assert!(window.harness().query_by_label("Illuminant: A").is_some());
}

#[test]
fn tubes_take_pigments_of_the_library_and_of_another_that_is_dropped() {
    let mut window = scene("volumes-tubes");
    fn names(volumes: &Volumes) -> Vec<String> {
        volumes.state().unwrap().tubes.iter().map(|tube| tube.name.clone()).collect()
    }
    window.click("Tube...");
    window.save("volumes-chooser");
    window.click("Viridian");
    wait(&mut window, "another pigment", |volumes| names(volumes)[0] == "Viridian");
    let mut library = PigmentLibrary::van_gogh_oils();
    library.title = "mine".to_owned();
    library.pigments.retain(|pigment| pigment.name != "Vermilion");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.json");
    std::fs::write(&path, library.to_json()).unwrap();
    drop_file(&mut window, &path);
    wait(&mut window, "the library", |volumes| volumes.state().unwrap().library.title == "mine");
    assert_eq!(names(volumes(&window))[1], "Eosin Lake (wax)");
}

#[test]
fn the_dryer_dries_below_the_pen_and_its_key_dries_all() {
    let mut window = scene("volumes-dry");
    pour(&mut window);
    rest(&mut window);
    window.key(Modifiers::NONE, Key::D);
    assert_eq!(volumes(&window).tools.grip.tool, SceneTool::Dry);
    assert!(window.harness().query_all_by_label("Radius").next().is_some(), "it has a radius");
    window.save("volumes-dry");
    let from = at(&window, 0.5, 0.55);
    let to = at(&window, 0.56, 0.58);
    window.pen_stroke(&[from, from + 0.5 * (to - from), to]);
    wait(&mut window, "an event", |volumes| volumes.state().unwrap().events.len() == 2);
    assert_eq!(volumes(&window).state().unwrap().events[1].label, "dry");
    rest(&mut window);
    window.key(Modifiers::SHIFT, Key::D);
    wait(&mut window, "another", |volumes| volumes.state().unwrap().events.len() == 3);
    assert_eq!(volumes(&window).state().unwrap().events[2].label, "dry all paint");
    window.click("Events");
    window.save("volumes-dried");
}

#[test]
fn the_pen_pushes_and_lifts_paint_and_the_list_takes_events_back() {
    let mut window = scene("volumes-push");
    pour(&mut window);
    fn drag(window: &mut Window, label: &'static str, number: usize) {
        let from = at(window, 0.5, 0.55);
        let to = at(window, 0.56, 0.58);
        window.frame(vec![Event::PointerMoved(from)]);
        window.frame(vec![button(from, true)]);
        let begun = volumes(window).state().unwrap().time.step;
        wait(window, "time", |volumes| volumes.state().unwrap().time.step > begun + 10);
        window.frame(vec![Event::PointerMoved(to)]);
        wait(window, "more time", |volumes| volumes.state().unwrap().time.step > begun + 40);
        window.frame(vec![button(to, false)]);
        wait(window, label, |volumes| {
            let state = volumes.state().unwrap();
            let event = state.events.get(number - 1);
            event.is_some_and(|event| event.label == label && event.to < state.time.step)
        });
    }
    let tally = |window: &Window| volumes(window).state().unwrap().tally;
    let before = tally(&window);
    window.key(Modifiers::NONE, Key::W);
    drag(&mut window, "push", 2);
    assert_eq!(tally(&window).lifted_mm3, 0.0, "air takes nothing up");
    assert_eq!(tally(&window).poured_mm3, before.poured_mm3);
    window.key(Modifiers::NONE, Key::E);
    drag(&mut window, "lift", 3);
    let lifted = tally(&window);
    assert!(lifted.lifted_mm3 > 0.0, "the sponge holds paint: {lifted:?}");
    let there = lifted.on_surfaces_mm3 + lifted.lifted_mm3;
    assert!((there - lifted.poured_mm3).abs() < 1e-9, "nothing is lost: {lifted:?}");
    rest(&mut window);
    let tools: Vec<_> =
        volumes(&window).state().unwrap().events.iter().map(|own| own.tool).collect();
    assert_eq!(tools, [SceneTool::Pour, SceneTool::Push, SceneTool::Lift].map(Some));
    // A button removes each event. The others stay.
    window.click("Events");
    window.save("volumes-events-list");
    window.click("Remove event 3");
    wait(&mut window, "paint without the sponge", |volumes| {
        let state = volumes.state().unwrap();
        state.events.len() == 2 && state.tally.lifted_mm3 == 0.0
    });
    window.click("Remove event 1");
    wait(&mut window, "a surface without paint", |volumes| {
        let state = volumes.state().unwrap();
        let labels: Vec<&str> = state.events.iter().map(|event| event.label.as_str()).collect();
        labels == ["push"] && state.tally.poured_mm3 == 0.0
    });
}
