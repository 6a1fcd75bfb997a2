//! The dialog of a new painting.

use egui_kittest::kittest::Queryable;
use image::{Rgb, RgbImage};
use paint::ground::{GroundRelief, Primer};
use session::{Command, Origin};
use studio::files::{FileRequest, NewCanvas};

use super::bench::{Window, ask, click, folder, painted, picture, shows, type_name, until, window};

/// Chooses an entry of the list with this label.
fn choose(window: &mut Window, list: &str, entry: &str) {
    click(window, list);
    // It may be scrolled out of view.
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
    assert!(shows(&window, "1050 x 1480 cells"), "the cells are told");
    assert!(shows(&window, "134 MiB, and 54 MiB"), "the memory is told");
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
    assert!(shows(&window, "Too many cells"), "it is told");
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
    assert_eq!(std::path::Path::new(&relief.path), path);
    let Some(Primer::Toned(toned)) = &ground.reflectance else { panic!("{ground:?}") };
    assert_eq!(toned.film.recipe.len(), 2, "{toned:?}");
}
