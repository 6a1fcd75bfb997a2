//! Saving, opening, recovery and closing of paintings, and autosaves of scenes.

use std::path::Path;
use std::sync::Arc;

use eframe::egui::{Key, Ui, ViewportCommand, ViewportEvent, ViewportId, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use glam::Vec3;
use graphics::camera::Framing;
use paint::light::Light;
use paint::strokes::Action;
use pigment::library::PigmentLibrary;
use session::volumes::{Look, SceneRecording, SceneState, SceneTally, SceneTime};
use session::{Command, LostSession, Origin};
use studio::files::{
    FileRequest, Files, Home, PinnedReference, Preferences, SceneAnswer, WindowSetup,
};
use web_time::{Duration, Instant};

use super::bench::{
    Window, ask, change, click, document, folder, painted, picture, shows, type_name, until, window,
};

#[test]
fn a_reopened_painting_equals_the_saved_one() {
    let (folder, path) = folder();
    let mut window = window(folder.path(), painted("A study"));
    change(&mut window);
    assert!(window.state_mut().files().has_unsaved_changes(), "it was changed");
    ask(&mut window, FileRequest::Save);
    picture(&mut window, "save");
    assert!(shows(&window, "Save the painting"), "the window asks for a file name");
    type_name(&mut window, "study");
    window.key_press(Key::Enter);
    until(&mut window, "the file", |_| path.is_file());
    until(&mut window, "the end", |window| !window.state_mut().files().has_unsaved_changes());
    let saved = window.state().canvas.clone();
    assert_eq!(document(&path), *saved);
    assert_eq!(window.state_mut().files().title(), "study");

    change(&mut window);
    let changed = window.state().canvas.clone();
    assert!(changed != saved, "the test changes nothing");
    ask(&mut window, FileRequest::Save);
    until(&mut window, "the second save", |window| {
        !window.state_mut().files().has_unsaved_changes()
    });
    assert_eq!(document(&path), *changed, "saved in the same file without asking");

    ask(&mut window, FileRequest::Open(Some(path.clone())));
    until(&mut window, "the painting", |window| !window.state().commands.is_empty());
    let [Command::Open(Origin::WithTable { canvas, table })] = &window.state().commands[..] else {
        panic!("{:?}", window.state().commands)
    };
    assert_eq!(**canvas, *changed);
    assert_eq!(table.palette, *window.state().palette, "the palette as it was left");
    assert_eq!(table.brushes, *window.state().brushes, "the brushes as well");
    assert!(table.brushes[0].paint.is_some(), "a brush with paint");
}

#[test]
fn a_painting_whose_palette_is_damaged_opens_and_says_so() {
    let (folder, path) = folder();
    let mut window = window(folder.path(), painted("A"));
    let palette = window.state().palette.clone();
    let brushes = window.state().brushes.clone();
    let canvas = painted("B");
    let mut bytes = paint::file::write_with_table(&canvas, &palette, &brushes).unwrap();
    let inner = bytes.windows(13).position(|part| part == b"impasto-table").unwrap() + 3000;
    bytes[inner..inner + 1000].fill(0x41);
    std::fs::write(&path, bytes).unwrap();
    ask(&mut window, FileRequest::Open(Some(path)));
    until(&mut window, "the painting", |window| !window.state().commands.is_empty());
    let [Command::Open(Origin::Painting(read))] = &window.state().commands[..] else {
        panic!("{:?}", window.state().commands)
    };
    assert_eq!(**read, canvas);
    assert!(shows(&window, "palette"), "you see the problem");
}

#[test]
fn the_browser_works_with_keys_alone() {
    let (folder, path) = folder();
    std::fs::create_dir(folder.path().join("album")).unwrap();
    std::fs::write(folder.path().join("notes.txt"), "nothing").unwrap();
    std::fs::write(&path, paint::file::write(&painted("A")).unwrap()).unwrap();
    let mut window = window(folder.path(), painted("B"));
    ask(&mut window, FileRequest::Open(None));
    until(&mut window, "the folder", |window| shows(window, "study.exr"));
    assert!(!shows(&window, "notes.txt"), "other files are not listed");
    picture(&mut window, "open");
    for key in [Key::ArrowDown, Key::Enter] {
        window.key_press(key);
        window.step();
    }
    until(&mut window, "the album", |window| !shows(window, "study.exr"));
    window.key_press(Key::Backspace);
    until(&mut window, "the way back", |window| shows(window, "study.exr"));
    for key in [Key::ArrowDown, Key::ArrowDown, Key::Enter] {
        window.key_press(key);
        window.step();
    }
    until(&mut window, "the painting", |window| !window.state().commands.is_empty());
    assert_eq!(window.state().canvas.title, "A");
    ask(&mut window, FileRequest::Open(None));
    window.key_press(Key::Escape);
    window.step();
    window.step();
    assert!(!window.state_mut().files().has_dialog(), "escape closes the dialog");
}

#[test]
fn a_file_is_overwritten_only_after_confirmation() {
    let (folder, path) = folder();
    std::fs::write(&path, "dear").unwrap();
    let mut window = window(folder.path(), painted("A"));
    for (answer, kept) in [("Keep", true), ("Replace", false)] {
        ask(&mut window, FileRequest::SaveAs);
        type_name(&mut window, "study");
        click(&mut window, "Save");
        assert!(shows(&window, "study.exr already exists"), "the window asks");
        picture(&mut window, "replace");
        click(&mut window, answer);
        if kept {
            assert_eq!(std::fs::read_to_string(&path).unwrap(), "dear");
            click(&mut window, "Cancel");
        }
    }
    until(&mut window, "the file", |window| window.state_mut().files().path() == Some(&path));
    assert_eq!(document(&path), *window.state().canvas);
}

#[test]
fn a_session_left_by_a_crash_is_offered_and_recovered() {
    let (folder, _) = folder();
    let mut first = window(folder.path(), painted("A study"));
    let mut script = first.state().script();
    script.actions.push(Action::Dry { fraction: 0.5 });
    first.state_mut().recorded = Some(script);
    change(&mut first);
    let sessions = folder.path().join("own").join("sessions");
    until(&mut first, "an autosave", |_: &mut Window| {
        let mut sessions = std::fs::read_dir(&sessions).unwrap();
        let session = sessions.next().unwrap().unwrap().path();
        let mut inside = std::fs::read_dir(session).unwrap().map(|entry| entry.unwrap());
        inside.any(|entry| entry.file_name().to_string_lossy().starts_with("generation"))
    });
    let picture_file = folder.path().join("orchard.png");
    image::RgbImage::new(4, 4).save(&picture_file).unwrap();
    let setup = WindowSetup {
        brush: Some("flat".to_owned()),
        tool: Some("pan".to_owned()),
        reference: Some(PinnedReference::new(&picture_file, &[])),
        ..WindowSetup::default()
    };
    first.state_mut().files().note_window_setup(setup.clone());
    change(&mut first);
    let kept = first.state().canvas.clone();
    until(&mut first, "an autosave of the desk", |_: &mut Window| {
        let paths = walk(&sessions).into_iter().filter(|path| path.ends_with("session.json"));
        let texts = paths.filter_map(|path| std::fs::read_to_string(path).ok());
        texts.into_iter().any(|text| text.contains("orchard.png"))
    });
    // This simulates a crash: the lock is released, the folder stays.
    drop(first);

    let mut second = window(folder.path(), painted("Another"));
    assert!(shows(&second, "A painting was not saved"), "recovery is offered");
    assert!(shows(&second, "A study"), "the title is shown");
    picture(&mut second, "recover");
    click(&mut second, "Recover");
    until(&mut second, "the painting", |window| !window.state().commands.is_empty());
    assert_eq!(*second.state().canvas, *kept);
    let [Command::Open(Origin::Recovered { kept: Some(session), .. })] =
        &second.state().commands[..]
    else {
        panic!("{:?}", second.state().commands)
    };
    let recording = session.recording.as_ref().unwrap();
    assert_eq!(recording.actions, [Action::Dry { fraction: 0.5 }], "the recording");
    let mut found = second.state_mut().files().take_window_setup().unwrap();
    let digest = found.reference.as_mut().and_then(|reference| reference.sha256.take());
    assert_eq!(digest.map(|digest| digest.len()), Some(64));
    assert_eq!(found, setup);
    assert!(second.state_mut().files().take_window_setup().is_none(), "once");
    assert!(second.state_mut().files().has_unsaved_changes(), "the recovered painting is unsaved");
    until(&mut second, "its own autosave", |_: &mut Window| {
        std::fs::read_dir(&sessions).unwrap().count() == 1
    });
    drop(second);
    let mut third = window(folder.path(), painted("Another"));
    assert!(shows(&third, "A study"), "it is offered again after a second crash");
    click(&mut third, "Discard");
    assert!(!shows(&third, "A study"), "discarded");
    third.state_mut().files().finish();
    let sessions = folder.path().join("own").join("sessions");
    assert_eq!(std::fs::read_dir(sessions).unwrap().count(), 0, "a regular exit leaves nothing");
}

fn walk(folder: &Path) -> Vec<std::path::PathBuf> {
    let paths = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path());
    paths.flat_map(|path| if path.is_dir() { walk(&path) } else { vec![path] }).collect()
}

/// Requests closing the window. Returns whether it closes.
fn closes(window: &mut Window) -> bool {
    let viewports = &mut window.input_mut().viewports;
    viewports.entry(ViewportId::ROOT).or_default().events.push(ViewportEvent::Close);
    window.step();
    let commands = &window.output().viewport_output[&ViewportId::ROOT].commands;
    let held = commands.iter().any(|command| matches!(command, ViewportCommand::CancelClose));
    window.input_mut().viewports.entry(ViewportId::ROOT).or_default().events.clear();
    window.step();
    !held
}

#[test]
fn a_window_with_changes_asks_before_it_closes() {
    let (folder, path) = folder();
    let mut window = window(folder.path(), painted("A study"));
    assert!(closes(&mut window), "nothing was changed");
    change(&mut window);
    assert!(!closes(&mut window), "something was");
    assert!(shows(&window, "Save the painting?"), "the window asks");
    picture(&mut window, "unsaved");
    click(&mut window, "Cancel");
    assert!(!closes(&mut window), "the window asks again");
    click(&mut window, "Save");
    type_name(&mut window, "study");
    click(&mut window, "Save");
    until(&mut window, "the file", |_| path.is_file());
    until(&mut window, "the end", |window| !window.state_mut().files().has_unsaved_changes());
    assert!(closes(&mut window), "it is saved");
}

#[test]
fn a_window_that_is_closed_while_it_saves_closes_when_it_has_saved() {
    let (folder, path) = folder();
    let mut window = window(folder.path(), painted("A study"));
    super::bench::save_as(&mut window, &path);
    change(&mut window);
    window.state_mut().holds_snapshots = true;
    ask(&mut window, FileRequest::Save);
    assert!(!closes(&mut window), "it is not saved yet");
    assert!(!window.state_mut().files().has_dialog(), "nothing has to be asked");
    let status = window.state_mut().files().take_status().unwrap();
    assert!(status.text.contains("being saved") && status.text.contains("closes"), "{status:?}");
    window.state_mut().holds_snapshots = false;
    let mut closed = false;
    until(&mut window, "the end", |window| {
        let commands = &window.output().viewport_output[&ViewportId::ROOT].commands;
        closed |= commands.iter().any(|command| matches!(command, ViewportCommand::Close));
        closed
    });
    assert_eq!(document(&path), *window.state().canvas, "it was saved before");
    assert!(closes(&mut window), "the window closes");
}

#[test]
fn a_save_that_the_worker_never_answers_does_not_keep_the_window_open() {
    let (folder, path) = folder();
    let mut window = window(folder.path(), painted("A study"));
    super::bench::save_as(&mut window, &path);
    change(&mut window);
    window.state_mut().holds_snapshots = true;
    ask(&mut window, FileRequest::Save);
    assert!(!closes(&mut window) && !shows(&window, "Save the painting?"), "it waits");
    assert!(!closes(&mut window), "it is not saved");
    click(&mut window, "Discard");
    assert!(closes(&mut window), "the painter gave it up");
}

#[test]
fn a_lost_session_that_cannot_be_read_is_named_by_its_title() {
    let (folder, _) = folder();
    let mut first = window(folder.path(), painted("A study"));
    change(&mut first);
    let sessions = folder.path().join("own").join("sessions");
    let generation = || {
        let session = std::fs::read_dir(&sessions).ok()?.next()?.ok()?.path();
        let mut inside =
            std::fs::read_dir(session).ok()?.filter_map(|entry| Some(entry.ok()?.path()));
        inside.find(|path| path.to_string_lossy().contains("generation"))
    };
    until(&mut first, "an autosave", |_| generation().is_some());
    drop(first);
    std::fs::write(generation().unwrap().join("canvas.exr"), b"\x76\x2f\x31\x01cut off").unwrap();

    let mut second = window(folder.path(), painted("Another"));
    click(&mut second, "Recover");
    until(&mut second, "the problem", |window| shows(window, "OK"));
    assert!(shows(&second, "autosave of A study"), "it has the painting's name");
    for raw in ["generation-", "canvas.exr", "sessions"] {
        assert!(!shows(&second, raw), "{raw} is shown");
    }
}

#[test]
fn discarding_changes_lets_the_window_close() {
    let (folder, _) = folder();
    let mut window = window(folder.path(), painted("A study"));
    change(&mut window);
    assert!(!closes(&mut window), "something was changed");
    click(&mut window, "Discard");
    assert!(closes(&mut window), "the changes were discarded");
    window.state_mut().files().finish();
    let sessions = folder.path().join("own").join("sessions");
    assert_eq!(std::fs::read_dir(sessions).unwrap().count(), 0, "the changes were discarded");
}

#[test]
fn opening_another_painting_asks_before_discarding_changes() {
    let (folder, path) = folder();
    std::fs::write(&path, paint::file::write(&painted("B")).unwrap()).unwrap();
    let mut window = window(folder.path(), painted("A"));
    change(&mut window);
    ask(&mut window, FileRequest::Open(Some(path.clone())));
    until(&mut window, "the question", |window| shows(window, "Save the painting?"));
    assert_eq!(window.state().canvas.title, "A");
    click(&mut window, "Discard");
    until(&mut window, "the other", |window| window.state().canvas.title == "B");
    assert_eq!(window.state_mut().files().path(), Some(&*path));
    assert!(!window.state_mut().files().has_unsaved_changes(), "the painting equals its file");
}

const PATIENCE: Duration = Duration::from_secs(20);

fn state(revision: u64) -> SceneState {
    let library = Arc::new(PigmentLibrary::van_gogh_oils());
    SceneState {
        title: "village".to_owned(),
        bounds: [Vec3::ZERO, Vec3::ONE],
        triangles: 1,
        unit_mm: 1.0,
        flat: false,
        framed: Framing::default().camera([Vec3::ZERO, Vec3::ONE]),
        seen_from: None,
        library: Arc::clone(&library),
        light: Arc::new(Light::named(&library, "D65", "1931-2").unwrap()),
        illuminant: "D65".to_owned(),
        prepares: false,
        tubes: Arc::default(),
        look: Look::default(),
        by_region: false,
        time: SceneTime::default(),
        events: Arc::default(),
        tally: SceneTally::default(),
        revision,
    }
}

fn recording(text: &str, folder: &Path, revision: u64) -> SceneRecording {
    let folder = folder.to_owned();
    SceneRecording { text: text.into(), folder, subject: None, library: None, revision }
}

/// The files of a window whose home is `home`.
fn scene_window(home: &Path) -> Harness<'static, Option<Files>> {
    let home = home.to_owned();
    Harness::builder().with_size(vec2(700.0, 400.0)).build_ui_state(
        move |ui: &mut Ui, files: &mut Option<Files>| {
            let preferences = Preferences { autosave_seconds: 2, ..Preferences::default() };
            let files = files
                .get_or_insert_with(|| Files::new(ui.ctx(), Home::in_folder(&home), preferences));
            files.update(ui.ctx());
            files.show(ui);
        },
        None,
    )
}

fn wait(window: &mut Harness<'static, Option<Files>>, mut done: impl FnMut(&mut Files) -> bool) {
    let start = Instant::now();
    while !done(window.state_mut().as_mut().unwrap()) {
        assert!(start.elapsed() < PATIENCE, "it does not come");
        std::thread::sleep(Duration::from_millis(10));
        window.step();
    }
}

/// Opens a scene, changes it, and waits until it is autosaved.
fn autosaved(window: &mut Harness<'static, Option<Files>>, text: &str, folder: &Path) {
    window.step();
    let files = window.state_mut().as_mut().unwrap();
    files.scene_opened(&state(0));
    assert!(!files.wants_scene_recording(), "nothing has changed");
    files.scene_changed(&state(1));
    wait(window, Files::wants_scene_recording);
    let files = window.state_mut().as_mut().unwrap();
    assert!(!files.wants_scene_recording(), "it was asked for");
    files.autosave_scene(&recording(text, folder, 1));
    let scenes = folder.join("scenes");
    wait(window, |_| walk(&scenes).iter().any(|path| path.ends_with("scene.toml")));
    assert!(!window.state_mut().as_mut().unwrap().wants_scene_recording(), "it is kept");
}
#[test]
fn a_scene_left_by_a_crash_is_offered_and_recovered() {
    let folder = tempfile::tempdir().unwrap();
    let mut first = scene_window(folder.path());
    autosaved(&mut first, "the script", folder.path());
    // This simulates a crash: the window ends without finishing.
    drop(first);
    let start = Instant::now();
    let scenes = Home::in_folder(folder.path()).scenes();
    // The thread that wrote the autosave ends soon.
    while LostSession::all(&scenes).unwrap().is_empty() {
        assert!(start.elapsed() < PATIENCE, "the lock stays");
    }
    let mut second = scene_window(folder.path());
    second.run_steps(3);
    assert!(second.query_by_label("A scene was not saved").is_some(), "recovery is offered");
    second.get_by_label("Recover").click();
    second.run_steps(3);
    let files = second.state_mut().as_mut().unwrap();
    let Some(SceneAnswer::Recover(lost)) = files.take_scene_answer() else {
        panic!("it is recovered");
    };
    assert_eq!(std::fs::read_to_string(lost.script()).unwrap(), "the script");
    assert_eq!(lost.meta.path.as_deref(), Some(folder.path()));
    files.recovering_scene(lost);
    files.scene_opened(&state(0));
    wait(&mut second, Files::wants_scene_recording);
    let files = second.state_mut().as_mut().unwrap();
    files.autosave_scene(&recording("again", folder.path(), 0));
    wait(&mut second, |_| {
        let paths = walk(&folder.path().join("scenes")).into_iter();
        let scripts = paths.filter(|path| path.ends_with("scene.toml"));
        scripts.filter_map(|path| std::fs::read_to_string(path).ok()).eq(["again"])
    });
}

#[test]
fn a_scene_that_was_saved_leaves_no_autosave() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = scene_window(folder.path());
    autosaved(&mut window, "the script", folder.path());
    let path = folder.path().join("village.toml");
    let files = window.state_mut().as_mut().unwrap();
    files.save_scene(&recording("the script", folder.path(), 1), path.clone());
    wait(&mut window, |_| path.exists());
    window.run_steps(5);
    window.state_mut().as_mut().unwrap().finish();
    assert!(walk(&folder.path().join("scenes")).is_empty(), "nothing is left");
    assert_eq!(std::fs::read_to_string(path).unwrap(), "the script");
}

#[test]
fn a_script_is_saved_beside_its_subject_only() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = scene_window(folder.path());
    window.step();
    let elsewhere = folder.path().join("elsewhere");
    std::fs::create_dir(&elsewhere).unwrap();
    let subject = Some(elsewhere.join("jug.glb"));
    let files = window.state_mut().as_mut().unwrap();
    files.scene_opened(&state(0));
    let recording = SceneRecording { subject, ..recording("text", &elsewhere, 0) };
    files.save_scene(&recording, folder.path().join("jug.toml"));
    let start = Instant::now();
    while window.query_by_label_contains("save it in").is_none() {
        assert!(start.elapsed() < PATIENCE, "there is no message");
        window.step();
    }
    assert!(!folder.path().join("jug.toml").exists(), "nothing is written");
    window.state_mut().as_mut().unwrap().save_scene(&recording, elsewhere.join("jug.toml"));
    wait(&mut window, |_| elsewhere.join("jug.toml").exists());
}
