//! Tests of scenes: libraries, tubes, lights and what is saved of them, and gestures compared with
//! their scripts.

use std::path::{Path, PathBuf};

use graphics::camera::Camera;
use pigment::library::PigmentLibrary;
use tempfile::TempDir;
use volumes::performance::{FirstView, Performance};
use volumes::script::Script;
use volumes::volume::Volume;
use web_time::{Duration, Instant};

use super::command::{Grip, ScenePen, SceneTool, Subject};
use super::painters::{Quality, Sight};
use super::scene::Scene;

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
    fn read(path: &Path) -> Vec<u8> {
        std::fs::read(path).unwrap()
    }
    assert_eq!(read(&file("mine.json")), read(&folder.path().join("mine.json")));
    let saved = Script::open(&file("s.toml")).unwrap();
    assert_eq!(saved.library.as_deref(), Some("mine.json"));
    recording.save(&file("t.toml")).unwrap();
    assert_eq!(read(&file("s.toml")), read(&file("t.toml")), "the library is there already");
    std::fs::write(file("mine.json"), "another").unwrap();
    let failure = recording.save(&file("u.toml")).unwrap_err();
    assert!(failure.what.contains("mine.json") && failure.hint.is_some(), "{failure:?}");
    assert!(!file("u.toml").exists() && read(&file("mine.json")) == b"another");
    // Nothing but the library is copied.
    recording.save(&folder.path().join("v.toml")).unwrap();
    assert_eq!(read(&folder.path().join("v.toml")), read(&file("s.toml")));
}

const SIZE: [usize; 2] = [120, 90];

fn still_life() -> Scene {
    Scene::open(&Subject::Shape("still-life".to_owned())).unwrap()
}

fn sight(scene: &Scene) -> Sight {
    Sight { camera: scene.usual_camera(), size: SIZE }
}

fn pen(x: f32, y: f32) -> ScenePen {
    ScenePen { at: [x, y], pressure: 1.0 }
}

/// Holds a tool down for 30 steps along a line, and continues for 20 more.
fn gesture(scene: &mut Scene, grip: Grip, from: [f32; 2], to: [f32; 2]) {
    let sight = sight(scene);
    assert!(scene.pen_down(&sight, grip, pen(from[0], from[1])).unwrap(), "there is a surface");
    for step in 0..30_u8 {
        let share = f32::from(step) / 29.0;
        let at = [0, 1].map(|axis: usize| from[axis] + (to[axis] - from[axis]) * share);
        scene.pen_move(&sight, pen(at[0], at[1]));
        scene.step().unwrap();
    }
    scene.pen_up().unwrap();
    (0..20).for_each(|_| scene.step().unwrap());
}

fn pour(tube: usize) -> Grip {
    Grip { tube, rate_mm3_s: 200.0, ..Grip::default() }
}

fn settle(scene: &mut Scene) {
    while scene.is_behind() {
        scene.catch_up(Instant::now() + Duration::from_secs(1)).unwrap();
    }
}

fn picture(scene: &mut Scene) -> Vec<[u8; 4]> {
    let sight = sight(scene);
    scene.pixels(&sight, Quality { fine: false, share: 1.0, waits: true }).unwrap()
}

/// The volumes that you get when you play the saved script to the present moment.
fn played(scene: &Scene, camera: Option<Camera>) -> Vec<Volume> {
    let recording = scene.recording(camera).unwrap();
    let script = Script::from_text("recording", &recording.text).unwrap();
    let mesh = scene.mesh();
    let view = FirstView::new(mesh, &scene.usual_camera(), (4, 3));
    let settings = script.settings().unwrap();
    let mut performance = Performance::new(&script, mesh, &settings, &view).unwrap();
    performance.advance_to(scene.moment()).unwrap();
    performance.world().volumes().to_vec()
}

#[test]
fn what_hands_do_is_what_the_saved_script_plays() {
    let mut scene = still_life();
    gesture(&mut scene, pour(5), [0.45, 0.5], [0.55, 0.5]);
    gesture(&mut scene, pour(2), [0.5, 0.55], [0.4, 0.6]);
    let push = Grip { tool: SceneTool::Push, strength: 1.0, ..Grip::default() };
    gesture(&mut scene, push, [0.4, 0.5], [0.6, 0.5]);
    assert_eq!(played(&scene, None), scene.volumes(), "poured and pushed");
    let before: u64 = scene.on_scene();
    let lift = Grip { tool: SceneTool::Lift, ..Grip::default() };
    gesture(&mut scene, lift, [0.5, 0.5], [0.5, 0.5]);
    assert!(scene.on_scene() < before, "paint was taken up");
    gesture(&mut scene, Grip { tool: SceneTool::Dry, ..lift }, [0.5, 0.5], [0.5, 0.5]);
    fn dry(scene: &Scene) -> usize {
        scene.volumes().iter().filter(|volume| volume.dry).count()
    }
    let count = scene.volumes().len();
    assert!((1..count).contains(&dry(&scene)), "{} of {count} are dry", dry(&scene));
    scene.dry_all().unwrap();
    assert_eq!(dry(&scene), scene.volumes().len(), "all is dry");
    gesture(&mut scene, pour(0), [0.5, 0.5], [0.5, 0.5]);
    let labels: Vec<String> = scene.events().into_iter().map(|event| event.label).collect();
    let wanted = [
        "pour Ultramarine",
        "pour Chrome Yellow",
        "push",
        "lift",
        "dry",
        "dry all paint",
        "pour Zinc White",
    ];
    assert_eq!(labels, wanted);
    assert_eq!(played(&scene, Some(scene.usual_camera())), scene.volumes(), "all of it");
}

#[test]
fn a_moment_that_is_gone_to_has_the_bytes_that_it_had() {
    let mut scene = still_life();
    let empty = picture(&mut scene);
    gesture(&mut scene, pour(5), [0.45, 0.5], [0.55, 0.5]);
    let moment = scene.moment();
    let then = picture(&mut scene);
    assert_ne!(then, empty, "colour appears");
    gesture(&mut scene, pour(2), [0.5, 0.55], [0.4, 0.6]);
    (0..100).for_each(|_| scene.step().unwrap());
    let last = scene.moment();
    let end = picture(&mut scene);
    assert_ne!(end, then);
    for (step, wanted) in [(moment, &then), (last, &end), (0, &empty), (moment, &then)] {
        scene.go_to(step).unwrap();
        settle(&mut scene);
        assert_eq!((scene.moment(), &picture(&mut scene)), (step, wanted), "step {step}");
    }
}

#[test]
fn an_event_that_is_taken_back_leaves_what_there_was_without_it() {
    let mut scene = still_life();
    gesture(&mut scene, pour(5), [0.45, 0.5], [0.55, 0.5]);
    (0..50).for_each(|_| scene.step().unwrap());
    let wanted = picture(&mut scene);
    scene.go_to(50).unwrap();
    settle(&mut scene);
    // This comes between events that exist already.
    gesture(&mut scene, pour(2), [0.5, 0.55], [0.4, 0.6]);
    assert_eq!((scene.moment(), scene.end()), (100, 100));
    let with_both = picture(&mut scene);
    assert_ne!(with_both, wanted);
    assert_eq!(played(&scene, None), scene.volumes());
    scene.undo().unwrap();
    settle(&mut scene);
    assert_eq!(scene.moment(), 100, "the moment stays");
    assert_eq!(picture(&mut scene), wanted);
    scene.remove(0).unwrap();
    settle(&mut scene);
    assert!(scene.volumes().is_empty() && scene.events().is_empty());
    scene.undo().unwrap();
    scene.remove(3).unwrap();
    assert_eq!(scene.moment(), 100, "there is nothing to take back");
}

#[test]
fn paint_that_is_poured_in_the_past_joins_what_follows() {
    let mut scene = still_life();
    gesture(&mut scene, pour(5), [0.45, 0.5], [0.55, 0.5]);
    // There is a snapshot each second.
    (0..220).for_each(|_| scene.step().unwrap());
    let before = picture(&mut scene);
    scene.go_to(60).unwrap();
    settle(&mut scene);
    gesture(&mut scene, pour(2), [0.5, 0.55], [0.4, 0.6]);
    scene.go_to(270).unwrap();
    settle(&mut scene);
    assert_ne!(picture(&mut scene), before);
    assert_eq!(played(&scene, None), scene.volumes());
    scene.undo().unwrap();
    settle(&mut scene);
    assert_eq!(picture(&mut scene), before);
}

#[test]
fn a_recording_that_is_opened_again_goes_on_the_same() {
    let mut scene = still_life();
    gesture(&mut scene, pour(5), [0.45, 0.5], [0.55, 0.5]);
    let text = scene.recording(Some(scene.usual_camera())).unwrap();
    let folder = text.folder.clone();
    let mut again = Scene::open(&Subject::Text { text: text.text.to_string(), folder }).unwrap();
    assert_eq!((again.moment(), again.end()), (0, 50));
    again.go_to(50).unwrap();
    settle(&mut again);
    assert_eq!((again.volumes(), again.events()), (scene.volumes(), scene.events()));
    gesture(&mut scene, pour(2), [0.5, 0.55], [0.4, 0.6]);
    gesture(&mut again, pour(2), [0.5, 0.55], [0.4, 0.6]);
    assert_eq!(again.volumes(), scene.volumes());
}

#[test]
fn beside_the_subject_nothing_is_poured_and_nothing_recorded() {
    let mut scene = still_life();
    let sight = sight(&scene);
    assert!(!scene.pen_down(&sight, pour(5), pen(0.01, 0.01)).unwrap(), "there is only paper");
    scene.step().unwrap();
    scene.pen_up().unwrap();
    assert!(scene.events().is_empty());
    let here = scene.here(&sight, [0.01, 0.01]);
    assert_eq!((here.place, here.volumes), (None, 0));
}

#[test]
fn a_place_tells_its_paint_and_its_colour() {
    let mut scene = still_life();
    let dry = scene.here(&sight(&scene), [0.5, 0.5]);
    assert!(dry.place.is_some() && dry.paint.is_none() && dry.volumes == 0, "{dry:?}");
    gesture(&mut scene, pour(5), [0.5, 0.5], [0.5, 0.5]);
    picture(&mut scene);
    let wet = scene.here(&sight(&scene), [0.5, 0.5]);
    let paint = wet.paint.as_ref().unwrap();
    let name = &scene.materials.library[paint.slots[5].unwrap()].name;
    let poured: Vec<usize> = (0..9).filter(|&slot| paint.amounts_mm[slot] > 0.0).collect();
    assert_eq!((&poured[..], name.as_str()), (&[5][..], "Ultramarine"), "{wet:?}");
    assert!((0.001..1.0).contains(&paint.amounts_mm[5]), "{wet:?}");
    assert!(wet.volumes > 0 && wet.lab[0] > 0.0, "{wet:?}");
}

#[test]
fn places_picked_on_a_photograph_are_those_of_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wide.png");
    image::RgbImage::from_pixel(64, 16, image::Rgb([90, 120, 60])).save(&path).unwrap();
    let text = "format = \"paint-volumes\"\nversion = 1\nsubject = \"wide.png\"\nseconds = 1.0\n\
                [[pour]]\npicked = [0.75, 0.25]\nfor_s = 0.5\namount_mm3 = 1.0\n";
    let subject = Subject::Text { text: text.to_owned(), folder: folder.path().to_owned() };
    let scene = Scene::open(&subject).unwrap();
    let script = scene.script();
    let at = script.pours[0].at.unwrap().0;
    // The picture is 1 x 0.25 around the origin, with y upwards.
    let wanted = [0.25, 0.0625, 0.0];
    let near = at.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-3);
    assert!(near, "{at:?}");
}
