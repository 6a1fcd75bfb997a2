//! The reference picture over the canvas, and the frame of a crop.

use std::path::PathBuf;
use web_time::{Duration, Instant};

use eframe::egui::{Event, Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable;
use graphics::export::linear_exr;
use graphics::field::Field;
use image::{Rgb as Pixel, RgbImage};
use paint::strokes::SurfaceId;
use studio::app::CropTool;
use studio::panels::reference::Reference;

use super::harness::{Window, button};
use super::panel_window::{PanelWindow, made_painting};

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn until(window: &mut Window, what: &str, done: impl Fn(&mut Window) -> bool) {
    let start = Instant::now();
    while !done(window) {
        assert!(start.elapsed() < Duration::from_secs(30), "waited for {what}");
        std::thread::sleep(Duration::from_millis(5));
        window.harness().step();
    }
    window.settle();
}

/// A window with a red picture of 300 x 100 pixels pinned and laid over the canvas.
fn overlaid(name: &'static str) -> Window {
    let path = file(&format!("{name}.png"));
    RgbImage::from_pixel(300, 100, Pixel([200, 20, 20])).save(&path).unwrap();
    let mut window = Window::open(name);
    let context = window.harness().ctx.clone();
    window.studio_mut().panels.reference.open(&context, &path);
    window.key(Modifiers::NONE, Key::O);
    until(&mut window, "the picture", |window| window.studio().panels.reference.is_over_canvas());
    window
}

#[test]
fn the_reference_lies_over_the_canvas_and_is_never_painted() {
    let mut window = overlaid("over-canvas");
    let history = window.studio().painting().unwrap().history.clone();
    // Fitted: as wide as the canvas of 32 x 20 mm, and 10.7 mm high.
    let inside = window.point(SurfaceId::Canvas, 25.0, 10.0);
    let beside = window.point(SurfaceId::Canvas, 25.0, 2.0);
    if let Some(picture) = window.picture() {
        let [red, green, _] = window.color(&picture, inside);
        assert!(
            i16::from(red) > i16::from(green) + 40,
            "the picture shines through: {red} {green}"
        );
        let [red, green, blue] = window.color(&picture, beside);
        assert!(red.abs_diff(green) < 20 && green.abs_diff(blue) < 30, "bare linen beside it");
    }
    window.save("over-canvas-window");
    window.key(Modifiers::NONE, Key::O);
    if let Some(picture) = window.picture() {
        let [red, green, _] = window.color(&picture, inside);
        assert!(i16::from(red) < i16::from(green) + 20, "it is gone: {red} {green}");
    }
    assert_eq!(window.studio().painting().unwrap().history, history, "nothing was painted");
}

#[test]
fn the_pen_moves_the_reference_only_while_that_is_on() {
    let mut window = overlaid("over-canvas-moved");
    window.click("Move");
    let done = window.studio().painting().unwrap().history_done;
    let from = window.point(SurfaceId::Canvas, 16.0, 10.0);
    window.pen_stroke(&[from, from + vec2(0.0, 40.0), from + vec2(0.0, 80.0)]);
    window.settle();
    assert_eq!(window.studio().painting().unwrap().history_done, done, "no stroke");
    let top = window.point(SurfaceId::Canvas, 16.0, 6.0);
    window.save("over-canvas-moving");
    if let Some(picture) = window.picture() {
        let [red, green, _] = window.color(&picture, top);
        assert!(
            i16::from(red) < i16::from(green) + 20,
            "the picture has moved down: {red} {green}"
        );
    }
    window.click("Move");
    window.pen_stroke(&[from, from + vec2(40.0, 0.0), from + vec2(80.0, 0.0)]);
    window.settle();
    assert!(window.studio().painting().unwrap().history_done > done, "now the pen paints");
}

#[test]
fn a_crop_is_framed_with_handles_and_applied_with_enter() {
    let mut window = Window::open("crop");
    let from = window.point(SurfaceId::Canvas, 4.0, 10.0);
    window.pen_stroke(&[from, from + vec2(60.0, 0.0), from + vec2(120.0, 0.0)]);
    window.settle();
    let history = window.studio().painting().unwrap().history_done;
    window.click("Edit");
    window.harness().get_by_label_contains("Crop...").click();
    window.settle();
    let canvas = window.studio().canvas.rect();
    for name in ["Crop", "Cancel", "Shape of the crop"] {
        let rect = window.harness().get_by_label(name).rect();
        assert!(rect.bottom() <= canvas.top(), "{name} covers the picture: {rect} {canvas}");
    }
    let handle = window.harness().get_by_label("Crop right").rect().center();
    let to = window.point(SurfaceId::Canvas, 20.0, 10.0);
    window.pen_stroke(&[handle, handle.lerp(to, 0.5), to]);
    window.save("crop-window");
    assert!(window.harness().query_by_label("20.0 x 20.0 mm").is_some(), "its size is told");
    let painting = window.studio().painting().unwrap();
    assert_eq!((painting.history_done, painting.canvas_cells), (history, (320, 200)));
    window.key(Modifiers::NONE, Key::Enter);
    until(&mut window, "the part", |window| {
        window.studio().painting().is_some_and(|painting| painting.canvas_cells == (200, 200))
    });
    assert!(window.studio().crop.is_none(), "the frame is gone");
    assert!(window.studio().files.has_unsaved_changes(), "the part is in no file");
    assert_eq!(window.studio().painting().unwrap().history_done, 0, "undo ends at a crop");
}

#[test]
fn a_handle_of_a_crop_follows_to_the_place_of_its_release() {
    let mut window = Window::open("crop-release");
    window.studio_mut().crop = Some(CropTool::new((320, 200)));
    window.settle();
    let handle = window.harness().get_by_label("Crop right").rect().center();
    let to = window.point(SurfaceId::Canvas, 20.0, 10.0);
    window.frame(vec![Event::PointerMoved(handle), button(handle, true)]);
    window.frame(vec![Event::PointerMoved(handle.lerp(to, 0.5))]);
    window.frame(vec![Event::PointerMoved(to), button(to, false)]);
    window.settle();
    assert!(window.harness().query_by_label("20.0 x 20.0 mm").is_some(), "as far as the pen went");
}

#[test]
fn escape_leaves_a_crop() {
    let mut window = Window::open("crop-left");
    window.click("Edit");
    window.harness().get_by_label_contains("Crop...").click();
    window.settle();
    assert!(window.studio().crop.is_some(), "it is framed");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(window.studio().crop.is_none());
    assert_eq!(window.studio().painting().unwrap().canvas_cells, (320, 200));
}

#[test]
fn an_exr_of_a_scene_has_an_exposure() {
    let path = file("scene-linear.exr");
    let picture = Field::filled(40, 20, [0.05, 0.1, 0.02, 1.0]);
    std::fs::write(&path, linear_exr(&picture, 0.1).unwrap()).unwrap();
    let mut stage = PanelWindow::new(
        Reference::default(),
        vec2(460.0, 360.0),
        made_painting(),
        Reference::show,
    );
    let context = stage.harness.ctx.clone();
    stage.state().panel.open(&context, &path);
    let start = Instant::now();
    while stage.harness.query_by_label("Exposure").is_none() {
        assert!(start.elapsed() < Duration::from_secs(30), "no exposure is offered");
        std::thread::sleep(Duration::from_millis(5));
        stage.harness.step();
    }
    stage.run();
    stage.save("reference-exr");
    let place = stage.harness.get_by_label("Reference picture").rect().center();
    stage.drag(&[place, place]);
    let picked = stage.state().tools.reference_color.take().unwrap();
    for (found, wanted) in picked.iter().zip([0.05, 0.1, 0.02]) {
        assert!((found - wanted).abs() < 1e-6, "{picked:?}");
    }
}
