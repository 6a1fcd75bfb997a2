//! Revisions, exports, recordings, timelapses, preferences, kept mixtures, and drawings on the
//! reference picture.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use artmap::passages::{MarkedArea, Marks};
use eframe::egui::accesskit::Role;
use eframe::egui::{
    Event as Input, Key, Modifiers, Pos2, ViewportCommand, ViewportEvent, ViewportId, vec2,
};
use egui_kittest::Node;
use egui_kittest::kittest::{NodeT, Queryable};
use graphics::export::{PictureFormat, picture_file};
use image::AnimationDecoder;
use image::codecs::png::PngDecoder;
use paint::brush::HeadShape;
use paint::export::{SpectralBands, layers_file, painting_maps, pigment_maps, spectral_file};
use paint::pose::Sample;
use paint::scene::{PixelsPerCell, fine_picture, scene};
use paint::strokes::{
    Action, BrushSpec, LayerRef, Load, Recipe, Squeeze, Stroke, StrokeScript, StrokeTool, SurfaceId,
};
use painterly::guides::Guides;
use session::swatches::{KeptMixture, SwatchBook, SwatchChange};
use session::{Command, Origin};
use spectra::swatch_file::read_gpl;
use studio::files::{FileRequest, Preferences, ReferenceChange, SwatchFormat};
use studio::panels::Mode;
use web_time::{Duration, Instant};

use super::bench::{
    Window, ask, change, click, document, folder, opened, painted, picture, save_as, shows,
    type_name, until, window,
};
use crate::harness::Window as StudioWindow;

#[test]
fn revisions_are_kept_listed_opened_and_deleted() {
    let (folder, path) = folder();
    let mut window = window(folder.path(), painted("A"));
    save_as(&mut window, &path);
    let first = window.state().canvas.clone();
    click(&mut window, "Keep revision");
    until(&mut window, "a revision", |window| shows(window, "Open 1"));
    change(&mut window);
    click(&mut window, "Keep revision");
    until(&mut window, "the second", |window| shows(window, "Open 2"));
    picture(&mut window, "revisions");
    let revisions = folder.path().join("study.revisions");
    assert_eq!(document(&revisions.join("0001.exr")), *first);
    assert_eq!(document(&revisions.join("0002.exr")), *window.state().canvas);
    let thumbnail = image::open(revisions.join("0001.png")).unwrap();
    assert_eq!((thumbnail.width(), thumbnail.height()), (120, 80), "small ones are not enlarged");

    click(&mut window, "Open 1");
    until(&mut window, "the question", |window| shows(window, "Save the painting?"));
    click(&mut window, "Discard");
    until(&mut window, "the revision", |window| window.state().canvas == first);
    assert_eq!(window.state_mut().files().path(), None, "a new painting");

    ask(&mut window, FileRequest::DeleteRevision(revisions.join("0001.exr")));
    picture(&mut window, "delete");
    click(&mut window, "Delete");
    assert!(!revisions.join("0001.exr").exists() && revisions.join("0002.exr").exists(), "one");
    ask(&mut window, FileRequest::DeleteRevision(path.clone()));
    click(&mut window, "Delete");
    assert!(path.exists() && shows(&window, "is not a revision"), "nothing but revisions");
}

#[test]
fn exports_equal_those_of_the_engine() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    let mut painting = opened((*window.state().canvas).clone());
    let shown = painting.picture().unwrap();
    let document = window.state().canvas.clone();
    let light = painting.light().clone();
    let spectral = |bands| spectral_file(&document, &light, &shown, bands, |_| true).unwrap();
    let picture_of = |format| picture_file(&shown, document.cell_mm, format).unwrap().bytes;
    for (kind, name, wanted) in [
        ("Picture, PNG of 8 bits", "a.png", picture_of(PictureFormat::Png8)),
        ("Picture, PNG of 16 bits", "b.png", picture_of(PictureFormat::Png16)),
        ("Picture, TIFF of 16 bits", "b.tif", picture_of(PictureFormat::Tiff16)),
        ("Picture, linear OpenEXR", "c.exr", picture_of(PictureFormat::LinearExr)),
        (
            "Layers, OpenRaster",
            "c.ora",
            layers_file(&document, &light, |_| true).unwrap().unwrap().bytes,
        ),
        (
            "Spectra, OpenEXR of 8 wavelengths",
            "d.spectral.exr",
            spectral(SpectralBands::Nodes).unwrap(),
        ),
        (
            "Spectra, OpenEXR of all wavelengths",
            "e.spectral.exr",
            spectral(SpectralBands::Full).unwrap(),
        ),
    ] {
        ask(&mut window, FileRequest::Export);
        click(&mut window, kind);
        picture(&mut window, "export");
        click(&mut window, "Choose a name");
        type_name(&mut window, name);
        click(&mut window, "Save");
        let path = folder.path().join(name);
        until(&mut window, name, |window| shows(window, "Exported") && path.is_file());
        assert!(std::fs::read(&path).unwrap() == wanted, "{name} differs");
    }
    let pixels = PixelsPerCell::new(2).unwrap();
    let fine = fine_picture(&document, &scene(&document, &light), pixels);
    let fine = picture_file(&fine, document.cell_mm / 2.0, PictureFormat::Png8).unwrap();
    ask(&mut window, FileRequest::Export);
    click(&mut window, "2 x 2");
    picture(&mut window, "export-pixels");
    click(&mut window, "Choose a name");
    type_name(&mut window, "fine.png");
    click(&mut window, "Save");
    let path = folder.path().join("fine.png");
    until(&mut window, "the fine picture", |_| path.is_file());
    assert!(std::fs::read(&path).unwrap() == fine.bytes, "the fine picture differs");
    ask(&mut window, FileRequest::Export);
    ["Pigment maps, a folder of PNG", "Choose a name"].iter().for_each(|l| click(&mut window, l));
    type_name(&mut window, "f");
    click(&mut window, "Save");
    let maps = folder.path().join("f.maps");
    until(&mut window, "the maps", |_| maps.join("painting.recipe.csv").is_file());
    for file in pigment_maps("painting", &painting_maps(&document), document.cell_mm).unwrap() {
        assert!(std::fs::read(maps.join(&file.name)).unwrap() == file.bytes, "{}", file.name);
    }
}

#[test]
fn recordings_are_saved_and_played() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    ask(&mut window, FileRequest::SaveRecording);
    type_name(&mut window, "strokes");
    click(&mut window, "Save");
    let path = folder.path().join("strokes.json");
    until(&mut window, "the recording", |_| path.is_file());
    let read = StrokeScript::from_json("strokes.json", &std::fs::read(&path).unwrap()).unwrap();
    assert_eq!(read, window.state().script());
    ask(&mut window, FileRequest::Open(Some(path)));
    until(&mut window, "the replay", |window| !window.state().commands.is_empty());
    let [Command::Replay { script, .. }] = &window.state().commands[..] else {
        panic!("{:?}", window.state().commands)
    };
    assert_eq!(**script, read);
}

#[test]
fn a_recording_is_saved_with_its_start_painting() {
    let (folder, path) = folder();
    let first = paint::file::write(&painted("A")).unwrap();
    std::fs::write(&path, &first).unwrap();
    let mut window = window(folder.path(), painted("B"));
    ask(&mut window, FileRequest::Open(Some(path.clone())));
    until(&mut window, "the painting", |window| window.state().canvas.title == "A");
    let script = StrokeScript::continue_from("A.exr", &window.state().canvas);
    window.state_mut().recorded = Some(script);
    change(&mut window);
    ask(&mut window, FileRequest::Save);
    until(&mut window, "the end", |window| !window.state_mut().files().has_unsaved_changes());
    assert!(std::fs::read(&path).unwrap() != first, "the file is another now");
    ask(&mut window, FileRequest::SaveRecording);
    type_name(&mut window, "strokes");
    click(&mut window, "Save");
    let recording = folder.path().join("strokes.json");
    until(&mut window, "the recording", |_| recording.is_file());
    let read =
        StrokeScript::from_json("strokes.json", &std::fs::read(&recording).unwrap()).unwrap();
    assert_eq!(read.start.as_deref(), Some("strokes.start.exr"));
    assert!(std::fs::read(folder.path().join("strokes.start.exr")).unwrap() == first, "not it");
}

#[test]
fn pictures_and_lamps_are_opened_by_content() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    let photo = folder.path().join("photo.png");
    image::RgbImage::new(4, 4).save(&photo).unwrap();
    ask(&mut window, FileRequest::Open(Some(photo.clone())));
    let mut found = None;
    until(&mut window, "the picture", |window| {
        found = found.take().or_else(|| window.state_mut().files().take_reference());
        found.is_some()
    });
    assert_eq!(found, Some(ReferenceChange::Open(photo)));
    let lamp = folder.path().join("desk.csv");
    std::fs::write(&lamp, "nm,power\n400,1\n500,2\n700,3\n").unwrap();
    ask(&mut window, FileRequest::Open(Some(lamp.clone())));
    until(&mut window, "the light", |window| !window.state().commands.is_empty());
    let [Command::Apply(Action::Light(lighting))] = &window.state().commands[..] else {
        panic!("{:?}", window.state().commands)
    };
    assert_eq!(Path::new(&lighting.illuminant), lamp);
    std::fs::write(&lamp, "no lamp at all").unwrap();
    ask(&mut window, FileRequest::Open(Some(lamp)));
    until(&mut window, "the complaint", |window| shows(window, "OK"));
    assert!(shows(&window, "desk.csv"), "it names the file");
    picture(&mut window, "failure");
    click(&mut window, "OK");
    assert!(!shows(&window, "desk.csv"), "closed");
}

#[test]
fn a_new_painting_has_the_described_canvas() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    ask(&mut window, FileRequest::New);
    click(&mut window, "Paper");
    picture(&mut window, "new");
    click(&mut window, "Begin");
    until(&mut window, "the canvas", |window| !window.state().commands.is_empty());
    let [Command::Open(Origin::Blank { script, .. })] = &window.state().commands[..] else {
        panic!("{:?}", window.state().commands)
    };
    assert_eq!(script.canvas.cells(), (1920, 1080));
    let ground = serde_json::to_value(&script.canvas.ground).unwrap();
    assert_eq!(ground["kind"], "paper");
    assert_eq!(script.palette.pigments.len(), 8);
}

#[test]
fn preferences_apply_and_are_written() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    ask(&mut window, FileRequest::Preferences);
    click(&mut window, "Processor");
    click(&mut window, "Play as painted");
    click(&mut window, "Follow the stroke");
    picture(&mut window, "preferences");
    click(&mut window, "Close");
    assert!(!window.state_mut().files().has_dialog(), "closed");
    window.event(Input::PointerGone);
    let path = folder.path().join("own").join("preferences.json");
    until(&mut window, "the file", |_| path.is_file());
    window.state_mut().files().finish();
    let (read, failures) = Preferences::read(&path);
    assert_eq!(failures, []);
    assert_eq!(read, window.state_mut().files().preferences);
    assert!(read.replay_as_painted && !read.pen.follow, "one was ticked, one cleared");
}

/// A recording of two strokes of one second on the bench's canvas.
fn recorded(window: &Window) -> StrokeScript {
    let mut script = window.state().script();
    let spec = BrushSpec { shape: HeadShape::Round, size_mm: 3.0 };
    script.brushes.insert("round".to_owned(), spec);
    let brush = "round".to_owned();
    let recipe = [("Ultramarine".to_owned(), 1.0)].into();
    script.actions.push(Action::Load(Load { brush, recipe, vehicle: 0.1, amount_mm: 0.3 }));
    for y_mm in [5.0, 10.0] {
        let samples = (0..=20)
            .map(|index: u32| {
                let share = f64::from(index) / 20.0;
                Sample::upright(share, 3.0 + 18.0 * share, y_mm, 0.6)
            })
            .collect();
        let brush = "round".to_owned();
        let on = SurfaceId::Canvas;
        script.actions.push(Action::Stroke(Stroke { brush, on, tool: StrokeTool::Paint, samples }));
    }
    script
}

fn export(window: &mut Window, form: &str, name: &str) {
    ask(window, FileRequest::ExportTimelapse);
    click(window, form);
    click(window, "One after");
    picture(window, "timelapse");
    click(window, "Choose a name");
    type_name(window, name);
    click(window, "Save");
}

#[test]
fn a_timelapse_is_written_in_each_form() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    let script = recorded(&window);
    window.state_mut().recorded = Some(script);
    let path = folder.path();

    export(&mut window, "GIF", "film.gif");
    until(&mut window, "the GIF", |window| {
        shows(window, "Exported") && path.join("film.gif").is_file()
    });
    let gif = std::fs::read(path.join("film.gif")).unwrap();
    assert!(gif.starts_with(b"GIF89a") && gif[6..10] == [120, 0, 80, 0], "a pixel a cell");

    export(&mut window, "Animated PNG", "film.png");
    let left = path.join(".film.png.frames");
    until(&mut window, "the APNG", |_| path.join("film.png").is_file() && !left.exists());
    let apng = std::fs::read(path.join("film.png")).unwrap();
    let apng = PngDecoder::new(Cursor::new(apng)).unwrap().apng().unwrap().into_frames();
    let apng = apng.collect_frames().unwrap();
    assert_eq!(apng.len(), 3, "the start, and one after each stroke");
    assert_eq!(apng[2].delay().numer_denom_ms(), (2000, 1), "the end is held");
    for (one, next) in [(0, 1), (1, 2)] {
        let pairs = apng[one].buffer().pixels().zip(apng[next].buffer().pixels());
        assert!(pairs.filter(|(a, b)| a != b).count() > 200, "each frame has one stroke more");
    }

    export(&mut window, "Folder of PNG frames", "film");
    let frames = path.join("film.frames");
    until(&mut window, "the frames", |_| frames.join("frame-0003.png").is_file());
    let last = image::open(frames.join("frame-0003.png")).unwrap().into_rgba8();
    assert!(last == *apng[2].buffer(), "the same picture");
    assert!(frames.join("animation.json").is_file());
}

#[test]
fn a_recording_that_cannot_be_played_is_told_of() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A"));
    let mut script = recorded(&window);
    script.actions.push(Action::Merge { layer: LayerRef::Dry(3), with: None });
    window.state_mut().recorded = Some(script);
    export(&mut window, "GIF", "film.gif");
    until(&mut window, "the reason", |window| {
        window.query_all_by_label_contains("(merge)").next().is_some()
    });
    assert!(!folder.path().join("film.gif").exists(), "nothing is written");
}

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
    assert_eq!(names(&mut window), ["red"], "colours are not mixtures");
}

/// The row of a file in the browser. It is a button, while a notice may contain the same name as
/// text.
fn row<'a>(window: &'a Window, name: &'a str) -> Option<Node<'a>> {
    let mut named = window.query_all_by_label_contains(name);
    named.find(|node| node.accesskit_node().role() == Role::Button)
}

fn choose(window: &mut Window, name: &str) {
    until(window, "the row", |window| row(window, name).is_some());
    row(window, name).unwrap().click();
    window.run_steps(4);
    window.key_press(Key::Enter);
    window.run_steps(4);
}

/// A window with a pinned picture of 600 x 400 pixels, in its own folder.
fn pinned_window(name: &'static str) -> (StudioWindow, PathBuf, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("orchard.png");
    image::RgbImage::from_fn(600, 400, |x: u32, y: u32| {
        image::Rgb([(x / 3) as u8, (y / 2) as u8, 90])
    })
    .save(&path)
    .unwrap();
    let mut window = StudioWindow::open(name);
    pin(&mut window, &path);
    (window, path, folder)
}

fn pin(window: &mut StudioWindow, path: &Path) {
    let context = window.harness().ctx.clone();
    window.studio_mut().panels.reference.open(&context, path);
    wait_until(window, "the picture", |window| {
        let fit = window.harness().query_by_label("Comb");
        fit.is_some_and(|fit| !fit.accesskit_node().is_disabled())
    });
}

fn wait_until(
    window: &mut StudioWindow,
    what: &str,
    mut done: impl FnMut(&mut StudioWindow) -> bool,
) {
    let start = Instant::now();
    while !done(window) {
        assert!(start.elapsed() < Duration::from_secs(30), "waited for {what}");
        std::thread::sleep(Duration::from_millis(3));
        window.harness().step();
    }
    window.harness().run_steps(4);
}

fn shows_words(window: &mut StudioWindow, words: &str) -> bool {
    window.harness().query_all_by_label_contains(words).next().is_some()
}

/// Draws a line through places of the fitted picture.
fn draw(window: &mut StudioWindow, places: &[[f32; 2]]) {
    let panel = window.harness().get_by_label("Reference picture").rect();
    let zoom = (panel.width() / 600.0).min(panel.height() / 400.0);
    let along: Vec<Pos2> = places
        .iter()
        .map(|&[x, y]: &[f32; 2]| panel.center() + zoom * vec2(x - 300.0, y - 200.0))
        .collect();
    window.pen_stroke(&along);
}

fn click_last(window: &mut StudioWindow, label: &str) {
    let button = window.harness().get_all_by_label(label).last().unwrap();
    button.click();
    window.harness().run_steps(6);
}

/// Requests closing the window. Returns whether it closes.
fn closes(window: &mut StudioWindow) -> bool {
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
    let (mut window, path, _folder) = pinned_window("marks-saved");
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
    wait_until(&mut window, "the file", |_| file.is_file());
    let marks = Marks::open(&file).unwrap();
    assert_eq!(marks.painting.as_deref(), Some("orchard.png"));
    assert_eq!((marks.samples.len(), marks.samples[0].spacing), (2, None));
    assert!((marks.samples[1].spacing_px().unwrap() - 20.0).abs() < 2.0, "{marks:?}");
    let MarkedArea::Scribble(points) = &marks.samples[0].area else { panic!("{marks:?}") };
    let [x, y] = points[0];
    assert!((x - 100.0).hypot(y - 100.0) < 2.0, "{points:?}");
    marks.check(600, 400).unwrap();
    wait_until(&mut window, "the command", |window| shows_words(window, "impasto artmap sample"));
    window.save("marks-saved-window");
    assert!(closes(&mut window), "nothing is lost");
    assert_eq!(window.studio().painting().unwrap().history_done, 0, "nothing was painted");
}

#[test]
fn undo_over_the_picture_takes_the_last_mark_away() {
    let (mut window, ..) = pinned_window("marks-undone");
    window.click("Mark samples");
    draw(&mut window, &[[100.0, 100.0], [300.0, 100.0]]);
    draw(&mut window, &[[100.0, 200.0], [300.0, 200.0]]);
    assert!(shows_words(&mut window, "Delete sample 2"));
    window.key(Modifiers::COMMAND, Key::Z);
    assert!(
        !shows_words(&mut window, "Delete sample 2") && shows_words(&mut window, "Delete sample 1")
    );
    // While the picture is hidden, undo acts on the painting again.
    for key in [Key::Tab, Key::Z, Key::Tab] {
        let modifiers = if key == Key::Z { Modifiers::COMMAND } else { Modifiers::NONE };
        window.key(modifiers, key);
    }
    assert!(shows_words(&mut window, "Delete sample 1"), "it is not undone");
}

#[test]
fn unsaved_lines_are_asked_for_before_the_window_closes() {
    let (mut window, path, _folder) = pinned_window("marks-unsaved");
    window.click("Comb");
    draw(&mut window, &[[100.0, 100.0], [300.0, 100.0]]);
    window.click("Mark samples");
    draw(&mut window, &[[100.0, 200.0], [300.0, 200.0]]);
    assert!(!closes(&mut window), "two drawings are unsaved");
    assert!(shows_words(
        &mut window,
        "The marks and guides on the reference picture are in no file"
    ));
    window.save("marks-unsaved-question");
    click_last(&mut window, "Save");
    click_last(&mut window, "Save");
    let file = path.with_file_name("orchard.marks.toml");
    wait_until(&mut window, "the marks", |_| file.is_file());
    wait_until(&mut window, "the next question", |window| {
        shows_words(window, "The guides on the reference")
    });
    click_last(&mut window, "Save");
    click_last(&mut window, "Save");
    let file = path.with_file_name("orchard.guides.toml");
    wait_until(&mut window, "the guides", |_| file.is_file());
    let guides = Guides::open(&file).unwrap();
    assert_eq!((guides.size_px, guides.lines.len()), ([600, 400], 1));
    wait_until(&mut window, "the end", closes);
}

#[test]
fn a_painting_is_asked_for_after_drawings_were_given_up() {
    let (mut window, ..) = pinned_window("marks-given-up");
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
    assert!(shows_words(&mut window, "Save the painting?"), "the painting is left");
    click_last(&mut window, "Cancel");
    assert!(shows_words(&mut window, "Delete sample 1"), "nothing was given up after all");
    assert!(!closes(&mut window), "it asks again");
    assert!(shows_words(&mut window, "The marks on the reference picture are in no file"));
    click_last(&mut window, "Discard");
    click_last(&mut window, "Discard");
    assert!(closes(&mut window), "both were given up");
}

#[test]
fn another_picture_replaces_lines_only_after_asking() {
    let (mut window, path, _folder) = pinned_window("marks-replaced");
    window.click("Mark samples");
    draw(&mut window, &[[100.0, 200.0], [300.0, 200.0]]);
    window.click("Close picture");
    window.harness().run_steps(4);
    assert!(shows_words(&mut window, "The marks on the reference picture are in no file"));
    click_last(&mut window, "Cancel");
    assert!(shows_words(&mut window, "Delete sample 1"), "the picture and its marks stay");
    window.click("Close picture");
    window.harness().run_steps(4);
    click_last(&mut window, "Discard");
    assert!(window.harness().query_by_label("Reference picture").is_none(), "it is closed");
    pin(&mut window, &path);
    assert!(!shows_words(&mut window, "Delete sample 1"), "the marks are gone");
    assert!(closes(&mut window), "nothing is unsaved");
}

#[test]
fn marks_are_opened_from_their_file() {
    let (mut window, path, _folder) = pinned_window("marks-opened");
    let text = "painting = \"orchard.png\"\n[[sample]]\nname = \"bark\"\n\
                scribble = [[10, 10], [200, 40]]\nspacing = [[20, 30], [20, 42]]\n";
    std::fs::write(path.with_file_name("bark.toml"), text).unwrap();
    window.click("Mark samples");
    window.click("Open marks\u{2026}");
    wait_until(&mut window, "the list", |window| shows_words(window, "bark.toml"));
    for key in [Key::ArrowDown, Key::Enter] {
        window.key(Modifiers::NONE, key);
    }
    wait_until(&mut window, "the sample", |window| shows_words(window, "Delete bark"));
    assert!(shows_words(&mut window, "12.0 px"), "its spacing");
    assert!(closes(&mut window), "it is in a file");
}

#[test]
fn a_recovered_desk_has_its_view_tool_brush_and_lines() {
    let (mut window, _path, _folder) = pinned_window("desk");
    window.click("Mark samples");
    draw(&mut window, &[[60.0, 80.0], [260.0, 120.0]]);
    let studio = window.studio_mut();
    studio.tools.brush = "knife".to_owned();
    studio.tools.mode = Mode::Rotate;
    studio.canvas.view.rotate(0.5);
    studio.canvas.view.fitted = false;
    let setup = studio.window_setup();
    assert_eq!(setup.reference.as_ref().unwrap().drawn().len(), 1);
    drop(window);

    let mut other = StudioWindow::open("desk again");
    assert!(other.studio().window_setup() != setup);
    let context = other.harness().ctx.clone();
    other.studio_mut().set_up(&setup, &context);
    wait_until(&mut other, "the lines", |window| {
        window.studio().panels.reference.unsaved_drawings().len() == 1
    });
    assert_eq!(other.studio().window_setup(), setup);
}
