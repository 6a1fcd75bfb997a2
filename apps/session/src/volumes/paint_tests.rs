//! Pigments of scenes: libraries, tubes, lights, and what is saved of them.

use std::path::{Path, PathBuf};

use pigment::library::PigmentLibrary;
use tempfile::TempDir;
use volumes::script::Script;

use super::painters::Sight;
use super::scene::Scene;
use super::subject::Subject;
use super::tool::{Grip, ScenePen};

/// A still life with paint of the sixth tube in the middle.
fn poured() -> Scene {
    let mut scene = Scene::open(&Subject::Shape("still-life".to_owned())).unwrap();
    let sight = Sight { camera: scene.usual_camera(), size: [60, 45] };
    let grip = Grip { tube: 5, rate_mm3_s: 300.0, ..Grip::default() };
    let pen = ScenePen { at: [0.5, 0.5], pressure: 1.0 };
    assert!(scene.pen_down(&sight, grip, pen).unwrap());
    (0..30).for_each(|_| scene.step().unwrap());
    scene.pen_up().unwrap();
    scene
}

/// The Van Gogh oils without some of them, in a file.
fn library(folder: &TempDir, name: &str, without: &[&str]) -> PathBuf {
    let mut library = PigmentLibrary::van_gogh_oils();
    library.title = name.to_owned();
    library.pigments.retain(|pigment| !without.contains(&pigment.name.as_str()));
    let path = folder.path().join(name);
    std::fs::write(&path, library.to_json()).unwrap();
    path
}

fn names(scene: &Scene) -> Vec<String> {
    scene.materials.tubes.iter().map(|tube| tube.name.clone()).collect()
}

fn script(scene: &Scene) -> Script {
    Script::from_own_text("recording", &scene.recording(None).unwrap().text).unwrap()
}

#[test]
fn a_library_fills_the_tubes_and_poured_paint_is_of_its_pigments() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = poured();
    let before = scene.volumes().to_vec();
    let revision = scene.recorded.revision();
    assert_eq!(names(&scene)[5], "Ultramarine");
    let path = library(&folder, "mine.json", &["Vermilion"]);
    scene.set_library(&path).unwrap();
    assert_eq!(names(&scene)[5], "Cochineal Lake", "the first pigments of the library");
    assert!(scene.volumes() == before, "paint lies where it lay");
    assert!(scene.recorded.revision() > revision);
    assert_eq!(scene.events()[0].label, "pour Cochineal Lake");
    assert_eq!(script(&scene).library, Some(path.display().to_string()));
    let recording = scene.recording(None).unwrap();
    assert_eq!(recording.library.as_deref(), Some(path.as_path()));
    // Recovered after a crash.
    let text = Subject::Text { text: recording.text.to_string(), folder: PathBuf::new() };
    let again = Scene::open(&text).unwrap();
    assert_eq!(
        (names(&again), &again.materials.library.title),
        (names(&scene), &"mine.json".into())
    );
    assert_eq!(again.materials.file, Some(path));
}

#[test]
fn libraries_that_do_not_fit_are_refused_and_nothing_changes() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = poured();
    let before = (names(&scene), script(&scene));
    let all = PigmentLibrary::van_gogh_oils();
    let most: Vec<&str> = all.pigments.iter().skip(4).map(|own| own.name.as_str()).collect();
    let small = library(&folder, "small.json", &most);
    let text = folder.path().join("text.json");
    std::fs::write(&text, "no library").unwrap();
    for (path, wanted) in
        [(small, "8 tubes"), (text, "text.json"), (folder.path().join("none.json"), "none.json")]
    {
        let failure = scene.set_library(&path).unwrap_err();
        assert!(failure.what.contains(wanted), "{failure:?}");
        assert!(failure.hint.is_some(), "{failure:?}");
        assert_eq!((names(&scene), script(&scene)), before, "{wanted}");
    }
    let failure = scene.set_tube(1, "Mauve").unwrap_err();
    assert!(failure.what.contains("Mauve"), "{failure:?}");
    assert!(scene.set_tube(1, "Ultramarine").is_err(), "another tube has it");
    assert_eq!((names(&scene), script(&scene)), before);
    scene.set_tube(1, "Viridian").unwrap();
    assert_eq!(names(&scene)[1], "Viridian");
    assert_eq!(script(&scene).palette["B"], "Viridian");
}

#[test]
fn tubes_show_their_colours_under_the_light_that_the_script_keeps() {
    let mut scene = poured();
    let by_day: Vec<_> = scene.materials.tubes.iter().map(|tube| tube.tint).collect();
    assert_eq!(script(&scene).illuminant, None, "the usual light is not written");
    scene.set_illuminant("FL4").unwrap();
    assert_eq!(script(&scene).illuminant.as_deref(), Some("FL4"));
    let by_lamp: Vec<_> = scene.materials.tubes.iter().map(|tube| tube.tint).collect();
    assert_ne!(by_lamp, by_day);
    let text = scene.recording(None).unwrap().text.to_string();
    let again = Scene::open(&Subject::Text { text, folder: PathBuf::new() }).unwrap();
    assert_eq!(again.materials.illuminant, "FL4");
    let failure = scene.set_illuminant("Cargo.toml").unwrap_err();
    assert!(failure.what.contains("Cargo.toml") && failure.hint.is_some(), "{failure:?}");
    assert_eq!(scene.materials.illuminant, "FL4");
    scene.set_illuminant("D65").unwrap();
    assert_eq!(script(&scene).illuminant, None);
}

#[test]
fn a_script_is_saved_with_its_library_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = poured();
    scene.set_library(&library(&folder, "mine.json", &[])).unwrap();
    let recording = scene.recording(None).unwrap();
    let elsewhere = tempfile::tempdir().unwrap();
    let file = |name: &str| elsewhere.path().join(name);
    recording.save(&file("s.toml")).unwrap();
    let read = |path: &Path| std::fs::read(path).unwrap();
    assert_eq!(read(&file("mine.json")), read(&folder.path().join("mine.json")));
    let saved = Script::open(&file("s.toml")).unwrap();
    assert_eq!(saved.library.as_deref(), Some("mine.json"));
    recording.save(&file("t.toml")).unwrap();
    assert_eq!(read(&file("s.toml")), read(&file("t.toml")), "the library is there already");
    std::fs::write(file("mine.json"), "another").unwrap();
    let failure = recording.save(&file("u.toml")).unwrap_err();
    assert!(failure.what.contains("mine.json") && failure.hint.is_some(), "{failure:?}");
    assert!(!file("u.toml").exists() && read(&file("mine.json")) == b"another");
    // Beside the library nothing is copied.
    recording.save(&folder.path().join("v.toml")).unwrap();
    assert_eq!(read(&folder.path().join("v.toml")), read(&file("s.toml")));
}
