//! Dialogs of files: new painting, default button by the keyboard, file browser and crop.

use std::path::Path;

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use graphics::tile::Rect;
use image::{Rgb, RgbImage};
use paint::ground::{GroundRelief, Primer};
use session::{Command, Origin};
use studio::files::{BrowserOrder, FileRequest, NewCanvas};

use super::bench::{Window, ask, click, folder, painted, picture, shows, type_name, until, window};

/// Chooses an entry of the list with this label.
fn choose(window: &mut Window, list: &str, entry: &str) {
    click(window, list);
    // The entry may be out of view.
    window.get_by_label(entry).click_accesskit();
    window.run_steps(4);
}

#[test]
fn a_format_a_ground_and_its_color_are_begun_and_kept_as_a_preset() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    ask(&mut window, FileRequest::New);
    choose(&mut window, "Format of the canvas", "A6");
    click(&mut window, "Portrait");
    click(&mut window, "Panel");
    choose(&mut window, "Colour of the ground", "Brown imprimatura");
    type_name(&mut window, "sketch");
    click(&mut window, "Keep");
    for _ in 0..100 {
        std::thread::sleep(std::time::Duration::from_millis(5));
        window.step();
    }
    picture(&mut window, "new");
    assert!(shows(&window, "1050 x 1480 cells"), "you see the number of cells");
    assert!(shows(&window, "134 MiB, and 54 MiB"), "you see the memory");
    click(&mut window, "Begin");
    until(&mut window, "the painting", |window| !window.state().commands.is_empty());
    let [Command::Open(Origin::Blank { script, .. })] = &window.state().commands[..] else {
        panic!("{:?}", window.state().commands)
    };
    let canvas = script.canvas.clone();
    assert_eq!((canvas.width_mm, canvas.height_mm), (105.0, 148.0));
    assert!(matches!(canvas.ground.relief, GroundRelief::Panel(_)), "{canvas:?}");
    assert!(matches!(canvas.ground.reflectance, Some(Primer::Toned(_))), "{canvas:?}");
    let kept = window.state_mut().files().preferences.new_painting.clone();
    assert_eq!((&kept.last.canvas, kept.presets[0].name.as_str()), (&canvas, "sketch"));
    assert_eq!(kept.presets[0].canvas.canvas, canvas);

    ask(&mut window, FileRequest::New);
    choose(&mut window, "Format of the canvas", "A4");
    choose(&mut window, "Presets", "sketch");
    assert!(shows(&window, "1050 x 1480 cells"), "the preset is back");
    click(&mut window, "Remove preset");
    assert!(window.state_mut().files().preferences.new_painting.presets.is_empty());
}

#[test]
fn a_canvas_with_too_many_cells_is_not_begun() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    ask(&mut window, FileRequest::New);
    choose(&mut window, "Format of the canvas", "30 F");
    assert!(shows(&window, "Too many cells"), "you see why");
    click(&mut window, "Begin");
    assert!(window.state_mut().files().has_dialog(), "the dialog stays");
    assert!(window.state().commands.is_empty(), "nothing is begun");
}

#[test]
fn a_picture_becomes_the_first_dry_layer() {
    let (folder, _) = folder();
    let path = folder.path().join("under.png");
    RgbImage::from_pixel(30, 20, Rgb([170, 120, 70])).save(&path).unwrap();
    let mut window = window(folder.path(), painted("A"));
    let mut last = NewCanvas { first_layer: Some(path), ..NewCanvas::default() };
    let canvas = &mut last.canvas;
    (canvas.width_mm, canvas.height_mm, canvas.cell_mm) = (24.0, 16.0, 0.2);
    window.state_mut().files().preferences.new_painting.last = last;
    ask(&mut window, FileRequest::New);
    assert!(shows(&window, "under.png"), "the last settings are the start");
    click(&mut window, "Begin");
    until(&mut window, "the painting", |window| !window.state().commands.is_empty());
    let [Command::Open(Origin::Painting(document))] = &window.state().commands[..] else {
        panic!("{:?}", window.state().commands)
    };
    let [layer] = &document.dry[..] else { panic!("{} layers", document.dry.len()) };
    assert!(layer.paint.cell(40 * 120 + 60).volume() > 0, "there is paint in the middle");
    assert_eq!(document.wet.totals(), [0; 9], "nothing is wet");
}

#[test]
fn a_relief_is_chosen_from_a_picture_and_toned_with_an_own_film() {
    let (folder, _) = folder();
    let path = folder.path().join("grey.png");
    image::GrayImage::from_fn(8, 4, |x, _| image::Luma([30 * x as u8])).save(&path).unwrap();
    let mut window = window(folder.path(), painted("A"));
    ask(&mut window, FileRequest::New);
    choose(&mut window, "Format of the canvas", "A6");
    click(&mut window, "Relief picture");
    until(&mut window, "the folder", |window| shows(window, "grey.png"));
    window.get_by_label_contains("grey.png").click();
    window.run_steps(4);
    click(&mut window, "Open");
    assert!(shows(&window, "New painting"), "back in the dialog");
    click(&mut window, "Colour of the ground");
    click(&mut window, "Own film");
    click(&mut window, "Add pigment");
    for _ in 0..100 {
        std::thread::sleep(std::time::Duration::from_millis(5));
        window.step();
    }
    picture(&mut window, "new-film");
    click(&mut window, "Begin");
    until(&mut window, "the painting", |window| !window.state().commands.is_empty());
    let [Command::Open(Origin::Blank { script, .. })] = &window.state().commands[..] else {
        panic!("{:?}", window.state().commands)
    };
    let ground = &script.canvas.ground;
    let GroundRelief::Image(relief) = &ground.relief else { panic!("{ground:?}") };
    assert_eq!(Path::new(&relief.path), path);
    let Some(Primer::Toned(toned)) = &ground.reflectance else { panic!("{ground:?}") };
    assert_eq!(toned.film.recipe.len(), 2, "{toned:?}");
}

/// Replaces the text of the text field with this number.
fn type_into_field(window: &mut Window, number: usize, text: &str) {
    window.get_all_by_role(Role::TextInput).nth(number).unwrap().focus();
    window.step();
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.step();
    window.get_all_by_role(Role::TextInput).nth(number).unwrap().type_text(text);
    window.step();
}

/// Presses Enter and draws the following frames.
fn enter(window: &mut Window, modifiers: Modifiers) {
    window.key_press_modifiers(modifiers, Key::Enter);
    window.run_steps(4);
}

/// Width in mm of the new canvas, if one was begun.
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
    fn width(window: &mut Window, text: &str) {
        window.get_all_by_role(Role::SpinButton).next().unwrap().click();
        window.run_steps(2);
        window.key_press_modifiers(Modifiers::COMMAND, Key::A);
        window.step();
        window.get_by(|node| node.is_focused()).type_text(text);
        window.step();
    }
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

#[test]
fn a_crop_opens_the_part_that_stays_as_an_unsaved_painting() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    let rect = Rect { x: 10, y: 20, width: 60, height: 40 };
    let whole = window.state().canvas.clone();
    ask(&mut window, FileRequest::Crop(rect));
    until(&mut window, "the part", |window| !window.state().commands.is_empty());
    // The palette of the bench has paint, which must not get lost.
    let [Command::Open(Origin::Recovered { canvas, palette, .. })] = &window.state().commands[..]
    else {
        panic!("{:?}", window.state().commands)
    };
    assert_eq!(**canvas, whole.cropped(rect));
    assert_eq!(**palette, *whole, "the palette stays as it is");
    assert!(window.state_mut().files().has_unsaved_changes(), "the part is in no file");
    assert!(shows(&window, "Cropped to 12.0 x 8.0 mm"), "you see the size");
}

#[test]
fn a_crop_with_a_clean_palette_begins_a_recording() {
    let (folder, path) = folder();
    let mut window = window(folder.path(), painted("A"));
    let bench = window.state_mut();
    let mut clean = (*bench.palette).clone();
    clean.wet = paint::layer::Layer::empty(120, 80);
    bench.palette = std::sync::Arc::new(clean);
    let rect = Rect { x: 0, y: 0, width: 30, height: 30 };
    ask(&mut window, FileRequest::Crop(rect));
    until(&mut window, "the part", |window| !window.state().commands.is_empty());
    let [Command::Open(Origin::Painting(part))] = &window.state().commands[..] else {
        panic!("{:?}", window.state().commands)
    };
    let part = part.clone();
    let mut script = paint::StrokeScript::continue_from("part.exr", &part);
    script.mixing = None;
    window.state_mut().recorded = Some(script);
    ask(&mut window, FileRequest::SaveRecording);
    type_name(&mut window, "study");
    click(&mut window, "Save");
    let start = path.with_extension("start.exr");
    until(&mut window, "the recording", |_| path.with_extension("json").is_file());
    assert_eq!(super::bench::document(&start), *part, "the recording starts from the part");
}
