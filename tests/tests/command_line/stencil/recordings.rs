//! Recordings of sessions of the studio that the verb plays again, animations that were
//! interrupted, and runs that fail before anything is written.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use glam::Vec3;
use graphics::camera::Camera;
use graphics::export::PictureFormat;
use paint::document::Document;
use serde_json::Value;
use session::volumes::{
    Grip, Inside, Look, SceneImage, SceneLight, ScenePen, SceneRecording, SceneState, SceneTool,
    Subject, VolumeCommand, VolumeEvent, VolumeWorker,
};
use suite::program::repository;
use tempfile::TempDir;
use volumes::script::Script;
use volumes::settings;

use super::{POUR, done, files, folder, path, stencil};

const PATIENCE: Duration = Duration::from_secs(120);

/// Size of the pictures in pixels.
const SIZE: [usize; 2] = [161, 113];

/// A session of the studio, with the state, recording, picture and painting that it reported last.
struct Session {
    worker: VolumeWorker,
    woken: Receiver<()>,
    state: Option<Arc<SceneState>>,
    recording: Option<Arc<SceneRecording>>,
    drawn: Option<Arc<SceneImage>>,
    painted: Option<Arc<Document>>,
}

impl Session {
    fn open(subject: Subject) -> Self {
        let (wake, woken) = channel();
        let worker = VolumeWorker::start(move || wake.send(()).unwrap_or(()));
        let state = None;
        let recording = None;
        let drawn = None;
        let painted = None;
        let mut session = Self { worker, woken, state, recording, drawn, painted };
        session.ask(VolumeCommand::Open(subject));
        session.wait(|session| session.state.is_some());
        session.ask(VolumeCommand::Size(SIZE));
        session
    }

    fn ask(&self, command: VolumeCommand) {
        self.worker.ask(command);
    }

    fn wait(&mut self, done: impl Fn(&Self) -> bool) {
        let start = Instant::now();
        while !done(self) {
            assert!(start.elapsed() < PATIENCE, "it does not come");
            let _ = self.woken.recv_timeout(Duration::from_millis(50));
            for event in self.worker.events() {
                match event {
                    VolumeEvent::Opened(state) | VolumeEvent::State(state) => {
                        self.state = Some(state);
                    }
                    VolumeEvent::Recording(_, recording) => self.recording = Some(recording),
                    VolumeEvent::Drawn(_, picture) => self.drawn = Some(picture),
                    VolumeEvent::Painted(_, document) => self.painted = Some(document),
                    VolumeEvent::Message { text, failed: true, .. } => panic!("{text}"),
                    _ => {}
                }
            }
        }
    }

    fn state(&self) -> &SceneState {
        self.state.as_ref().unwrap()
    }

    /// Turns the camera by some degrees as a hand does. Its numbers have more digits than a file
    /// stores.
    fn orbit(&self, turned_deg: f32) {
        let home = self.state().framed;
        let (sin, cos) = turned_deg.to_radians().sin_cos();
        let [x, y, z] = (home.eye - home.target).to_array();
        let turned = [cos * x + sin * z, 1.07 * y, cos * z - sin * x];
        let eye = home.target + 0.93 * Vec3::from(turned);
        self.ask(VolumeCommand::Camera(Camera { eye, near: 0.9 * home.near, ..home }));
    }

    /// Moves a tool over the picture for some steps, and lets go.
    fn gesture(&mut self, grip: Grip, from: [f32; 2], to: [f32; 2]) {
        let began = self.state().time.step;
        let pen = |share: f32, pressure: f32| {
            let at = [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share);
            ScenePen { at, pressure }
        };
        self.ask(VolumeCommand::PenDown(grip, pen(0.0, 0.731)));
        for (share, steps) in [(0.31, 8), (0.64, 16), (1.0, 24)] {
            self.ask(VolumeCommand::PenMove(pen(share, 0.5 + 0.5 * share)));
            self.wait(|session| session.state().time.step >= began + steps);
        }
        self.ask(VolumeCommand::PenUp);
        let events = self.state().events.len();
        self.wait(|session| session.state().time.step >= began + 36);
        assert!(events > 0, "{} has done something", grip.tool.name());
    }

    /// Stops time and goes to the end of the recording, which `impasto stencil` paints. Returns its step.
    fn seek_end(&mut self) -> u64 {
        self.ask(VolumeCommand::Play(false));
        self.wait(|session| !session.state().time.playing);
        let end = self.state().time.end;
        self.seek(end);
        end
    }

    fn seek(&mut self, step: u64) {
        self.ask(VolumeCommand::Seek(step));
        self.wait(|session| {
            let time = session.state().time;
            time.step == step && !time.playing
        });
    }

    /// The picture file that the studio exports now.
    fn exported(&mut self, format: PictureFormat) -> Vec<u8> {
        self.drawn = None;
        self.ask(VolumeCommand::Draw(1, SIZE));
        self.wait(|session| session.drawn.is_some());
        self.drawn.as_ref().unwrap().file(format).unwrap()
    }

    /// The painting file that the studio exports now.
    fn painting(&mut self) -> Vec<u8> {
        self.painted = None;
        self.ask(VolumeCommand::Paint(2, SIZE));
        self.wait(|session| session.painted.is_some());
        paint::file::write(self.painted.as_ref().unwrap()).unwrap()
    }

    fn save(&mut self, file: &str) {
        self.recording = None;
        self.ask(VolumeCommand::Recording(1));
        self.wait(|session| session.recording.is_some());
        self.recording.as_ref().unwrap().save(Path::new(file)).unwrap();
    }
}

/// A hand works on the village: it pours along two drags, blows, takes up and dries paint, pours
/// and undoes this, and turns the scene between all of them.
fn painted() -> Session {
    let mut session = Session::open(Subject::Shape("village".to_owned()));
    session.orbit(0.0);
    fn pour(tube: usize) -> Grip {
        Grip { tube, rate_mm3_s: 333.0, ..Grip::default() }
    }
    fn with(tool: SceneTool) -> Grip {
        Grip { tool, strength: 0.77, radius_mm: 31.7, ..Grip::default() }
    }
    session.gesture(pour(5), [0.45, 0.55], [0.55, 0.6]);
    session.orbit(12.34);
    session.gesture(pour(3), [0.5, 0.62], [0.41, 0.58]);
    session.gesture(with(SceneTool::Push), [0.42, 0.57], [0.58, 0.6]);
    session.orbit(-23.456);
    session.gesture(with(SceneTool::Lift), [0.5, 0.58], [0.53, 0.58]);
    session.gesture(with(SceneTool::Dry), [0.5, 0.58], [0.5, 0.58]);
    session.gesture(pour(1), [0.5, 0.58], [0.56, 0.62]);
    session.gesture(pour(4), [0.44, 0.6], [0.4, 0.62]);
    session.ask(VolumeCommand::Undo);
    session.wait(|session| session.state().events.len() == 6);
    session.orbit(7.891_234);
    session
}

/// The picture that the verb makes from a recording, with more options.
fn replayed(recording: &str, picture: &str, options: &[&str]) -> Vec<u8> {
    let [width, height] = SIZE.map(|side| side.to_string());
    let size = ["--width", &width, "--height", &height, "--backend", "cpu"];
    done(&[&[recording, "--picture", picture], &size[..], options].concat());
    fs::read(picture).unwrap()
}

#[test]
fn a_recording_of_the_studio_replayed_by_the_verb_has_the_same_bytes() {
    let folder = TempDir::new().unwrap();
    let [recording, picture, exact] = ["r.toml", "p.png", "p.exr"].map(|name| path(&folder, name));
    let mut session = painted();
    let light = SceneLight { azimuth_deg: 123.456_789_1, elevation_deg: 34.567_891 };
    let look = Look { light, ..session.state().look };
    session.ask(VolumeCommand::Look(look));
    let end = session.seek_end();
    session.save(&recording);
    let shown = session.exported(PictureFormat::Png8);
    assert!(shown == replayed(&recording, &picture, &[]), "at the end");
    let shown = session.exported(PictureFormat::LinearExr);
    assert!(shown == replayed(&recording, &exact, &[]), "at the end, all bits");
    // Go back to a moment when the sponge works.
    session.seek(117);
    let before = session.exported(PictureFormat::LinearExr);
    assert!(before != shown && end > 200, "the moment is another");
    assert!(before == replayed(&recording, &exact, &["--at", "0.975"]), "at 0.975 s");
    // Open it again and play it to this moment.
    let mut again = Session::open(Subject::Script(recording.clone().into()));
    let camera = again.state().seen_from.unwrap();
    again.ask(VolumeCommand::Camera(camera));
    again.seek(117);
    assert!(again.exported(PictureFormat::LinearExr) == before, "opened again");
    // Without strokes, and with glazes of the pigments that the recording names.
    let look = Look { hatching: false, inside: Inside::Glaze, ..session.state().look };
    session.ask(VolumeCommand::Look(look));
    session.seek(end);
    session.save(&recording);
    let by_day = session.exported(PictureFormat::LinearExr);
    let painting = path(&folder, "painting.exr");
    let by_verb = replayed(&recording, &exact, &["--output", &painting]);
    assert!(by_day == by_verb, "in pigments");
    assert!(session.painting() == fs::read(&painting).unwrap(), "the painting");
    // Other pigments from the painter's own library, by lamplight.
    let library = path(&folder, "mine.pigments.json");
    fs::copy(repository("measurements/van-gogh-oils.pigments.json"), &library).unwrap();
    session.ask(VolumeCommand::Library(library.into()));
    session.ask(VolumeCommand::Tube(5, "Viridian".to_owned()));
    session.ask(VolumeCommand::Illuminant("A".to_owned()));
    session.wait(|session| session.state().illuminant == "A");
    session.save(&recording);
    let by_lamp = session.exported(PictureFormat::LinearExr);
    assert!(by_lamp != by_day, "another green, another light");
    assert!(by_lamp == replayed(&recording, &exact, &[]), "other pigments by lamplight");
}

#[test]
fn a_recording_on_a_photograph_is_replayed_from_its_own_camera() {
    let folder = TempDir::new().unwrap();
    let [photo, recording, picture] =
        ["photo.png", "r.toml", "p.exr"].map(|name| path(&folder, name));
    image::RgbImage::from_fn(60, 40, |x: u32, y: u32| {
        image::Rgb([200, (3 * x) as u8, (5 * y) as u8])
    })
    .save(&photo)
    .unwrap();
    let mut session = Session::open(Subject::File(photo.into()));
    session.orbit(9.87);
    let pour = Grip { tube: 2, rate_mm3_s: 222.0, ..Grip::default() };
    session.gesture(pour, [0.4, 0.5], [0.6, 0.55]);
    session.seek_end();
    session.save(&recording);
    let shown = session.exported(PictureFormat::LinearExr);
    assert!(shown == replayed(&recording, &picture, &[]), "the same bytes");
    session.orbit(-9.0);
    assert!(shown != session.exported(PictureFormat::LinearExr), "it is seen from its camera");
}

/// A script of two regions: one shows a glaze, the other its own colours.
const REGIONS: &str = r#"format = "paint-volumes"
version = 1
subject = "shape:still-life"
seconds = 1.0

[palette]
A = "Ultramarine"
B = "Vermilion"

[[region]]
name = "left"
inside = "glaze"

[[region]]
name = "right"

[[pour]]
picked = [0.4, 0.55]
for_s = 0.5
amount_mm3 = 40
recipe = { A = 1 }
region = "left"

[[pour]]
picked = [0.62, 0.6]
for_s = 0.5
amount_mm3 = 40
recipe = { B = 1 }
region = "right"
"#;

#[test]
fn regions_that_differ_are_shown_and_saved_as_the_verb_draws_them() {
    let folder = TempDir::new().unwrap();
    let [script, saved, exact] = ["s.toml", "saved.toml", "p.exr"].map(|name| path(&folder, name));
    let library = path(&folder, "mine.pigments.json");
    fs::copy(repository("measurements/van-gogh-oils.pigments.json"), library).unwrap();
    let named = REGIONS.replace("seconds", "library = \"mine.pigments.json\"\nseconds");
    fs::write(&script, named).unwrap();
    let mut session = Session::open(Subject::Script(script.into()));
    let opened = session.state().look;
    assert!(opened.inside == Inside::ByRegion && session.state().by_region, "{opened:?}");
    session.orbit(0.0);
    let end = session.seek_end();
    let light = SceneLight { azimuth_deg: 20.0, elevation_deg: 50.0 };
    session.ask(VolumeCommand::Look(Look { light, ..opened }));
    session.save(&saved);
    let each = session.exported(PictureFormat::LinearExr);
    assert!(each == replayed(&saved, &exact, &[]), "each region as the script says");
    let read = Script::open(Path::new(&saved)).unwrap();
    let insides: Vec<_> = read.regions.iter().map(|region| region.inside).collect();
    assert_eq!(insides, [Some(settings::Inside::Glaze), None]);
    // One choice for all makes another picture, and you can go back to the choice of the regions.
    session.ask(VolumeCommand::Look(Look { light, inside: Inside::Glaze, ..opened }));
    session.seek(end);
    assert!(session.exported(PictureFormat::LinearExr) != each, "all of them glazes");
    session.ask(VolumeCommand::Look(Look { light, ..opened }));
    assert!(session.exported(PictureFormat::LinearExr) == each, "as it was");
}

/// Two steps of the world per frame, 157 frames.
const LONG: [&str; 10] = [
    "--width",
    "16",
    "--seconds",
    "2.6",
    "--rate",
    "60",
    "--set",
    "grid.cell=0.2",
    "--set",
    "picture.samples=1",
];

/// A folder with the manifest of `whole`. Frame `number` cannot be written there.
fn blocked(whole: &str, folder: &str, number: usize) {
    fs::create_dir_all(folder).unwrap();
    fs::copy(Path::new(whole).join("animation.json"), Path::new(folder).join("animation.json"))
        .unwrap();
    fs::create_dir(obstacle(folder, number)).unwrap();
}

fn obstacle(folder: &str, number: usize) -> std::path::PathBuf {
    Path::new(folder).join(format!("frame-{number:04}.png"))
}

fn copied(from: &str, to: &str) {
    fs::create_dir(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), Path::new(to).join(entry.file_name())).unwrap();
    }
}

#[track_caller]
fn same_frames(whole: &str, other: &str) {
    let names = files(whole, ".png");
    assert_eq!((names.len(), &names), (157, &files(other, ".png")), "all frames, in both folders");
    for name in &names {
        let [first, second] =
            [whole, other].map(|folder| fs::read(Path::new(folder).join(name)).unwrap());
        assert!(first == second, "{other}: {name}");
    }
    assert_eq!(files(other, ".world"), [""; 0], "an animation that is complete needs none");
}

#[test]
fn a_run_that_was_cut_goes_on_from_its_snapshot_to_the_same_bytes() {
    let temporary = folder();
    let [model, whole, cut] = ["box.obj", "whole", "cut"].map(|name| path(&temporary, name));
    let [near, far, none] = ["near", "far", "none"].map(|name| path(&temporary, name));
    let scene = [&[&model[..]], &LONG[..], &POUR, &["--json", "--frames"]].concat();
    let rerun = |folder: &str| {
        let run = done(&[&scene[..], &[folder]].concat());
        let json = run.json();
        (["frames_found", "from_seconds", "steps_computed"].map(|key| json[key].clone()), run.err)
    };
    fn numbers(found: u64, from: Option<f64>, steps: u64) -> [Value; 3] {
        [found.into(), from.map_or(Value::Null, Value::from), steps.into()]
    }
    // Everything is played twice: before the first frame is painted, and for the frames.
    assert_eq!(rerun(&whole).0, numbers(0, None, 2 * 312));
    blocked(&whole, &cut, 121);
    let run = stencil(&[&scene[..], &[&cut]].concat());
    assert!(run.status == 2 && run.err.contains("frame-0121.png"), "{}", run.err);
    fs::remove_dir(obstacle(&cut, 121)).unwrap();
    assert_eq!(files(&cut, ".png").len(), 120);
    assert_eq!(files(&cut, ".world"), ["frame-0051.world", "frame-0101.world"]);
    [&near, &far, &none].iter().for_each(|folder| copied(&cut, folder));

    let (found, err) = rerun(&near);
    assert_eq!(found, numbers(120, Some(200.0 / 120.0), 2 * 112), "nothing before frame 101");
    assert!(!err.contains("snapshot"), "{err}");
    same_frames(&whole, &near);

    let newest = Path::new(&far).join("frame-0101.world");
    let mut bytes = fs::read(&newest).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&newest, bytes).unwrap();
    let (found, err) = rerun(&far);
    assert_eq!(found, numbers(120, Some(100.0 / 120.0), 2 * 212));
    let words = ["frame-0101.world: cut short or damaged", "from the snapshot after 0.83 s"];
    assert!(words.iter().all(|words| err.contains(words)), "{err}");
    same_frames(&whole, &far);

    // Both are useless, and the run is cut once more. Then the newest two are there.
    let shortened = fs::read(Path::new(&none).join("frame-0051.world")).unwrap();
    fs::write(Path::new(&none).join("frame-0051.world"), &shortened[..100]).unwrap();
    fs::write(Path::new(&none).join("frame-0101.world"), "no world at all").unwrap();
    fs::create_dir(obstacle(&none, 155)).unwrap();
    let run = stencil(&[&scene[..], &[&none]].concat());
    let words = ["frame-0051.world: cut", "frame-0101.world: not a saved", "from the beginning"];
    assert!(words.iter().all(|words| run.err.contains(words)), "{}", run.err);
    assert_eq!(files(&none, ".world"), ["frame-0101.world", "frame-0151.world"]);
    fs::remove_dir(obstacle(&none, 155)).unwrap();
    assert_eq!(rerun(&none).0, numbers(154, Some(300.0 / 120.0), 2 * 12));
    same_frames(&whole, &none);

    // Snapshots of another animation are reported, and removed with its frames.
    let other = ["--seconds", "0.1", "--json", "--frames", &cut];
    let short: Vec<&str> =
        LONG.into_iter().filter(|own| !["--seconds", "2.6"].contains(own)).collect();
    let run = done(&[&[&model[..]], &short[..], &POUR, &other].concat());
    assert!(run.err.contains("frame-0101.world: saved for another scene"), "{}", run.err);
    assert_eq!(run.json()["from_seconds"], Value::Null);
    assert_eq!((files(&cut, ".png").len(), files(&cut, ".world").len()), (7, 0));
}

#[test]
fn a_script_that_cannot_be_played_leaves_nothing_behind() {
    let folder = folder();
    let script = path(&folder, "s.toml");
    let text = "format = \"paint-volumes\"\nversion = 1\nsubject = \"box.obj\"\nseconds = 0.5\n\
        grid.cell = 0.2\npalette.V = \"Viridian\"\n[[volume]]\ncentre = [0.0, 1.0, 0.0]\n\
        radius = 0.2\nfrom_s = 0.4\nrecipe = { V = 1 }\n[[split]]\nat_s = 0.1\nvolume = 1\n";
    fs::write(&script, text).unwrap();
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let names = ["stages", "volumes", "maps", "frames", "p.png", "s2.toml"];
    let [stages, volumes, maps, frames, picture, second] = names.map(|name| path(&folder, name));
    let written = ["--stages", &stages, "--volumes", &volumes, "--pigment-maps", &maps];
    let more = ["--frames", &frames, "--picture", &picture, "--script-out", &second];
    let paint = ["--pigments", &library, "--width", "64"];
    let run = stencil(&[&[&script[..]], &written[..], &more, &paint].concat());
    assert!(run.status == 1 && run.err.contains("volume 1 is not there"), "{}", run.err);
    let left = names.into_iter().filter(|name| Path::new(&path(&folder, name)).exists());
    assert_eq!(left.collect::<Vec<_>>(), [""; 0]);
    // If the volume is there in time, all of them are made.
    fs::write(&script, text.replace("from_s = 0.4", "from_s = 0.0")).unwrap();
    done(&[&[&script[..]], &written[..], &more, &paint].concat());
    let made = names.into_iter().filter(|name| Path::new(&path(&folder, name)).exists());
    assert_eq!(made.collect::<Vec<_>>(), names);
    // Folders that cannot be made are reported at once.
    let inside = path(&folder, "box.obj/inside");
    for option in ["--stages", "--volumes", "--pigment-maps", "--frames"] {
        let run = stencil(&[&[&script[..]], &paint[..], &[option, &inside]].concat());
        let is_reported = run.err.contains("inside: this folder cannot be created");
        assert!(
            run.status == 2 && is_reported && run.err.contains("hint: name another"),
            "{option}: {}",
            run.err
        );
    }
}
