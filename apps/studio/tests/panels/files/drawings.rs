//! Marks and guides on the reference picture are saved, opened, and asked for before they are lost.

use std::path::{Path, PathBuf};
use web_time::{Duration, Instant};

use artmap::passages::{MarkedArea, Marks};
use eframe::egui::{Key, Modifiers, Pos2, ViewportCommand, ViewportEvent, ViewportId, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use paint::strokes::{Action, Squeeze, SurfaceId};
use painterly::guides::Guides;
use session::Command;
use studio::panels::Mode;

use crate::harness::Window;

/// A window with a pinned picture of 600 x 400 pixels in a folder of its own.
fn window(name: &'static str) -> (Window, PathBuf, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("orchard.png");
    image::RgbImage::from_fn(600, 400, |x: u32, y: u32| {
        image::Rgb([(x / 3) as u8, (y / 2) as u8, 90])
    })
    .save(&path)
    .unwrap();
    let mut window = Window::open(name);
    pin(&mut window, &path);
    (window, path, folder)
}

fn pin(window: &mut Window, path: &Path) {
    let context = window.harness().ctx.clone();
    window.studio_mut().panels.reference.open(&context, path);
    until(window, "the picture", |window| {
        let fit = window.harness().query_by_label("Comb");
        fit.is_some_and(|fit| !fit.accesskit_node().is_disabled())
    });
}

/// Draws frames until `done`, at most 30 s.
fn until(window: &mut Window, what: &str, mut done: impl FnMut(&mut Window) -> bool) {
    let start = Instant::now();
    while !done(window) {
        assert!(start.elapsed() < Duration::from_secs(30), "waited for {what}");
        std::thread::sleep(Duration::from_millis(3));
        window.harness().step();
    }
    window.harness().run_steps(4);
}

fn shows(window: &mut Window, words: &str) -> bool {
    window.harness().query_all_by_label_contains(words).next().is_some()
}

/// Draws a line through places of the fitted picture.
fn draw(window: &mut Window, places: &[[f32; 2]]) {
    let panel = window.harness().get_by_label("Reference picture").rect();
    let zoom = (panel.width() / 600.0).min(panel.height() / 400.0);
    let along: Vec<Pos2> = places
        .iter()
        .map(|&[x, y]: &[f32; 2]| panel.center() + zoom * vec2(x - 300.0, y - 200.0))
        .collect();
    window.pen_stroke(&along);
}

/// Clicks the main button of the topmost dialog.
fn click_last(window: &mut Window, label: &str) {
    let button = window.harness().get_all_by_label(label).last().unwrap();
    button.click();
    window.harness().run_steps(6);
}

/// Requests closing the window. Returns whether it closes.
fn closes(window: &mut Window) -> bool {
    let viewports = &mut window.harness().input_mut().viewports;
    viewports.entry(ViewportId::ROOT).or_default().events.push(ViewportEvent::Close);
    window.harness().step();
    let commands = &window.harness().output().viewport_output[&ViewportId::ROOT].commands;
    let held = commands.iter().any(|command| matches!(command, ViewportCommand::CancelClose));
    let viewports = &mut window.harness().input_mut().viewports;
    viewports.entry(ViewportId::ROOT).or_default().events.clear();
    window.harness().run_steps(4);
    !held
}

#[test]
fn marks_drawn_in_the_window_are_saved_and_read_back() {
    let (mut window, path, _folder) = window("marks-saved");
    window.click("Mark samples");
    draw(&mut window, &[[100.0, 100.0], [200.0, 100.0], [300.0, 120.0]]);
    draw(&mut window, &[[100.0, 300.0], [400.0, 300.0]]);
    window.click("Spacing");
    draw(&mut window, &[[200.0, 310.0], [200.0, 330.0]]);
    window.save("marks-window");
    window.click("Save marks\u{2026}");
    window.save("marks-save");
    click_last(&mut window, "Save");
    let file = path.with_file_name("orchard.marks.toml");
    until(&mut window, "the file", |_| file.is_file());
    let marks = Marks::open(&file).unwrap();
    assert_eq!(marks.painting.as_deref(), Some("orchard.png"));
    assert_eq!((marks.samples.len(), marks.samples[0].spacing), (2, None));
    assert!((marks.samples[1].spacing_px().unwrap() - 20.0).abs() < 2.0, "{marks:?}");
    let MarkedArea::Scribble(points) = &marks.samples[0].area else { panic!("{marks:?}") };
    let [x, y] = points[0];
    assert!((x - 100.0).hypot(y - 100.0) < 2.0, "{points:?}");
    marks.check(600, 400).unwrap();
    until(&mut window, "the command", |window| shows(window, "impasto artmap sample"));
    window.save("marks-saved-window");
    assert!(closes(&mut window), "nothing is lost");
    assert_eq!(window.studio().painting().unwrap().history_done, 0, "nothing was painted");
}

#[test]
fn undo_over_the_picture_takes_the_last_mark_away() {
    let (mut window, ..) = window("marks-undone");
    window.click("Mark samples");
    draw(&mut window, &[[100.0, 100.0], [300.0, 100.0]]);
    draw(&mut window, &[[100.0, 200.0], [300.0, 200.0]]);
    assert!(shows(&mut window, "Delete sample 2"));
    window.key(Modifiers::COMMAND, Key::Z);
    assert!(!shows(&mut window, "Delete sample 2") && shows(&mut window, "Delete sample 1"));
    // Undo is for the painting again while the picture is hidden.
    for key in [Key::Tab, Key::Z, Key::Tab] {
        let modifiers = if key == Key::Z { Modifiers::COMMAND } else { Modifiers::NONE };
        window.key(modifiers, key);
    }
    assert!(shows(&mut window, "Delete sample 1"), "it is not undone");
}

#[test]
fn unsaved_lines_are_asked_for_before_the_window_closes() {
    let (mut window, path, _folder) = window("marks-unsaved");
    window.click("Comb");
    draw(&mut window, &[[100.0, 100.0], [300.0, 100.0]]);
    window.click("Mark samples");
    draw(&mut window, &[[100.0, 200.0], [300.0, 200.0]]);
    assert!(!closes(&mut window), "two drawings are unsaved");
    assert!(shows(&mut window, "The marks and guides on the reference picture are in no file"));
    window.save("marks-unsaved-question");
    click_last(&mut window, "Save");
    click_last(&mut window, "Save");
    let file = path.with_file_name("orchard.marks.toml");
    until(&mut window, "the marks", |_| file.is_file());
    until(&mut window, "the next question", |window| shows(window, "The guides on the reference"));
    click_last(&mut window, "Save");
    click_last(&mut window, "Save");
    let file = path.with_file_name("orchard.guides.toml");
    until(&mut window, "the guides", |_| file.is_file());
    let guides = Guides::open(&file).unwrap();
    assert_eq!((guides.size_px, guides.lines.len()), ([600, 400], 1));
    until(&mut window, "the end", closes);
}

#[test]
fn a_painting_is_asked_for_after_drawings_were_given_up() {
    let (mut window, ..) = window("marks-given-up");
    window.click("Mark samples");
    draw(&mut window, &[[100.0, 200.0], [300.0, 200.0]]);
    let recipe = [("Vermilion".to_owned(), 1.0)].into();
    let x_mm = 10.0;
    let y_mm = 10.0;
    let volume_mm3 = 1.0;
    let heap = Squeeze { on: SurfaceId::Canvas, recipe, vehicle: 0.0, x_mm, y_mm, volume_mm3 };
    window.studio_mut().ask(Command::Apply(Action::Squeeze(heap)));
    window.settle();
    assert!(!closes(&mut window), "both are unsaved");
    click_last(&mut window, "Discard");
    assert!(shows(&mut window, "Save the painting?"), "the painting is left");
    click_last(&mut window, "Cancel");
    assert!(shows(&mut window, "Delete sample 1"), "nothing was given up after all");
    assert!(!closes(&mut window), "it asks again");
    assert!(shows(&mut window, "The marks on the reference picture are in no file"));
    click_last(&mut window, "Discard");
    click_last(&mut window, "Discard");
    assert!(closes(&mut window), "both were given up");
}

#[test]
fn another_picture_replaces_lines_only_after_asking() {
    let (mut window, path, _folder) = window("marks-replaced");
    window.click("Mark samples");
    draw(&mut window, &[[100.0, 200.0], [300.0, 200.0]]);
    window.click("Close picture");
    window.harness().run_steps(4);
    assert!(shows(&mut window, "The marks on the reference picture are in no file"));
    click_last(&mut window, "Cancel");
    assert!(shows(&mut window, "Delete sample 1"), "the picture and its marks stay");
    window.click("Close picture");
    window.harness().run_steps(4);
    click_last(&mut window, "Discard");
    assert!(window.harness().query_by_label("Reference picture").is_none(), "it is closed");
    pin(&mut window, &path);
    assert!(!shows(&mut window, "Delete sample 1"), "the marks are gone");
    assert!(closes(&mut window), "nothing is unsaved");
}

#[test]
fn marks_are_opened_from_their_file() {
    let (mut window, path, _folder) = window("marks-opened");
    let text = "painting = \"orchard.png\"\n[[sample]]\nname = \"bark\"\n\
                scribble = [[10, 10], [200, 40]]\nspacing = [[20, 30], [20, 42]]\n";
    std::fs::write(path.with_file_name("bark.toml"), text).unwrap();
    window.click("Mark samples");
    window.click("Open marks\u{2026}");
    until(&mut window, "the list", |window| shows(window, "bark.toml"));
    for key in [Key::ArrowDown, Key::Enter] {
        window.key(Modifiers::NONE, key);
    }
    until(&mut window, "the sample", |window| shows(window, "Delete bark"));
    assert!(shows(&mut window, "12.0 px"), "its spacing");
    assert!(closes(&mut window), "it is in a file");
}

#[test]
fn a_recovered_desk_has_its_view_tool_brush_and_lines() {
    let (mut window, _path, _folder) = window("desk");
    window.click("Mark samples");
    draw(&mut window, &[[60.0, 80.0], [260.0, 120.0]]);
    let studio = window.studio_mut();
    studio.tools.brush = "knife".to_owned();
    studio.tools.mode = Mode::Rotate;
    studio.canvas.view.rotate(0.5);
    studio.canvas.view.fitted = false;
    let desk = studio.desk();
    assert_eq!(desk.reference.as_ref().unwrap().drawn().len(), 1);
    drop(window);

    let mut other = Window::open("desk again");
    assert!(other.studio().desk() != desk);
    let context = other.harness().ctx.clone();
    other.studio_mut().set_up(&desk, &context);
    until(&mut other, "the lines", |window| {
        window.studio().panels.reference.unsaved_drawings().len() == 1
    });
    assert_eq!(other.studio().desk(), desk);
}
