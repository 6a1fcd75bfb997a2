//! Scripts: reading, writing, events, recording, pigments, limits. We raise every fault of a
//! script once, and check its place and its hint. Random changes of scripts must not panic, and
//! every fault must have a place and a hint.

use std::path::Path;

use documents::hint::Explain;
use paint::ground::{GroundKind, GroundSpec, Primer};
use pigment::PigmentLibrary;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::{MOST_EVENTS, Script, *};
use crate::drawing::MOST_REGIONS;
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
    let recorded: Vec<_> =
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
    assert_eq!(recorded, wanted.map(|(start, end, table)| (start, end, table.to_owned())));
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
    let [played, events] = [played, events].map(|events: Vec<Event>| {
        events.into_iter().map(|event| (event.start, event.end, event.action)).collect::<Vec<_>>()
    });
    assert_eq!(played, events);
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
    fn text(y: &str) -> String {
        format!("{SHORT}[palette]\nB = \"Cobalt Blue\"\nY = \"{y}\"\n")
    }
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
        let advice = Explain::hint(&error).unwrap().to_string();
        assert!(advice.starts_with(hint), "{advice}");
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
    fn text(primer: &str) -> String {
        format!("{SHORT}[ground]\nkind = \"paper\"\n{primer}")
    }
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

/// A script with every table and nearly every key.
pub(super) const WHOLE: &str = r##"format = "paint-volumes"
version = 1
title = "A jug wakes up"
subject = "shape:still-life"
unit_mm = 100.0
seconds = 6.0
preset = "washed"
library = "oils/mine.pigments.json"
illuminant = "5600K"

[palette]
B = "Ultramarine"
Y = "Chrome Yellow"

[ground]
kind = "linen"
seed = 3
threads_per_cm = 12.5
relief_mm = 0.1

[ground.reflectance.spectrum]
values = [0.7, 0.8, 0.85]

[ground.reflectance.spectrum.grid]
start_nm = 400.0
step_nm = 150.0
count = 3

[grid]
cell = 0.083

[settings.motion]
kick = 0.5

[settings.drawing]
tint = []

[camera]
closed = true

[[camera.keyframe]]
eye = [4.0, 2.0, 6.0]
target = [0.0, 1.0, 0.0]

[[camera.keyframe]]
eye = [6.0, 3.0, 2.0]
target = [0.0, 1.0, 0.0]
up = [0.0, 1.0, 0.0]
field_of_view_deg = 30.0

[[region]]
name = "sky"

[[region]]
name = "glow"
inside = "own-colours"
shells = [1.0, 0.93, 0.86]
tint = [0.0, 0.35, 0.7, 1.0]
stain = "#e8d8b8"

[[keep]]
box = [[-1.0, -1.0, -1.0], [1.0, 2.0, 1.0]]

[[keep]]
sphere = [[0.0, 0.5, 0.0], 2.0]

[[keep]]
above = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]

[[volume]]
centre = [0.1, 0.6, 0.3]
radius = 0.2
detail = 4
recipe = { B = 1.0 }

[[pour]]
path = [[0.0, 0.1, 0.6, 0.3], [2.0, 0.5, 0.6, 0.2]]
from_s = 0.5
for_s = 2.0
rate_mm3_s = 40.0
region = "glow"
recipe = { B = 2.0, Y = 1.0 }

[[pour]]
picked = [0.42, 0.55]
from_s = 0.25
amount_mm3 = 5.0
recipe = { Y = 1.0 }

[[push]]
at = [0.1, 0.6, 0.3]
towards = [1.0, 0.0, 0.0]
radius = 0.2
strength = 10.0
from_s = 3.0
for_s = 0.5

[[lift]]
at = [0.1, 0.6, 0.3]
radius = 0.1
from_s = 4.0
for_s = 0.5
rate = 0.75

[[split]]
at_s = 4.5
volume = 1

[[dry]]
at_s = 5.0

[[dry]]
at_s = 5.5
at = [0.1, 0.6, 0.3]
radius = 0.25
"##;

pub(super) const SHORT: &str =
    "format = \"paint-volumes\"\nversion = 1\nsubject = \"shape:sphere\"\nseconds = 1\n";

/// The example in the description of the format, to the letter.
pub(super) const DESCRIBED: &str = r#"format = "paint-volumes"
version = 1
title = "A jug wakes up"
subject = "shape:still-life"      # or a model, or a photograph, beside this file
unit_mm = 100.0
seconds = 6.0
[palette]                         # with pigments; without it colours are the subject's own
B = "Ultramarine"
Y = "Chrome Yellow"
[grid]
cell = 0.083                      # of the longest side; 0 is single volumes only
[[pour]]                          # `at` a place of the model
at = [0.1, 0.6, 0.3]
from_s = 0.5
for_s = 2.0
rate_mm3_s = 40.0
recipe = { B = 2, Y = 1 }
path = [[0.0, 0.1, 0.6, 0.3], [2.0, 0.5, 0.6, 0.2]]   # seconds, then place: a moving source
"#;

fn fault(text: &str) -> [String; 2] {
    let error = Script::from_text("s.toml", text).unwrap_err();
    [error.to_string(), error.hint().unwrap().to_string()]
}

/// Asserts that the error of `text` begins with `wanted`, and its hint with `hint`.
fn assert_fault(text: &str, wanted: &str, hint: &str) {
    let [error, advice] = fault(text);
    assert!(error.starts_with(wanted), "{text}\n{error}\nnot {wanted}");
    assert!(advice.starts_with(hint), "{text}\n{error}\n{advice}\nnot {hint}");
}

#[test]
fn faults_of_the_header() {
    for (from, to, wanted, hint) in [
        (
            "paint-volumes",
            "strokes",
            "s.toml, line 1: format takes \"paint-volumes\", found `\"strokes\"`",
            "a script begins",
        ),
        (
            "format = \"paint-volumes\"",
            "",
            "s.toml, line 1: format takes \"paint-volumes\", found `nothing`",
            "a script begins",
        ),
        (
            "version = 1",
            "version = 2\nnew = 1",
            "s.toml, line 2: version takes 1 to 1, found `2`",
            "a newer impasto",
        ),
        (
            "version = 1",
            "version = \"1\"",
            "s.toml, line 2: version takes 1 to 1, found `\"1\"`",
            "a newer impasto",
        ),
        ("version = 1", "", "s.toml, line 1: the key `version` is missing", "add a line `version`"),
        (
            "subject = \"shape:sphere\"",
            "",
            "s.toml, line 1: the key `subject` is missing",
            "add a line `subject`",
        ),
        (
            "shape:sphere",
            "shape:spere",
            "s.toml, line 3: subject takes the name of a shape after `shape:`, found `spere`",
            "did you mean shape:sphere?",
        ),
        (
            "shape:sphere",
            "shape:cow",
            "s.toml, line 3: subject takes the name of a shape",
            "shapes are still-life, village",
        ),
        (
            "shape:sphere",
            "other.toml",
            "s.toml, line 3: subject takes a model or a photograph, found `other.toml`",
            "name the model or photograph that the other script paints",
        ),
        (
            "shape:sphere",
            "",
            "s.toml, line 3: subject takes a path of 1 to 1024 bytes",
            "subject = ",
        ),
        (
            "shape:sphere",
            "/etc/jug.glb",
            "s.toml, line 3: subject takes a path below the script's folder, found `/etc/jug.glb`",
            "put the file beside",
        ),
        (
            "shape:sphere",
            "../jug.glb",
            "s.toml, line 3: subject takes a path below the script's folder",
            "put the file beside",
        ),
        (
            "shape:sphere",
            "a/../../jug.glb",
            "s.toml, line 3: subject takes a path below",
            "put the file beside",
        ),
        (
            "shape:sphere",
            "C:jug.glb",
            "s.toml, line 3: subject takes a path below",
            "put the file beside",
        ),
        (
            "shape:sphere",
            "a\\\\jug.glb",
            "s.toml, line 3: subject takes a path below",
            "put the file beside",
        ),
        (
            "seconds = 1",
            "seconds = -1",
            "s.toml, line 4: seconds takes 0 to 3600, found `-1`",
            "the least is 0",
        ),
        (
            "seconds = 1",
            "seconds = 4000",
            "s.toml, line 4: seconds takes 0 to 3600, found `4000`",
            "the most is 3600",
        ),
        (
            "seconds = 1",
            "seconds = nan",
            "s.toml, line 4: seconds takes 0 to 3600, found `NaN`",
            "write a number",
        ),
        (
            "seconds = 1",
            "seconds = \"one\"",
            "s.toml, line 4: seconds: invalid type: text \"one\", expected a number",
            "write a value",
        ),
        (
            "seconds = 1",
            "second = 1",
            "s.toml, line 4: second: unknown key `second`",
            "did you mean seconds?",
        ),
        (
            "seconds = 1",
            "seconds = 1\nseconds = 2",
            "s.toml, line 5: duplicate key",
            "a line of TOML",
        ),
        ("seconds = 1", "seconds = ", "s.toml, line 4: ", "a line of TOML"),
        (
            "seconds = 1",
            "seconds = 1\nunit_mm = 0",
            "s.toml, line 5: unit_mm takes a number above 0, up to 1000000, found `0`",
            "write a number above 0",
        ),
        (
            "seconds = 1",
            "seconds = 1\npreset = \"washd\"",
            "s.toml, line 5: preset: unknown word `washd`",
            "did you mean washed?",
        ),
    ] {
        assert!(SHORT.contains(from), "{from}");
        assert_fault(&SHORT.replace(from, to), wanted, hint);
    }
}

/// Runs every case of `faults.txt`. A case has lines after the shortest script, then the error
/// after `! ` and the hint after `? `, as far as we compare them.
#[test]
fn every_fault_names_its_place_and_the_way_out() {
    let cases: Vec<&str> = include_str!("faults.txt").split("\n\n").collect();
    assert!(cases.len() > 60, "{}", cases.len());
    for case in cases {
        let (text, rest) = case.split_once("\n! ").unwrap();
        let (wanted, hint) = rest.split_once("\n? ").unwrap();
        assert_fault(&format!("{SHORT}{text}"), &format!("s.toml, {wanted}"), hint.trim_end());
    }
}

#[test]
fn limits_say_what_fits() {
    fn many(text: &str, count: usize) -> String {
        format!("{SHORT}{}", text.repeat(count))
    }
    let volume = "[[volume]]\ncentre = [0, 0, 0]\nradius = 1\ndetail = 1\n";
    let regions: String =
        (0..=MOST_REGIONS).map(|index| format!("[[region]]\nname = \"r{index}\"\n")).collect();
    for (text, wanted, hint) in [
        (
            many(volume, 4097),
            "s.toml, line 16389: [[volume]] 4097 takes at most 4096 tables, found `4097`",
            "the first 4096 fit",
        ),
        (
            many(&volume.replace("= 1\n", "= 5\n"), 200),
            "s.toml, line 788: [[volume]] 196, detail takes at most 2000000 particles in all volumes, found `5: 2007432 so far`",
            "detail = 4 fits for all 200",
        ),
        (
            many("[[dry]]\nat_s = 1\n", MOST_EVENTS + 1),
            "s.toml, line 20005: [[dry]] 10001 takes at most 10000 tables",
            "the first 10000 fit",
        ),
        (
            format!("{SHORT}{regions}"),
            "s.toml, line 133: [[region]] 65 takes at most 64 tables, found `65`",
            "the first 64 fit",
        ),
        (format!("{SHORT}#{}", "x".repeat(16 << 20)), "s.toml: it has 16777", "divide it"),
    ] {
        let [error, advice] = fault(&text);
        assert!(error.starts_with(wanted), "{error}\nnot {wanted}");
        assert!(advice.starts_with(hint), "{advice}\nnot {hint}");
    }
    assert!(Script::from_text("s.toml", &many(volume, 4096)).is_ok());
}

#[test]
fn files_that_are_missing_or_no_text_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("none.toml");
    let error = Script::open(&missing).unwrap_err().to_string();
    assert!(error.contains("none.toml"), "{error}");
    let bytes = folder.path().join("bytes.toml");
    std::fs::write(&bytes, b"a = 1\nb = \"\xff\"").unwrap();
    let error = Script::open(&bytes).unwrap_err().to_string();
    assert!(
        error.ends_with("bytes.toml, line 2: this is not UTF-8 text, found byte `0xff`"),
        "{error}"
    );
}

#[test]
fn a_script_in_memory_is_checked_before_it_is_written() {
    let mut own = Script::from_text("s.toml", WHOLE).unwrap();
    own.pushes[0].strength = f64::INFINITY;
    let error = own.to_text().unwrap_err();
    assert_eq!(error.to_string(), "[[push]] 1, strength takes 0 to 1000000, found `inf`");
}

/// The random changes insert these pieces into scripts.
const PIECES: [&str; 32] = [
    "=",
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    "\"",
    "'''",
    "\"\"\"",
    "#",
    "\n",
    ".",
    ",",
    "-",
    "nan",
    "inf",
    "1e400",
    "-0.0",
    "0x7f",
    "99999999999999999999",
    "1979-05-27T07:32:00Z",
    "true",
    "\u{e9}",
    "\u{feff}",
    "\0",
    "\r",
    "pour",
    "[[pour]]",
    "settings",
    "9e8",
    " = 1\n",
];

/// One of the sample scripts with one to eight random changes.
fn changed(random: &mut ChaCha8Rng) -> String {
    let text = [WHOLE, SHORT, DESCRIBED][random.random_range(0..3)];
    let mut letters: Vec<char> = text.chars().collect();
    for _ in 0..random.random_range(1..=8) {
        let at = random.random_range(0..=letters.len());
        let to = (at + random.random_range(0..12)).min(letters.len());
        match random.random_range(0..5) {
            0 => {
                letters.drain(at..to);
            }
            1 => {
                let piece = PIECES[random.random_range(0..PIECES.len())];
                letters.splice(at..at, piece.chars());
            }
            2 => {
                let copy: Vec<char> = letters[at..to].to_vec();
                let there = random.random_range(0..=letters.len());
                letters.splice(there..there, copy);
            }
            3 if at < letters.len() => {
                letters[at] = char::from(random.random_range(32..127_u8));
            }
            _ => {
                // A digit changes, so that values leave their ranges.
                let digits: Vec<usize> =
                    (0..letters.len()).filter(|&at| letters[at].is_ascii_digit()).collect();
                if let Some(&at) = digits.get(random.random_range(0..digits.len().max(1))) {
                    let number = PIECES[random.random_range(15..21)];
                    letters.splice(at..=at, number.chars());
                }
            }
        }
    }
    letters.into_iter().collect()
}

fn read(seed: u64, count: usize) -> usize {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let good = (0..count).filter(|_| {
        let text = changed(&mut random);
        match Script::from_text("s.toml", &text) {
            Ok(script) => {
                let written = script.to_text().unwrap();
                let again = Script::from_text("s.toml", &written).unwrap();
                assert_eq!(again, script.rounded(), "{text}");
                assert!(script.events().windows(2).all(|pair| pair[0].start <= pair[1].start));
                true
            }
            Err(error) => {
                let message = error.to_string();
                assert!(
                    message.starts_with("s.toml, line ") && message.len() < 4000,
                    "{text}\n{message}"
                );
                assert!(error.hint().is_some(), "{text}\n{message}");
                false
            }
        }
    });
    good.count()
}

#[test]
fn changed_scripts_are_read_or_refused() {
    let good = read(1, 2000);
    assert!((20..1900).contains(&good), "{good} of 2000 were good");
}

#[test]
#[ignore = "reads a million scripts, which takes minutes"]
fn a_million_changed_scripts_are_read_or_refused() {
    let good: usize = (0..1000).into_par_iter().map(|seed| read(seed + 2, 1000)).sum();
    println!("{good} of 1,000,000 were good");
    assert!(good > 10_000, "{good}");
}
