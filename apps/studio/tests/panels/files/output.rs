//! Revisions, exports, recordings, opened files and preferences.

use std::path::Path;

use eframe::egui::Event as Input;
use graphics::export::{PictureFormat, picture_file};
use paint::export::{SpectralBands, layers_file, painting_maps, pigment_maps, spectral_file};
use paint::scene::{PixelsPerCell, fine_picture, scene};
use paint::strokes::{Action, StrokeScript};
use session::{Command, Origin};
use studio::files::{FileRequest, Preferences, ReferenceChange};

use super::bench::{
    ask, change, click, document, folder, opened, painted, picture, save_as, shows, type_name,
    until, window,
};

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
