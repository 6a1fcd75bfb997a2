//! Tests of the reference picture.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::path::PathBuf;

use eframe::egui::{
    Event, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, Rect, TouchPhase, Vec2, vec2,
};
use egui_kittest::kittest::{NodeT, Queryable};
use image::{Rgb as Pixel, RgbImage};
use spectra::color::Rgb;
use studio::panels::FileRequest;
use studio::panels::reference::Reference;

use super::panel_window::{PanelWindow, made_painting};

/// Colours of the four fields of the test picture, 400 x 200 pixels.
const FIELDS: [[u8; 3]; 4] = [[200, 30, 20], [240, 220, 40], [20, 60, 160], [90, 90, 90]];

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn stage(name: &str) -> PanelWindow<Reference> {
    let path = file(name);
    let picture = RgbImage::from_fn(400, 200, |x, y| {
        Pixel(FIELDS[usize::from(x >= 200) + 2 * usize::from(y >= 100)])
    });
    picture.save(&path).unwrap();
    let mut stage = PanelWindow::new(
        Reference::default(),
        vec2(460.0, 360.0),
        made_painting(),
        Reference::show,
    );
    let context = stage.harness.ctx.clone();
    stage.state().panel.open(&context, &path);
    assert!(stage.state().panel.is_open(), "it is being read");
    while stage.harness.get_by_label("Fit").accesskit_node().is_disabled() {
        std::thread::sleep(std::time::Duration::from_millis(5));
        stage.harness.step();
    }
    stage.run();
    stage
}

fn panel(stage: &PanelWindow<Reference>) -> Rect {
    stage.harness.get_by_label("Reference picture").rect()
}

/// Window position of a point of the fitted picture, by shares of width and height.
fn at(stage: &PanelWindow<Reference>, x: f32, y: f32) -> Pos2 {
    let panel = panel(stage);
    let zoom = (panel.width() / 400.0).min(panel.height() / 200.0);
    panel.center() + zoom * vec2(400.0 * (x - 0.5), 200.0 * (y - 0.5))
}

fn click(stage: &mut PanelWindow<Reference>, place: Pos2) {
    stage.harness.hover_at(place);
    stage.harness.drag_at(place);
    stage.harness.drop_at(place);
    stage.run();
}

/// Picked colour as 8-bit sRGB.
fn wanted(stage: &mut PanelWindow<Reference>) -> Option<[u8; 3]> {
    stage.state().tools.reference_color.take().map(|linear| Rgb(linear).encoded().to_bytes())
}

#[test]
fn a_click_picks_the_color_shown_there() {
    let mut stage = stage("click.png");
    stage.save("reference");
    for (index, (x, y)) in
        [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)].iter().enumerate()
    {
        let place = at(&stage, *x, *y);
        click(&mut stage, place);
        assert_eq!(wanted(&mut stage), Some(FIELDS[index]), "field {index}");
    }
    let corner = panel(&stage).min + vec2(3.0, 3.0);
    click(&mut stage, corner);
    assert_eq!(wanted(&mut stage), None, "outside the picture there is no colour");
    assert!(stage.commands().is_empty(), "no command is sent");
}

#[test]
fn pictures_of_every_format_have_their_colors() {
    // JPEG rounds.
    for (name, off) in [("kind.tif", 0), ("kind.webp", 0), ("kind.jpg", 4)] {
        let mut stage = stage(name);
        for (field, (x, y)) in
            FIELDS.iter().zip([(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)])
        {
            let place = at(&stage, x, y);
            click(&mut stage, place);
            let found = wanted(&mut stage).unwrap();
            let near = found.iter().zip(field).all(|(a, b)| a.abs_diff(*b) <= off);
            assert!(near, "{name}: {found:?} for {field:?}");
        }
    }
}

#[test]
fn dragging_shows_the_color_and_picks_it_on_release() {
    let mut stage = stage("drag.png");
    let from = at(&stage, 0.25, 0.25);
    let to = at(&stage, 0.75, 0.75);
    stage.harness.hover_at(from);
    stage.harness.drag_at(from);
    stage.harness.hover_at(to);
    stage.harness.step();
    assert_eq!(wanted(&mut stage), None, "not yet");
    stage.save("reference-loupe");
    stage.harness.drop_at(to);
    stage.run();
    assert_eq!(wanted(&mut stage), Some(FIELDS[3]));
}

#[test]
fn the_mean_over_the_radius_is_in_linear_light() {
    let mut stage = stage("mean.png");
    let middle = at(&stage, 0.5, 0.25);
    click(&mut stage, middle);
    let found = stage.state().tools.reference_color.take().unwrap();
    let linear = |bytes: [u8; 3]| Rgb(bytes.map(|byte| f64::from(byte) / 255.0)).linear().0;
    let left = linear(FIELDS[0]);
    let right = linear(FIELDS[1]);
    for ((found, left), right) in found.iter().zip(left).zip(right) {
        // Equal numbers of pixels on both sides, except at the rim.
        let share = (found - left) / (right - left);
        assert!((share - 0.5).abs() < 0.15, "{share}");
    }
}

#[test]
fn a_flipped_picture_exchanges_left_and_right() {
    let mut stage = stage("flip.png");
    stage.click("Flip");
    stage.click("Grey");
    stage.save("reference-flipped");
    let place = at(&stage, 0.25, 0.25);
    click(&mut stage, place);
    assert_eq!(wanted(&mut stage), Some(FIELDS[1]), "the colour is picked also in grey view");
    stage.click("Flip");
    click(&mut stage, place);
    assert_eq!(wanted(&mut stage), Some(FIELDS[0]));
}

#[test]
fn the_wheel_zooms_about_the_pointer_and_the_middle_button_pans() {
    let mut stage = stage("zoom.png");
    let about = at(&stage, 0.45, 0.3);
    stage.harness.hover_at(about);
    stage.harness.step();
    stage.harness.event(Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: vec2(0.0, 500.0),
        phase: TouchPhase::Move,
        source: MouseWheelSource::Wheel,
        modifiers: Default::default(),
    });
    stage.wait(1.0);
    click(&mut stage, about);
    assert_eq!(wanted(&mut stage), Some(FIELDS[0]), "zooming keeps the position under the pointer");
    // The boundary was 20 pixels to the right and is farther away after zooming.
    let right = about + vec2(30.0, 0.0);
    click(&mut stage, right);
    assert_eq!(wanted(&mut stage), Some(FIELDS[0]), "still the same field after zooming");
    drag_middle(&mut stage, about, vec2(-300.0, 0.0));
    click(&mut stage, about);
    assert_eq!(wanted(&mut stage), Some(FIELDS[1]), "the picture follows the drag");
    stage.click("Fit");
    click(&mut stage, right);
    assert_eq!(wanted(&mut stage), Some(FIELDS[1]), "all of it is shown again");
}

fn drag_middle(stage: &mut PanelWindow<Reference>, from: Pos2, by: Vec2) {
    let button = |pos: Pos2, pressed: bool| Event::PointerButton {
        pos,
        button: PointerButton::Middle,
        pressed,
        modifiers: Default::default(),
    };
    stage.harness.hover_at(from);
    stage.harness.event(button(from, true));
    stage.harness.hover_at(from + by / 2.0);
    stage.harness.hover_at(from + by);
    stage.harness.event(button(from + by, false));
    stage.run();
    assert_eq!(stage.state().tools.reference_color, None, "the middle button takes no colour");
}

#[test]
fn pictures_are_requested_from_the_files_and_closed() {
    let mut stage = stage("close.png");
    stage.click("Open picture");
    assert_eq!(stage.requests(), [FileRequest::OpenReference(None)]);
    stage.click("Close picture");
    assert_eq!(stage.requests(), [FileRequest::CloseReference]);
    assert!(!stage.state().panel.is_open());
    stage.save("reference-empty");
}

#[test]
fn an_unreadable_picture_shows_an_error_with_its_name() {
    let path = file("broken.png");
    std::fs::write(&path, "no picture").unwrap();
    let mut stage = PanelWindow::new(
        Reference::default(),
        vec2(460.0, 360.0),
        made_painting(),
        Reference::show,
    );
    let context = stage.harness.ctx.clone();
    stage.state().panel.open(&context, &path);
    for _ in 0..2000 {
        std::thread::sleep(std::time::Duration::from_millis(5));
        stage.harness.step();
        if stage.harness.query_by_label_contains("picture that can be read").is_some() {
            break;
        }
    }
    let text = stage.harness.get_by_label_contains("picture that can be read");
    let text = text.accesskit_node().value().or(text.accesskit_node().label()).unwrap();
    assert!(text.contains("broken.png") && text.contains("PNG, JPEG, TIFF or WebP"), "{text}");
}
