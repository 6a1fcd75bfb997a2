//! Scripts: reading, writing, events, recording, pigments, limits.

use std::path::Path;

use paint::ground::{GroundKind, GroundSpec, Primer};
use pigment::PigmentLibrary;

use super::samples::{DESCRIBED, SHORT, WHOLE};
use super::*;
use crate::settings::{Inside, Preset, Settings};

fn script(text: &str) -> Script {
    Script::from_text("s.toml", text).unwrap()
}

#[test]
fn a_written_script_is_read_to_the_bit_and_written_to_the_byte() {
    for text in [WHOLE, SHORT, DESCRIBED] {
        let own = script(text);
        assert_eq!(own, own.rounded());
        let written = own.to_text().unwrap();
        assert_eq!(script(&written), own, "{written}");
        assert_eq!(script(&written).to_text().unwrap(), written);
    }
}

#[test]
fn every_documented_key_is_read() {
    let text: String = include_str!("mod.rs")
        .lines()
        .skip_while(|line| *line != "//! ```toml")
        .skip(1)
        .take_while(|line| *line != "//! ```")
        .map(|line| format!("{}\n", line.trim_start_matches("//!").trim_start()))
        .collect();
    let own = script(&text);
    assert_eq!((own.pours.len(), own.lifts.len(), own.events().len()), (1, 1, 6));
    assert_eq!(own.settings().unwrap().motion.kick, 0.5);
}

#[test]
fn odd_figures_are_rounded_once() {
    let mut own = script(SHORT);
    own.seconds = 1.0 / 3.0;
    own.unit_mm = Some(1_234.567_89);
    own.settings = "motion.kick = 0.12345678\nseed = 1234567\ngrid.film_mm = 1e-3".parse().unwrap();
    let at = Row([1.0 / 3.0, -0.0, 1e-9]);
    let radius = 2.0 / 3.0;
    own.dries.push(DryTable { at_s: 0.1234567, at: Some(at), radius: Some(radius) });
    own.keeps.push(KeepTable {
        sphere: Some(Ball { center: [-0.0, 1e-9, 1.0 / 7.0], radius: 2.0 / 3.0 }),
        ..KeepTable::default()
    });
    let read = script(&own.to_text().unwrap());
    assert_eq!(read, own.rounded());
    assert_ne!(read, own);
    assert_eq!((read.seconds, read.unit_mm), (0.3333, Some(1234.57)));
    let ball = Ball { center: [0.0, 1e-9, 0.142857], radius: 0.666667 };
    assert_eq!((read.dries[0].at_s, read.keeps[0].sphere), (0.1235, Some(ball)));
    let dry = (read.dries[0].at, read.dries[0].radius);
    assert_eq!(dry, (Some(Row([0.333333, 0.0, 1e-9])), Some(0.666667)));
    let settings = read.settings().unwrap();
    assert_eq!((settings.motion.kick, settings.seed), (0.123457, 1_234_567));
}

#[test]
fn what_a_script_leaves_out_has_its_default() {
    let own = script(SHORT);
    assert_eq!(own.settings().unwrap(), Preset::Sketch.settings());
    let styles = own.region_styles(&own.settings().unwrap());
    let sketch = RegionStyle {
        name: String::new(),
        inside: Inside::OwnColors,
        shells: vec![1.0],
        tints: vec![0.0, 1.0],
        stain: "#ffffff".to_owned(),
    };
    assert_eq!(styles, [sketch]);
    assert_eq!(own.events(), []);
    let volume = "[[volume]]\ncentre = [0, 0, 0]\nradius = 1";
    let own = script(&format!("{SHORT}{volume}"));
    assert_eq!((own.volumes[0].detail, own.volumes[0].from_s), (3, 0.0));
}

#[test]
fn settings_and_regions_are_put_together() {
    let own = script(WHOLE);
    let settings = own.settings().unwrap();
    let washed = Preset::Washed.settings();
    assert_eq!((settings.motion.kick, settings.grid.cell, settings.unit_mm), (0.5, 0.083, 100.0));
    assert_eq!(settings.motion.cohesion, washed.motion.cohesion);
    assert_eq!(settings.hatching, washed.hatching);
    let [sky, glow] = &own.region_styles(&settings)[..] else { panic!("two regions") };
    assert_eq!((sky.shells.len(), &sky.tints[..]), (4, &[0.0, 0.25, 0.5, 0.75, 1.0][..]));
    assert_eq!(
        (&glow.shells[..], &glow.tints[..]),
        (&[1.0, 0.93, 0.86][..], &[0.0, 0.35, 0.7, 1.0][..])
    );
    assert_eq!((sky.stain.as_str(), glow.stain.as_str()), ("#ffffff", "#e8d8b8"));
    let shells = "preset = \"washed\"\n[[region]]\nname = \"a\"\nshells = [1.0, 0.5]";
    let own = script(&format!("{SHORT}{shells}"));
    assert_eq!(own.region_styles(&Settings::default())[0].tints, [0.0, 0.5, 1.0]);
}

#[test]
fn events_are_sorted_by_steps_of_a_hundred_and_twentieth_second() {
    let events = script(WHOLE).events();
    let told: Vec<_> =
        events.iter().map(|event| (event.start, event.end, event.table.to_string())).collect();
    let wanted = [
        (0, 1, "[[volume]] 1"),
        (30, 31, "[[pour]] 2"),
        (60, 300, "[[pour]] 1"),
        (360, 420, "[[push]] 1"),
        (480, 540, "[[lift]] 1"),
        (540, 541, "[[split]] 1"),
        (600, 601, "[[dry]] 1"),
        (660, 661, "[[dry]] 2"),
    ];
    assert_eq!(told, wanted.map(|(start, end, table)| (start, end, table.to_owned())));
    let Action::Pour(pour) = &events[2].action else { panic!("{:?}", events[2]) };
    assert_eq!((pour.region, pour.quantity), (1, Quantity::Rate(40.0)));
    assert_eq!(pour.place.at(0.5), Some([0.2, 0.6, 0.275]));
    assert_eq!(events[6].action, Action::Dry(Dry::default()));
    let ball = Ball { center: [0.1, 0.6, 0.3], radius: 0.25 };
    assert_eq!(events[7].action, Action::Dry(Dry { ball: Some(ball) }));
}

#[test]
fn a_recording_plays_the_same_events() {
    let own = script(WHOLE);
    let events = own.events();
    let mut header = own.clone();
    header.volumes.clear();
    header.pours.clear();
    header.pushes.clear();
    header.lifts.clear();
    header.splits.clear();
    header.dries.clear();
    let mut recorder = Recorder::new(&header);
    for event in &events {
        recorder.record(event.start, event.end, &event.action);
    }
    let recorded = recorder.script(720);
    assert_eq!((recorded.seconds, recorded.keeps.len()), (6.0, 3));
    let played = script(&recorded.to_text().unwrap()).events();
    let plain = |events: &[Event]| -> Vec<_> {
        events.iter().map(|event| (event.start, event.end, event.action.clone())).collect()
    };
    assert_eq!(plain(&played), plain(&events));
}

#[test]
fn every_step_of_an_hour_is_recorded_and_an_action_is_rounded_before_it_is_done() {
    let mut recorder = Recorder::new(&Script::new("/elsewhere/jug.glb", 0.0));
    let third = 1.0 / 3.0;
    let path = [0.0, 0.00001, 0.0083333].map(|seconds| PathPoint { seconds, at: [third; 3] });
    let pour = Action::Pour(Pour {
        place: Place::Path(path.to_vec()),
        quantity: Quantity::Amount(third),
        recipe: Recipe::new(),
        region: 0,
    });
    for start in (0..432_000).step_by(997) {
        recorder.record(start, start + 1 + start % 1000, &pour);
    }
    let text = recorder.script(432_000).to_text().unwrap();
    assert!(Script::from_text("s.toml", &text).is_err(), "the subject lies in another folder");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.toml");
    std::fs::write(&path, &text).unwrap();
    let events = Script::open_own(&path).unwrap().events();
    for (event, start) in events.iter().zip((0..).step_by(997)) {
        assert_eq!((event.start, event.end), (start, start + 1 + start % 1000));
        assert_eq!(event.action, pour.rounded());
    }
    assert_eq!(events.len(), 434);
    let Action::Pour(Pour { place: Place::Path(points), .. }) = pour.rounded() else { panic!() };
    assert_eq!(points.len(), 2, "points of one moment are one");
}

#[test]
fn pigments_are_found_by_their_letters() {
    let library = PigmentLibrary::van_gogh_oils();
    let text = |y: &str| format!("{SHORT}[palette]\nB = \"Cobalt Blue\"\nY = \"{y}\"\n");
    let own = script(&text("Zinc White"));
    let slots = own.slots(&library).unwrap();
    assert_eq!(slots[0], library.find("Cobalt Blue").ok());
    assert_eq!((slots[1], slots[2]), (library.find("Zinc White").ok(), None));
    let recipe = Recipe::from([("B".to_owned(), 1.0), ("Y".to_owned(), 3.0)]);
    assert_eq!(own.shares(&recipe)[..3], [0.25, 0.75, 0.0]);
    assert_eq!(own.shares(&Recipe::new()), [0.0; 8]);
    for (name, wanted, hint) in [
        ("Zink White", "a pigment of the library, found `Zink White`", "did you mean Zinc White?"),
        ("Cobalt Blue", "a pigment that no other letter has, found `Cobalt Blue`", "leave one"),
    ] {
        let text = text(name);
        let fault = script(&text).slots(&library).unwrap_err();
        let error = ScriptError::located("s.toml", &text, fault);
        assert_eq!(error.to_string(), format!("s.toml, line 7: palette.Y takes {wanted}"));
        let told = documents::hint::Explain::hint(&error).unwrap().to_string();
        assert!(told.starts_with(hint), "{told}");
    }
}

#[test]
fn a_library_is_that_of_the_program_or_a_file() {
    let opened = |name: &str, folder: &Path| {
        script(&format!("{SHORT}library = {name:?}\n")).open_library(folder)
    };
    let folder = tempfile::tempdir().unwrap();
    let shipped = PigmentLibrary::van_gogh_oils();
    assert_eq!(script(SHORT).open_library(folder.path()).unwrap(), None);
    assert_eq!(opened(&shipped.title, folder.path()).unwrap().as_ref(), Some(&shipped));
    let mut mine = shipped;
    mine.title = "mine".to_owned();
    std::fs::write(folder.path().join("mine.json"), mine.to_json()).unwrap();
    assert_eq!(opened("mine.json", folder.path()).unwrap(), Some(mine));
    let error = opened("none.json", folder.path()).unwrap_err().to_string();
    assert!(error.contains("none.json"), "{error}");
}

#[test]
fn ground_and_lamp_are_those_of_the_script() {
    let library = PigmentLibrary::van_gogh_oils();
    assert_eq!(script(SHORT).ground_under(&library), Ok(GroundKind::Panel.spec(1)));
    let text = |primer: &str| format!("{SHORT}[ground]\nkind = \"paper\"\n{primer}");
    let own = script(&text("reflectance = 0.123456789")).rounded();
    let wanted =
        GroundSpec { reflectance: Some(Primer::Grey(0.123457)), ..GroundKind::Paper.spec(1) };
    assert_eq!(own.ground_under(&library), Ok(wanted));
    let wrong = text("reflectance = { rgb = \"white\" }");
    let fault = script(&wrong).ground_under(&library).unwrap_err();
    let error = ScriptError::located("s.toml", &wrong, fault).to_string();
    assert!(error.starts_with("s.toml, line 5: ground takes a ground that can be made"), "{error}");
    let folder = Path::new("here");
    assert_eq!(script(SHORT).light(folder), None);
    assert_eq!(script(WHOLE).light(folder).as_deref(), Some("5600K"));
    let lamp = script(&format!("{SHORT}lamp = \"lamps.csv#bulb\"\n")).light(folder);
    assert_eq!(lamp, Some(folder.join("lamps.csv#bulb").display().to_string()));
}

#[test]
fn subjects_are_shapes_or_files_beside_the_script() {
    let folder = Path::new("here");
    assert_eq!(
        script(SHORT).subject_in(folder).unwrap(),
        Subject::Shape(graphics::mesh::SampleModel::Sphere)
    );
    let own = script(&SHORT.replace("shape:sphere", "models/jug.glb"));
    assert_eq!(own.subject_in(folder).unwrap(), Subject::File("here/models/jug.glb".into()));
}

#[test]
fn the_camera_is_that_of_the_verbs_or_a_path() {
    let own = script(WHOLE).camera.unwrap();
    let ScriptCamera::Path(path) = own.camera(145) else { panic!("{own:?}") };
    assert_eq!((path.frames, path.closed, path.keyframes.len()), (145, true, 2));
    assert_eq!(
        (path.keyframes[0].field_of_view_deg, path.keyframes[0].up),
        (35.0, [0.0, 1.0, 0.0])
    );
    let degrees = script(&format!("{SHORT}[camera]\nazimuth_deg = 75"));
    let ScriptCamera::Framing(framing) = degrees.camera.unwrap().camera(1) else { panic!() };
    let usual = graphics::camera::Framing::default();
    assert_eq!((framing.azimuth_deg, framing.elevation_deg), (75.0, usual.elevation_deg));
    let of_its_own = WHOLE.replace("[camera]\n", "[camera]\nframes = 7\n");
    let camera = script(&of_its_own).camera.unwrap();
    let ScriptCamera::Path(path) = camera.camera(145) else { panic!("{camera:?}") };
    assert_eq!(path.frames, 7);
    let turning = script(&format!("{SHORT}[camera]\nturntable = 48"));
    let written = script(&turning.to_text().unwrap());
    assert_eq!(written.camera.unwrap().turntable, Some(48));
}
