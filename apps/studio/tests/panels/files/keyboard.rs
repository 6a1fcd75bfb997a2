//! Enter in the dialogs of files: a field that has the keyboard takes it, else the default button.

use std::path::Path;

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use session::{Command, Origin};
use studio::files::FileRequest;

use super::bench::{Window, ask, folder, painted, shows, type_name, until, window};

/// Replaces the text of the field with this number among the text fields.
fn type_into_field(window: &mut Window, number: usize, text: &str) {
    window.get_all_by_role(Role::TextInput).nth(number).unwrap().focus();
    window.step();
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.step();
    window.get_all_by_role(Role::TextInput).nth(number).unwrap().type_text(text);
    window.step();
}

/// Presses Enter and draws what follows from it.
fn enter(window: &mut Window, modifiers: Modifiers) {
    window.key_press_modifiers(modifiers, Key::Enter);
    window.run_steps(4);
}

/// Width in mm of the canvas that was begun, if one was.
fn begun_width(window: &Window) -> Option<f64> {
    match &window.state().commands[..] {
        [] => None,
        [Command::Open(Origin::Blank { script, .. })] => Some(script.canvas.width_mm),
        other => panic!("{other:?}"),
    }
}

fn exr_files(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder).unwrap();
    entries
        .filter(|entry| entry.as_ref().unwrap().path().extension() == Some("exr".as_ref()))
        .count()
}

#[test]
fn enter_in_the_folder_field_opens_the_folder_and_saves_nothing() {
    let (folder, _) = folder();
    let album = folder.path().join("album");
    std::fs::create_dir(&album).unwrap();
    let mut window = window(folder.path(), painted("A"));
    ask(&mut window, FileRequest::SaveAs);
    type_into_field(&mut window, 0, &album.display().to_string());
    enter(&mut window, Modifiers::NONE);
    assert!(window.state_mut().files().has_dialog(), "the dialog stays");
    assert_eq!(exr_files(folder.path()) + exr_files(&album), 0, "nothing was saved");
    assert_eq!(window.state_mut().files().path(), None);
    enter(&mut window, Modifiers::NONE);
    until(&mut window, "the file", |window| window.state_mut().files().path().is_some());
    assert_eq!(exr_files(&album), 1, "the second Enter saves in the folder that was opened");
}

#[test]
fn enter_in_the_name_field_asks_before_a_file_is_replaced() {
    let (folder, path) = folder();
    std::fs::write(&path, "dear").unwrap();
    let mut window = window(folder.path(), painted("A"));
    ask(&mut window, FileRequest::SaveAs);
    type_name(&mut window, "study");
    enter(&mut window, Modifiers::NONE);
    assert!(shows(&window, "study.exr already exists"), "the window asks");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "dear");
    enter(&mut window, Modifiers::NONE);
    until(&mut window, "the file", |window| window.state_mut().files().path() == Some(&path));
}

#[test]
fn enter_in_a_number_field_ends_the_field_and_begins_no_painting() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    ask(&mut window, FileRequest::New);
    let width = |window: &mut Window, text: &str| {
        window.get_all_by_role(Role::SpinButton).next().unwrap().click();
        window.run_steps(2);
        window.key_press_modifiers(Modifiers::COMMAND, Key::A);
        window.step();
        window.get_by(|node| node.is_focused()).type_text(text);
        window.step();
    };
    width(&mut window, "64");
    enter(&mut window, Modifiers::NONE);
    assert!(window.state_mut().files().has_dialog(), "the dialog stays");
    assert_eq!(begun_width(&window), None);
    enter(&mut window, Modifiers::NONE);
    until(&mut window, "the canvas", |window| begun_width(window) == Some(64.0));

    window.state_mut().commands.clear();
    ask(&mut window, FileRequest::New);
    width(&mut window, "48");
    enter(&mut window, Modifiers::COMMAND);
    until(&mut window, "the canvas", |window| begun_width(window) == Some(48.0));
}
