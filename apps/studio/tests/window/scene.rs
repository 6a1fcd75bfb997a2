//! A scene of paint volumes in the program's own window, and after it was killed.

use std::path::Path;

use crate::program::Program;
use crate::screen::{Pixels, until};
use studio::files::Home;

/// Number of pixels with a colour.
fn colored(pixels: &Pixels) -> usize {
    let places = (0..pixels.height).flat_map(|y| (0..pixels.width).map(move |x| (x, y)));
    places
        .filter(|&(x, y): &(usize, usize)| {
            let [red, green, blue] = pixels.at(x, y);
            red.max(green).max(blue) - red.min(green).min(blue) > 24
        })
        .count()
}

/// Text of the autosaved script below `home`, if there is one.
fn kept(home: &Path) -> Option<String> {
    let entries = |folder: &Path| {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        entries.map(|entry| entry.path()).collect::<Vec<_>>()
    };
    let scenes = entries(&Home::in_folder(home).scenes());
    let generations = scenes.into_iter().flat_map(|scene| entries(&scene));
    let mut scripts = generations.map(|folder| folder.join("scene.toml"));
    scripts.find_map(|script| std::fs::read_to_string(script).ok())
}

#[test]
fn a_scene_is_poured_over_and_survives_a_kill() {
    let Some(screen) = crate::screen(1280, 800) else { return };
    let folder = tempfile::Builder::new().prefix("scene").tempdir().unwrap();
    let home = folder.path().to_owned();
    let program = Program::start(&screen, &home, "1280x800", &[Path::new("shape:village")]);
    let (x, y) = program.room.clone();
    let seen = || colored(&screen.pixels(x.clone(), y.clone()));
    let paper = || screen.pixels(x.clone(), y.clone()).at(5, 5) == [255; 3];
    until("the drawing is there", || (paper() && seen() == 0).then_some(()));
    let before = program.figures().unwrap().len();
    screen.drag(program.at(0.35, 0.7), program.at(0.5, 0.7), 4.0);
    let poured = seen();
    assert!(poured > 300, "{poured} pixels have a colour");
    let figures = program.figures().unwrap();
    let rates = figures[before..].iter().filter_map(|line| line["frames_a_second"].as_f64());
    eprintln!("frames a second while paint was poured: {:?}", rates.collect::<Vec<_>>());
    let script = until("the scene is kept", || {
        kept(&home).filter(|text| text.matches("[[pour]]").count() > 40)
    });
    program.kill();

    let program = Program::start(&screen, &home, "1280x800", &[]);
    let recover = crate::recovery::recover_button;
    let recover = until("a lost scene is offered", || recover(&screen.all()));
    screen.click(recover);
    until("its drawing is there", || (paper() && seen() == 0).then_some(()));
    screen.key(u32::from('p'), &[]);
    until("it plays", || (seen() > poured / 2).then_some(()));
    assert_eq!(kept(&home).as_ref(), Some(&script), "the autosave stays");
    program.kill();
}
