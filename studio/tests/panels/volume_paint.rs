//! Pigments, light and drying in the workspace of scenes, by a synthetic pen.

use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use pigment::library::PigmentLibrary;
use session::volumes::{Inside, SceneTool};

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
    let (from, to) = (at(&window, 0.5, 0.55), at(&window, 0.56, 0.58));
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
