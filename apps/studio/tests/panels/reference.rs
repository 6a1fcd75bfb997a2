//! Tests of the reference picture, and of marks and guides drawn on it.

use std::path::PathBuf;

use artmap::passages::{MarkedArea, Marks};
use eframe::egui::{
    Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, Rect, TouchPhase,
    Vec2, vec2,
};
use egui_kittest::kittest::{NodeT, Queryable};
use image::{Rgb as Pixel, RgbImage};
use painterly::guides::Guides;
use spectra::color::Rgb;
use studio::files::{Drawing, DrawingKind, DrawnFile, ReferenceChange};
use studio::panels::FileRequest;
use studio::panels::reference::Reference;

use super::fixture::{PanelWindow, made_painting};

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
    // JPEG rounds values.
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
    let [left, right] = [FIELDS[0], FIELDS[1]]
        .map(|bytes| Rgb(bytes.map(|byte| f64::from(byte) / 255.0)).linear().0);
    for ((found, left), right) in found.iter().zip(left).zip(right) {
        // Both sides have equal numbers of pixels, except at the rim.
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
    // The boundary was 20 pixels to the right. After zooming it is farther away.
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
    fn button(pos: Pos2, pressed: bool) -> Event {
        Event::PointerButton {
            pos,
            button: PointerButton::Middle,
            pressed,
            modifiers: Default::default(),
        }
    }
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

const SIZE: [f64; 2] = [800.0, 400.0];

type Stage = PanelWindow<Reference>;

fn drawing_panel(name: &str) -> (Stage, PathBuf) {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let [width, height] = SIZE.map(|side| side as u32);
    RgbImage::from_fn(width, height, |x, y| {
        Pixel(if (x + y / 3) % 24 < 12 { [196, 150, 80] } else { [90, 70, 60] })
    })
    .save(&path)
    .unwrap();
    let panel = Reference::default();
    let mut stage = Stage::new(panel, vec2(460.0, 520.0), made_painting(), Reference::show);
    let context = stage.harness.ctx.clone();
    stage.state().panel.open(&context, &path);
    while stage.harness.get_by_label("Fit").accesskit_node().is_disabled() {
        std::thread::sleep(std::time::Duration::from_millis(5));
        stage.harness.step();
    }
    stage.run();
    (stage, path)
}

/// Point of the window that shows a place of the fitted picture.
fn drawing_place(stage: &Stage, [x, y]: [f64; 2]) -> Pos2 {
    let panel = stage.harness.get_by_label("Reference picture").rect();
    let zoom = (panel.width() / SIZE[0] as f32).min(panel.height() / SIZE[1] as f32);
    panel.center() + zoom * vec2((x - SIZE[0] / 2.0) as f32, (y - SIZE[1] / 2.0) as f32)
}

fn draw(stage: &mut Stage, places: &[[f64; 2]]) {
    let along: Vec<Pos2> = places.iter().map(|&place| drawing_place(stage, place)).collect();
    stage.drag(&along);
}

/// The drawing that this button asks to save.
fn drawn(stage: &mut Stage, button: &str) -> DrawnFile {
    stage.click(button);
    match &stage.requests()[..] {
        [FileRequest::SaveDrawing(drawn)] => drawn.clone(),
        other => panic!("{other:?}"),
    }
}

fn marks(stage: &mut Stage) -> Marks {
    match drawn(stage, "Save marks\u{2026}").drawing {
        Drawing::Marks(marks) => marks,
        other => panic!("{other:?}"),
    }
}

fn guides(stage: &mut Stage) -> Guides {
    match drawn(stage, "Save guides\u{2026}").drawing {
        Drawing::Guides(guides) => guides,
        other => panic!("{other:?}"),
    }
}

fn near(found: [f64; 2], wanted: [f64; 2]) -> bool {
    (found[0] - wanted[0]).hypot(found[1] - wanted[1]) < 1.5
}

fn scribble(area: &MarkedArea) -> &[[f64; 2]] {
    match area {
        MarkedArea::Scribble(points) => points,
        other => panic!("{other:?}"),
    }
}

fn shows(stage: &Stage, words: &str) -> bool {
    stage.harness.query_all_by_label_contains(words).next().is_some()
}

#[test]
fn a_scribble_is_a_sample_in_pixels_of_the_file() {
    let (mut stage, path) = drawing_panel("marked.png");
    stage.click("Mark samples");
    draw(&mut stage, &[[100.0, 100.0], [300.0, 100.0], [300.0, 200.0]]);
    let found = marks(&mut stage);
    assert_eq!(found.painting.as_deref(), Some("marked.png"));
    let points = scribble(&found.samples[0].area);
    assert_eq!(points.len(), 3, "{points:?}");
    for (point, wanted) in points.iter().zip([[100.0, 100.0], [300.0, 100.0], [300.0, 200.0]]) {
        assert!(near(*point, wanted), "{point:?}, not {wanted:?}");
    }
    assert!(stage.state().tools.reference_color.is_none(), "no colour is picked");
    draw(&mut stage, &[[500.0, 300.0], [700.0, 300.0]]);
    let drawn = drawn(&mut stage, "Save marks\u{2026}");
    assert_eq!(drawn.path, path.with_file_name("marked.marks.toml"));
    stage.save("reference-marks");
    let names: Vec<String> = marks(&mut stage).samples.into_iter().map(|mark| mark.name).collect();
    assert_eq!(names, ["sample 1", "sample 2"]);
}

#[test]
fn a_zoomed_and_mirrored_picture_gives_the_same_places() {
    let (mut stage, _) = drawing_panel("marked-zoomed.png");
    stage.click("Mark samples");
    let about = drawing_place(&stage, [400.0, 200.0]);
    stage.harness.hover_at(about);
    stage.harness.step();
    stage.harness.event(Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: vec2(0.0, 400.0),
        phase: TouchPhase::Move,
        source: MouseWheelSource::Wheel,
        modifiers: Modifiers::default(),
    });
    stage.wait(1.0);
    stage.click("Flip");
    let zoom = 2.0_f32.exp()
        * (drawing_place(&stage, [401.0, 200.0]) - drawing_place(&stage, [400.0, 200.0])).x;
    let middle = drawing_place(&stage, [400.0, 200.0]);
    // This goes left on the screen, so right in the mirrored picture.
    stage.drag(&[middle, middle + zoom * vec2(-50.0, 20.0)]);
    let points = scribble(&marks(&mut stage).samples[0].area).to_vec();
    assert!(near(points[0], [400.0, 200.0]) && near(points[1], [450.0, 220.0]), "{points:?}");
}

#[test]
fn spacing_is_drawn_or_clicked_for_the_selected_sample() {
    let (mut stage, _) = drawing_panel("marked-spacing.png");
    stage.click("Mark samples");
    draw(&mut stage, &[[100.0, 100.0], [300.0, 100.0]]);
    draw(&mut stage, &[[100.0, 300.0], [300.0, 300.0]]);
    stage.click("Select sample 1");
    stage.click("Spacing");
    draw(&mut stage, &[[150.0, 110.0], [174.0, 110.0]]);
    stage.click("Select sample 2");
    for place in [[150.0, 320.0], [150.0, 350.0]] {
        draw(&mut stage, &[place, place]);
    }
    let found = marks(&mut stage);
    let spacing: Vec<f64> =
        found.samples.iter().map(|mark| mark.spacing_px().unwrap().round()).collect();
    assert_eq!(spacing, [24.0, 30.0]);
    assert!(near(found.samples[0].spacing.unwrap()[0], [150.0, 110.0]), "{found:?}");
    assert!(shows(&stage, "24.0 px") || shows(&stage, "23.9 px") || shows(&stage, "24.1 px"));
    stage.save("reference-spacing");
    // Click the sample below to select it.
    stage.click("Scribble");
    draw(&mut stage, &[[200.0, 100.0], [200.0, 100.0]]);
    stage.click("Spacing");
    draw(&mut stage, &[[150.0, 110.0], [190.0, 110.0]]);
    assert_eq!(marks(&mut stage).samples[0].spacing_px().unwrap().round(), 40.0);
}

#[test]
fn a_scribble_off_the_picture_is_clipped_and_crossing_ones_are_told() {
    let (mut stage, _) = drawing_panel("marked-crossing.png");
    stage.click("Mark samples");
    draw(&mut stage, &[[600.0, 200.0], [700.0, 200.0], [900.0, 200.0]]);
    let points = scribble(&marks(&mut stage).samples[0].area).to_vec();
    assert!(near(points[0], [600.0, 200.0]) && near(points[1], [799.9, 200.0]), "{points:?}");
    draw(&mut stage, &[[650.0, 100.0], [650.0, 300.0]]);
    assert!(shows(&stage, "crosses the line of sample `sample 1`"), "you see it at once");
    assert!(shows(&stage, "shorten one of the lines"), "with a way out");
    stage.save("reference-crossing");
    stage.click("Undo mark");
    assert!(!shows(&stage, "crosses"), "it is gone");
    assert_eq!(marks(&mut stage).samples.len(), 1);
}

#[test]
fn samples_are_renamed_and_deleted() {
    let (mut stage, _) = drawing_panel("marked-names.png");
    stage.click("Mark samples");
    for y in [100.0, 200.0, 300.0] {
        draw(&mut stage, &[[100.0, y], [300.0, y]]);
    }
    fn rename(stage: &mut Stage, index: usize, name: &str) {
        let role = eframe::egui::Role::TextInput;
        stage.harness.get_all_by_role(role).nth(index).unwrap().focus();
        stage.run();
        stage.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
        stage.run();
        stage.harness.get_all_by_role(role).nth(index).unwrap().type_text(name);
        stage.run();
        stage.harness.key_press(Key::Enter);
        stage.run();
    }
    rename(&mut stage, 0, "sky");
    rename(&mut stage, 1, "sky");
    stage.click("Delete sample 3");
    fn names(stage: &mut Stage) -> Vec<String> {
        marks(stage).samples.into_iter().map(|mark| mark.name).collect()
    }
    assert_eq!(names(&mut stage), ["sky", "sample 2"], "a name is used once");
    stage.click("Undo mark");
    assert_eq!(names(&mut stage), ["sky", "sample 2", "sample 3"], "it is back");
}

#[test]
fn combed_lines_are_guides_from_their_start_to_their_end() {
    let (mut stage, path) = drawing_panel("combed.png");
    stage.click("Comb");
    draw(&mut stage, &[[100.0, 100.0], [300.0, 150.0], [500.0, 100.0]]);
    draw(&mut stage, &[[700.0, 300.0], [200.0, 300.0]]);
    let found = guides(&mut stage);
    assert_eq!((found.size_px, found.camera), ([800, 400], None));
    assert_eq!(found.picture.as_deref(), Some("combed.png"));
    assert!(near(found.lines[0][1], [300.0, 150.0]), "{found:?}");
    assert!(near(found.lines[1][0], [700.0, 300.0]), "{found:?}");
    assert_eq!(Guides::from_toml("g", &found.to_toml()).unwrap().lines, found.lines);
    stage.click("View of a model");
    stage.click("Reverse guide 2");
    stage.save("reference-guides");
    let found = guides(&mut stage);
    assert_eq!(found.camera, Some([30.0, 20.0, 30.0]));
    assert!(near(found.lines[1][0], [200.0, 300.0]), "{found:?}");
    stage.click("Undo guide");
    stage.click("Delete guide 1");
    let drawn = drawn(&mut stage, "Save guides\u{2026}");
    assert_eq!(drawn.path, path.with_file_name("combed.guides.toml"));
    let Drawing::Guides(found) = drawn.drawing else { panic!("guides") };
    assert!(found.lines.len() == 1 && near(found.lines[0][0], [700.0, 300.0]), "{found:?}");
    let saved = DrawnFile { drawing: Drawing::Guides(found), path: drawn.path };
    let context = stage.harness.ctx.clone();
    assert!(!shows(&stage, "impasto painterly"), "nothing to go on with yet");
    stage.state().panel.apply(ReferenceChange::Saved(saved), &context);
    stage.run();
    assert!(shows(&stage, "impasto painterly MODEL --camera 30,20,30"), "the next command");
    stage.click("Copy command");
    stage.click("Open guides\u{2026}");
    assert_eq!(stage.requests(), [FileRequest::OpenDrawing(DrawingKind::Guides, path)]);
}

#[test]
fn a_drawing_from_a_file_is_shown_and_guides_of_another_picture_are_not() {
    let (mut stage, path) = drawing_panel("marked-opened.png");
    let context = stage.harness.ctx.clone();
    let text = "painting = \"other.png\"\n[[sample]]\nname = \"grass\"\nrectangle = [20, 30, 400, 90]\n\
                [[sample]]\nname = \"sky\"\nscribble = [[500, 300], [700, 900]]\n";
    let opened = |drawing: Drawing| {
        let path = path.with_file_name("x.toml");
        ReferenceChange::Draw(DrawnFile { drawing, path })
    };
    let marks = Drawing::Marks(Marks::from_toml("x.toml", text).unwrap());
    let problem = stage.state().panel.apply(opened(marks), &context).unwrap();
    assert!(problem.text.contains("marks the picture other.png"), "{problem:?}");
    stage.run();
    assert!(shows(&stage, "Delete grass"), "both are listed");
    assert!(shows(&stage, "[700, 900] lies off the picture"), "you see the fault");
    stage.save("reference-opened");
    assert!(stage.state().panel.unsaved_drawings().is_empty(), "they are in a file");
    stage.click("Delete sky");
    assert_eq!(stage.state().panel.unsaved_drawings().len(), 1);

    let text = "size_px = [80, 40]\n[[guide]]\npoints = [[1, 2], [3, 4]]\n";
    let small = Drawing::Guides(Guides::from_toml("x.toml", text).unwrap());
    let problem = stage.state().panel.apply(opened(small), &context).unwrap();
    assert!(problem.text.contains("80 x 40 pixels"), "{problem:?}");
    let text = text.replace("80, 40", "800, 400");
    let own = Drawing::Guides(Guides::from_toml("x.toml", &text).unwrap());
    assert_eq!(stage.state().panel.apply(opened(own), &context), None);
    stage.run();
    assert!(shows(&stage, "Delete guide 1"), "it is listed");
}
