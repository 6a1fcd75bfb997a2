//! The file browser: pictures of files, places, order and filter.

use eframe::egui::{Event, Key};
use image::{Rgb, RgbImage};
use studio::files::{BrowserOrder, FileRequest};

use super::bench::{Window, ask, click, folder, painted, picture, shows, until, window};

fn album() -> (tempfile::TempDir, Window) {
    let (folder, path) = folder();
    std::fs::create_dir(folder.path().join("album")).unwrap();
    std::fs::write(&path, paint::file::write(&painted("A")).unwrap()).unwrap();
    let photograph = RgbImage::from_pixel(60, 40, Rgb([200, 60, 30]));
    photograph.save(folder.path().join("photo.png")).unwrap();
    std::fs::write(folder.path().join("broken.exr"), "no picture").unwrap();
    let mut window = window(folder.path(), painted("B"));
    ask(&mut window, FileRequest::Open(None));
    until(&mut window, "the folder", |window| shows(window, "study.exr"));
    (folder, window)
}

#[test]
fn the_form_and_order_of_files_are_kept() {
    let (_folder, mut window) = album();
    for name in ["Grid", "Date"] {
        click(&mut window, name);
    }
    let look = window.state_mut().files().preferences.browser;
    assert!(look.grid && look.order == BrowserOrder::Date, "{look:?}");
    for _ in 0..200 {
        std::thread::sleep(std::time::Duration::from_millis(5));
        window.step();
    }
    picture(&mut window, "grid");
    assert!(shows(&window, "album/") && shows(&window, "photo.png"), "they are there as tiles");
    // With tiles, the arrows to the side move by one.
    for key in [Key::ArrowRight, Key::ArrowRight, Key::Escape] {
        window.key_press(key);
        window.step();
    }
    assert!(!window.state_mut().files().has_dialog(), "escape closes the dialog");
    ask(&mut window, FileRequest::Open(None));
    until(&mut window, "the folder", |window| shows(window, "study.exr"));
    click(&mut window, "List");
    assert!(!window.state_mut().files().preferences.browser.grid, "as rows again");
}

#[test]
fn letters_typed_into_the_list_filter_it() {
    let (_folder, mut window) = album();
    for letter in ["P", "h", "o"] {
        window.event(Event::Text(letter.to_owned()));
        window.step();
    }
    window.step();
    assert!(shows(&window, "photo.png") && !shows(&window, "study.exr"), "only one name fits");
    for _ in 0..3 {
        window.key_press(Key::Backspace);
        window.step();
    }
    window.step();
    assert!(shows(&window, "study.exr"), "backspace takes the letters back, and goes nowhere");
}

#[test]
fn a_place_opens_its_folder() {
    let (folder, mut window) = album();
    let name = folder.path().file_name().unwrap().to_str().unwrap().to_owned();
    until(&mut window, "the places", |window| shows(window, "Folders"));
    window.key_press(Key::Backspace);
    until(&mut window, "the folder above", |window| !shows(window, "study.exr"));
    click(&mut window, &name);
    until(&mut window, "the folder", |window| shows(window, "study.exr"));
    assert!(shows(&window, "Home") && shows(&window, "Drives"), "other places");
}
