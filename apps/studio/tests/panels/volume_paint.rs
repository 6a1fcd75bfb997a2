//! Pigments, light and drying in the workspace of scenes, by a synthetic pen.

use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use pigment::library::PigmentLibrary;
use session::volumes::{Inside, SceneTool};

use super::harness::{Window, button};
use super::volumes::{at, pour, rest, scene, volumes, wait};
use super::whole::drop_file;

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
    let names = |volumes: &studio::app::Volumes| -> Vec<String> {
        volumes.state().unwrap().tubes.iter().map(|tube| tube.name.clone()).collect()
    };
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
    let drag = |window: &mut Window, label: &'static str, number: usize| {
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
    };
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
    // Each is removed by its button; the others stay.
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
