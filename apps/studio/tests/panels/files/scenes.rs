//! Scenes are autosaved as scripts, and offered after a crash.

use std::path::Path;
use std::sync::Arc;
use web_time::{Duration, Instant};

use eframe::egui::{Ui, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use glam::Vec3;
use graphics::camera::Framing;
use paint::light::Light;
use pigment::library::PigmentLibrary;
use session::LostSession;
use session::volumes::{Look, SceneRecording, SceneState, SceneTally, SceneTime};
use studio::files::{Files, Home, Preferences, SceneAnswer};

/// Time limit of every wait.
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
fn window(home: &Path) -> Harness<'static, Option<Files>> {
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
    let kept = || walk(&scenes).iter().any(|path| path.ends_with("scene.toml"));
    wait(window, |_| kept());
    assert!(!window.state_mut().as_mut().unwrap().wants_scene_recording(), "it is kept");
}

/// All files below a folder.
fn walk(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    paths.flat_map(|path| if path.is_dir() { walk(&path) } else { vec![path] }).collect()
}

#[test]
fn a_scene_left_by_a_crash_is_offered_and_recovered() {
    let folder = tempfile::tempdir().unwrap();
    let mut first = window(folder.path());
    autosaved(&mut first, "the script", folder.path());
    // A crash: the window ends without finishing.
    drop(first);
    let start = Instant::now();
    let scenes = Home::in_folder(folder.path()).scenes();
    // The thread that wrote the autosave ends soon.
    while LostSession::all(&scenes).unwrap().is_empty() {
        assert!(start.elapsed() < PATIENCE, "the lock stays");
    }
    let mut second = window(folder.path());
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
    let texts = || -> Vec<String> {
        let paths = walk(&folder.path().join("scenes")).into_iter();
        let scripts = paths.filter(|path| path.ends_with("scene.toml"));
        scripts.filter_map(|path| std::fs::read_to_string(path).ok()).collect()
    };
    wait(&mut second, |_| texts() == ["again"]);
}

#[test]
fn a_scene_that_was_saved_leaves_no_autosave() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = window(folder.path());
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
    let mut window = window(folder.path());
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
        assert!(start.elapsed() < PATIENCE, "nothing is told");
        window.step();
    }
    assert!(!folder.path().join("jug.toml").exists(), "nothing is written");
    window.state_mut().as_mut().unwrap().save_scene(&recording, elsewhere.join("jug.toml"));
    wait(&mut window, |_| elsewhere.join("jug.toml").exists());
}
