//! The worker of scenes, driven by commands as the window does.

use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex};
use web_time::{Duration, Instant};

use documents::Task;
use graphics::camera::{Camera, Framing};
use session::volumes::{
    Grip, Inside, Look, SceneImage, ScenePen, ScenePicture, SceneRecording, SceneState, Subject,
    VolumeCommand, VolumeEvent, VolumeWorker,
};
use volumes::script::Script;

const PATIENCE: Duration = Duration::from_secs(60);

const SIZE: [usize; 2] = [200, 150];

/// A worker and what it reported last.
struct Client {
    worker: VolumeWorker,
    woken: Receiver<()>,
    state: Option<Arc<SceneState>>,
    picture: Option<Arc<ScenePicture>>,
    recording: Option<Arc<SceneRecording>>,
    drawn: Option<Arc<SceneImage>>,
    problems: Vec<String>,
    pictures: usize,
}

impl Client {
    /// A worker that has opened `subject` and shows it to `camera`.
    fn open(subject: Subject) -> Self {
        let (wake, woken) = channel();
        let worker = VolumeWorker::start(move || wake.send(()).unwrap_or(()));
        let mut client = Self {
            worker,
            woken,
            state: None,
            picture: None,
            recording: None,
            drawn: None,
            problems: Vec::new(),
            pictures: 0,
        };
        client.ask(VolumeCommand::Open(subject));
        client.wait(|client| client.state.is_some() || !client.problems.is_empty());
        if client.state.is_some() {
            let camera = client.camera(0.0);
            client.ask(VolumeCommand::Size(SIZE));
            client.ask(VolumeCommand::Camera(camera));
            client.wait(|client| client.picture.is_some());
        }
        client
    }

    fn ask(&self, command: VolumeCommand) {
        self.worker.ask(command);
    }

    /// A camera that sees the whole scene, turned by some degrees.
    fn camera(&self, turned_deg: f32) -> Camera {
        let azimuth_deg = 30.0 + turned_deg;
        let framing = Framing { azimuth_deg, aspect: 4.0 / 3.0, ..Framing::default() };
        framing.camera(self.state.as_ref().unwrap().bounds)
    }

    fn receive(&mut self) {
        for event in self.worker.events() {
            match event {
                VolumeEvent::Opened(state) | VolumeEvent::State(state) => self.state = Some(state),
                VolumeEvent::Picture(picture) => {
                    self.pictures += 1;
                    self.picture = Some(picture);
                }
                VolumeEvent::Recording(_, recording) => self.recording = Some(recording),
                VolumeEvent::Drawn(_, picture) => self.drawn = Some(picture),
                VolumeEvent::Message { text, hint, failed: true } => {
                    self.problems.push(format!("{text}: {hint:?}"));
                }
                _ => {}
            }
        }
    }

    fn wait(&mut self, done: impl Fn(&Self) -> bool) {
        let start = Instant::now();
        while !done(self) {
            assert!(start.elapsed() < PATIENCE, "it does not come: {:?}", self.problems);
            let _ = self.woken.recv_timeout(Duration::from_millis(50));
            self.receive();
        }
    }

    fn state(&self) -> &SceneState {
        self.state.as_ref().unwrap()
    }

    /// Waits until time has run to this step.
    fn wait_until_step(&mut self, step: u64) {
        self.wait(|client| client.state().time.step >= step);
    }

    fn seek(&mut self, step: u64) {
        self.ask(VolumeCommand::Seek(step));
        self.wait(|client| {
            let time = client.state().time;
            time.step == step && !time.playing
        });
    }

    fn recording(&mut self) -> Arc<SceneRecording> {
        self.recording = None;
        self.ask(VolumeCommand::Recording(1));
        self.wait(|client| client.recording.is_some());
        self.recording.clone().unwrap()
    }

    /// Draws the present moment with all samples.
    fn draw(&mut self) -> Arc<SceneImage> {
        self.drawn = None;
        self.ask(VolumeCommand::Draw(1, SIZE));
        self.wait(|client| client.drawn.is_some());
        self.drawn.clone().unwrap()
    }

    fn press(&self, x: f32, y: f32) {
        let grip = Grip { rate_mm3_s: 150.0, tube: 5, ..Grip::default() };
        self.ask(VolumeCommand::PenDown(grip, ScenePen { at: [x, y], pressure: 1.0 }));
    }
}

fn village() -> Subject {
    Subject::Shape("village".to_owned())
}

fn colored(picture: &ScenePicture) -> usize {
    picture
        .pixels
        .iter()
        .filter(|[red, green, blue, _]: &&[u8; 4]| {
            red.max(green).max(blue) - red.min(green).min(blue) > 24
        })
        .count()
}

#[test]
fn colour_comes_where_the_pen_is_held_and_stays_when_time_stops() {
    let mut client = Client::open(village());
    assert_eq!(colored(client.picture.as_ref().unwrap()), 0, "the drawing is grey");
    client.press(0.5, 0.55);
    client.wait(|client| colored(client.picture.as_ref().unwrap()) > 30);
    client.ask(VolumeCommand::PenUp);
    client.wait_until_step(60);
    client.ask(VolumeCommand::Play(false));
    client.wait(|client| !client.state().time.playing);
    let state = client.state();
    assert_eq!(state.events.len(), 1, "{:?}", state.events);
    assert!(state.tally.poured_mm3 > 1.0 && state.tally.volumes > 0, "{:?}", state.tally);
    let spilled = state.tally.on_surfaces_mm3 + state.tally.lifted_mm3;
    assert!((state.tally.poured_mm3 - spilled).abs() < 1e-9, "{:?}", state.tally);
    let step = state.time.step;
    let pictures = client.pictures;
    std::thread::sleep(Duration::from_millis(300));
    client.receive();
    assert_eq!(client.state().time.step, step, "time stands");
    assert!(client.pictures <= pictures + 2, "at rest it is drawn once more, with all samples");
}

#[test]
fn a_moment_and_the_script_of_another_session_have_the_same_bytes() {
    let mut client = Client::open(village());
    client.press(0.45, 0.55);
    client.wait_until_step(20);
    client.ask(VolumeCommand::PenMove(ScenePen { at: [0.55, 0.6], pressure: 0.5 }));
    client.wait_until_step(50);
    client.ask(VolumeCommand::PenUp);
    client.wait_until_step(150);
    let last = client.state().time.end;
    client.seek(last);
    let end = client.draw();
    client.seek(30);
    assert_ne!(client.draw(), end, "paint spread since");
    client.seek(last);
    assert_eq!(client.draw(), end, "played again from a snapshot");
    let recording = client.recording();
    let folder = recording.folder.clone();
    let text = recording.text.to_string();
    let mut other = Client::open(Subject::Text { text, folder });
    other.ask(VolumeCommand::Camera(client.camera(0.0)));
    other.seek(last);
    assert_eq!(other.draw(), end, "played by another session");
    client.ask(VolumeCommand::Undo);
    client.wait(|client| client.state().events.is_empty());
    assert_ne!(client.draw(), end, "taken back");
    assert_eq!(client.state().time.step, last);
}

#[test]
fn turning_the_scene_while_paint_flows_changes_the_camera_alone() {
    let mut client = Client::open(village());
    client.press(0.5, 0.55);
    let first = client.picture.clone().unwrap();
    for turn in 1..=40_u8 {
        client.ask(VolumeCommand::Camera(client.camera(f32::from(turn))));
        client.wait_until_step(u64::from(turn));
        assert!(client.state().time.playing, "time runs on");
    }
    client.ask(VolumeCommand::PenUp);
    let recording = client.recording();
    let script = Script::from_text("recording", &recording.text).unwrap();
    assert!(script.pours.len() > 5, "{}", script.pours.len());
    let first_pour = &script.pours[0];
    assert!(script.pours.iter().all(|pour| pour.at == first_pour.at), "at one place");
    let gaps = script.pours.windows(2).map(|pair| pair[1].from_s - pair[0].from_s - 0.05);
    assert!(gaps.fold(0.0_f64, |most, gap| most.max(gap.abs())) < 2e-4, "without a pause");
    client.wait(|client| client.picture.as_ref() != Some(&first));
}

#[test]
fn what_cannot_be_opened_is_told_and_the_open_scene_stays() {
    let mut client = Client::open(Subject::Shape("vilage".to_owned()));
    assert!(client.problems[0].contains("village"), "{:?}", client.problems);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.glb");
    std::fs::write(&path, "no model").unwrap();
    client.ask(VolumeCommand::Open(village()));
    client.wait(|client| client.state.is_some());
    client.ask(VolumeCommand::Open(Subject::File(path)));
    client.wait(|client| client.problems.len() == 2);
    assert!(client.problems[1].contains("broken.glb"), "{:?}", client.problems);
    client.ask(VolumeCommand::StepOnce);
    client.wait_until_step(1);
    assert_eq!(client.state().title, "village");
}

#[test]
fn an_animation_is_written_whole_or_not_at_all() {
    let mut client = Client::open(Subject::Shape("sphere".to_owned()));
    client.press(0.5, 0.5);
    client.wait_until_step(24);
    client.ask(VolumeCommand::PenUp);
    client.seek(24);
    let recording = client.recording();
    let folder = tempfile::tempdir().unwrap();
    for (name, start) in [("a.gif", &b"GIF89a"[..]), ("b.png", &b"\x89PNG\r\n\x1a\n"[..])] {
        let path = folder.path().join(name);
        let shares = Arc::new(Mutex::new(Vec::new()));
        let heard = Arc::clone(&shares);
        let task = Task::observed(move |progress| {
            heard.lock().unwrap().extend(progress.share());
        });
        session::volumes::animation(&recording, [80, 60], &path, &task).unwrap();
        let shares = shares.lock().unwrap().clone();
        let bytes = std::fs::read(&path).unwrap();
        assert!(bytes.starts_with(start), "{name} has {} bytes", bytes.len());
        assert!(shares.len() > 4 && shares.is_sorted(), "{shares:?}");
        let given_up = folder.path().join(format!("none-{name}"));
        task.cancel();
        session::volumes::animation(&recording, [80, 60], &given_up, &task).unwrap();
        assert!(!given_up.exists(), "it was given up");
    }
}

#[test]
fn time_runs_on_and_pictures_come_while_paint_is_mixed() {
    let mut client = Client::open(village());
    client.press(0.5, 0.55);
    client.wait_until_step(12);
    let inside = Inside::Glaze;
    client.ask(VolumeCommand::Look(Look { inside, ..client.state().look }));
    client.wait(|client| client.state().prepares);
    let step = client.state().time.step;
    let pictures = client.pictures;
    // Slow work runs beside the scene, so we need not wait for it.
    client.wait(|client| client.pictures > pictures + 1 || !client.state().prepares);
    assert!(client.state().prepares, "a picture comes before the paint is mixed");
    client.wait(|client| client.state().time.step > step + 2);
    client.wait(|client| !client.state().prepares);
    client.ask(VolumeCommand::PenUp);
    let last = client.state().time.end;
    client.seek(last);
    let glaze = client.draw();
    client.wait(|client| {
        client.picture.as_ref().is_some_and(|shown| shown.fine && shown.step == last)
    });
    let shown = client.picture.clone().unwrap();
    let off = shown.pixels.iter().zip(glaze.pixels.values()).filter(|(pixel, linear)| {
        fn encoded(value: f32) -> f32 {
            match value {
                value if value <= 0.003_130_8 => 12.92 * value,
                value => 1.055 * value.powf(1.0 / 2.4) - 0.055,
            }
        }
        (0..3).any(|i| {
            pixel[i].abs_diff((encoded(linear[i]).clamp(0.0, 1.0) * 255.0).round() as u8) > 1
        })
    });
    assert_eq!(off.count(), 0, "the picture at rest is the one that is exported");
    client.ask(VolumeCommand::Look(Look { inside: Inside::OwnColours, ..client.state().look }));
    assert_ne!(client.draw(), glaze);
}
