//! Kept mixtures: their file in the home folder, import and export.

use std::path::Path;

use eframe::egui::Key;
use eframe::egui::accesskit::Role;
use egui_kittest::Node;
use egui_kittest::kittest::{NodeT, Queryable};
use paint::strokes::Recipe;
use session::swatches::{KeptMixture, SwatchBook, SwatchChange};
use spectra::swatch_file::read_gpl;
use studio::files::{FileRequest, SwatchFormat};

use super::bench::{Window, ask, folder, painted, shows, type_name, until, window};

fn kept(name: &str) -> KeptMixture {
    let recipe: Recipe = [("Vermilion".to_owned(), 2.0), ("Zinc White".to_owned(), 1.0)].into();
    KeptMixture {
        name: name.to_owned(),
        library: "Oils".to_owned(),
        recipe,
        vehicle: 0.1,
        color: "#c06050".to_owned(),
        light: "D65".to_owned(),
    }
}

fn keep(window: &mut Window, name: &str) {
    let change = SwatchChange::Keep(Box::new(kept(name)));
    ask(window, FileRequest::Swatches(change));
}

fn names(window: &mut Window) -> Vec<String> {
    let book = window.state_mut().files().swatches();
    book.swatches.iter().map(|kept| kept.name.clone()).collect()
}

fn file(folder: &Path) -> Option<SwatchBook> {
    let text = std::fs::read_to_string(folder.join("own").join("swatches.json")).ok()?;
    SwatchBook::from_json("swatches.json", &text).ok()
}

#[test]
fn mixtures_are_written_to_the_home_folder_and_read_at_the_next_start() {
    let (folder, _) = folder();
    let mut first = window(folder.path(), painted("A"));
    keep(&mut first, "red");
    keep(&mut first, "red");
    assert_eq!(names(&mut first), ["red", "red 2"]);
    until(&mut first, "the file", |_| file(folder.path()).is_some_and(|f| f.swatches.len() == 2));
    ask(&mut first, FileRequest::Swatches(SwatchChange::Remove(0)));
    first.state_mut().files().finish();
    drop(first);
    let mut next = window(folder.path(), painted("A"));
    until(&mut next, "the list", |window| names(window) == ["red 2"]);
}

#[test]
fn a_list_that_cannot_be_read_is_reported_and_not_overwritten() {
    let (folder, _) = folder();
    let own = folder.path().join("own");
    std::fs::create_dir_all(&own).unwrap();
    std::fs::write(own.join("swatches.json"), r#"{"format": "impasto-swatches"}"#).unwrap();
    let mut window = window(folder.path(), painted("A"));
    until(&mut window, "the report", |window| shows(window, "`version`"));
    keep(&mut window, "red");
    until(&mut window, "the new file", |_| file(folder.path()).is_some());
    let aside = std::fs::read_to_string(own.join("swatches.broken.json")).unwrap();
    assert_eq!(aside, r#"{"format": "impasto-swatches"}"#);
}

#[test]
fn mixtures_go_to_other_programs_and_come_back() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    keep(&mut window, "red");
    for (format, name) in [(SwatchFormat::Gpl, "colours"), (SwatchFormat::Json, "mixtures")] {
        ask(&mut window, FileRequest::ExportSwatches(format));
        assert!(shows(&window, "Export the kept mixtures"));
        type_name(&mut window, name);
        window.key_press(Key::Enter);
        let path = folder.path().join(format!("{name}.{}", format.ending()));
        until(&mut window, "the file", |_| path.is_file());
    }
    let text = std::fs::read(folder.path().join("colours.gpl")).unwrap();
    let colors = read_gpl("colours.gpl", &text).unwrap();
    let library = window.state().painting.library.clone();
    let viewing = window.state().painting.light.viewing.clone();
    let wanted = library.color([("Vermilion", 2.0), ("Zinc White", 1.0)], &viewing).unwrap();
    let hex = colors.swatches[0].color.srgb().unwrap().to_hex();
    assert_eq!((colors.swatches[0].name.as_str(), hex), ("red", wanted.hex()));

    ask(&mut window, FileRequest::Swatches(SwatchChange::Remove(0)));
    ask(&mut window, FileRequest::ImportSwatches);
    choose(&mut window, "mixtures.json");
    until(&mut window, "the mixture", |window| names(window) == ["red"]);
    ask(&mut window, FileRequest::ImportSwatches);
    choose(&mut window, "colours.gpl");
    until(&mut window, "the colours", |window| {
        let colors = window.state_mut().files().take_colors();
        colors.is_some_and(|colors| colors.swatches.len() == 1)
    });
    assert_eq!(names(&mut window), ["red"], "colours are no mixtures");
}

/// Row of a file in the browser, which is a button; notices may name the file too.
fn row<'a>(window: &'a Window, name: &'a str) -> Option<Node<'a>> {
    let mut named = window.query_all_by_label_contains(name);
    named.find(|node| node.accesskit_node().role() == Role::Button)
}

/// Chooses a file that the browser lists.
fn choose(window: &mut Window, name: &str) {
    until(window, "the row", |window| row(window, name).is_some());
    row(window, name).unwrap().click();
    window.run_steps(4);
    window.key_press(Key::Enter);
    window.run_steps(4);
}
