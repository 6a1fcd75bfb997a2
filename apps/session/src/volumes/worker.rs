//! The worker of scenes, and the loop of its thread: it carries out commands, lets time run and
//! draws. While a scene moves, it draws smaller pictures so that they come in time.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration as PictureShareDuration;

use documents::hint::Hint;
use graphics::camera::Camera;
use web_time::{Duration, Instant};

use super::command::VolumeCommand;
use super::event::{ScenePicture, SceneState, SceneTime, VolumeEvent};
use super::inbox::{Inbox, Input};
use super::painters::{Quality, Sight};
use super::scene::Scene;
use super::timeline::{Pacer, STEPS_A_SECOND};
use crate::failure::FileFailure;
use crate::thread::{Awaited, Wait, Works};

/// Most pictures that may be sent without being confirmed.
const MOST_UNCONFIRMED: usize = 2;

/// Time for steps between two pictures. Further steps that are due are skipped.
const STEPS_TIME: Duration = Duration::from_millis(25);

/// Time for steps between two pictures while we play towards another moment.
const SEEK_TIME: Duration = Duration::from_millis(60);

/// A picture with all samples is drawn this long after the last change.
const REST: Duration = Duration::from_millis(160);

/// How often we check whether the painter that another thread makes is ready.
const MIXING: Duration = Duration::from_millis(20);

/// Steps after which time stops if nobody does anything: 10 s. The paint rests by then.
const RUN_ON: u64 = 10 * STEPS_A_SECOND;

const STATE_INTERVAL: Duration = Duration::from_millis(50);

/// State of the thread of a scene.
pub(super) struct SceneLoop<'a> {
    send: Box<dyn Fn(VolumeEvent) + 'a>,
    inbox: Inbox,
    scene: Option<Scene>,
    camera: Option<Camera>,
    size: [usize; 2],
    playing: bool,
    /// Time stops by itself at this moment.
    stops_at: u64,
    pacer: Pacer,
    unconfirmed: usize,
    /// Whether the picture may have changed since it was last drawn.
    stale: bool,
    /// Time of the last change. It is `None` once the picture was drawn with all samples.
    moved: Option<Instant>,
    /// How many seconds a pixel of a moving scene took last.
    pixel_seconds: f64,
    state_stale: bool,
    state_due: Instant,
}

impl<'a> SceneLoop<'a> {
    pub(super) fn new(inbox: Inbox, send: impl Fn(VolumeEvent) + 'a) -> Self {
        Self {
            send: Box::new(send),
            inbox,
            scene: None,
            camera: None,
            size: [0; 2],
            playing: false,
            stops_at: u64::MAX,
            pacer: Pacer::default(),
            unconfirmed: 0,
            stale: false,
            moved: None,
            pixel_seconds: 0.0,
            state_stale: false,
            state_due: Instant::now(),
        }
    }

    pub(super) fn run(mut self) {
        loop {
            self.inbox.receive(self.wait_until());
            if self.inbox.quit {
                return;
            }
            self.step();
        }
    }

    /// Works until `deadline`, or until it must wait, and returns for how long. It finishes a step
    /// or a picture that has begun. Returns `None` after the command to quit.
    pub(super) fn turn(&mut self, deadline: Instant) -> Option<Wait> {
        loop {
            self.inbox.receive_all();
            if self.inbox.quit {
                return None;
            }
            self.step();
            let wait = Wait::until(self.wait_until());
            if wait != Wait::None || Instant::now() >= deadline {
                return Some(wait);
            }
        }
    }

    /// Carries out commands, takes the steps that are due, and draws.
    fn step(&mut self) {
        let confirmed = std::mem::take(&mut self.inbox.confirmed);
        self.unconfirmed = self.unconfirmed.saturating_sub(confirmed);
        while let Some(command) = self.inbox.next() {
            let done = self.carry_out(command);
            self.report(done);
        }
        let made = self.take_made();
        self.report(made);
        let advanced = self.advance();
        if advanced.is_err() {
            self.play(false);
        }
        self.report(advanced);
        let drawn = self.draw();
        self.report(drawn);
        self.send_state();
    }

    /// Until when the thread may wait for commands. `None` means without limit.
    fn wait_until(&self) -> Option<Instant> {
        let now = Instant::now();
        let may_draw = self.unconfirmed < MOST_UNCONFIRMED;
        let works = self.inbox.has_waiting()
            || self.stale && may_draw
            || self.scene.as_ref().is_some_and(Scene::is_behind);
        if works {
            return Some(now);
        }
        let rests = self.moved.map(|moved| moved + REST).filter(|_| may_draw);
        let state = self.state_stale.then_some(self.state_due);
        let makes = self.scene.as_ref().is_some_and(|scene| scene.painters.is_making());
        let made = makes.then(|| now + MIXING);
        [self.pacer.next(), rests, state, made].into_iter().flatten().min()
    }

    fn report(&mut self, result: Result<(), FileFailure>) {
        if let Err(FileFailure { what, hint }) = result {
            (self.send)(VolumeEvent::Message { text: what, hint, failed: true });
        }
    }

    /// Notes that the picture may have changed.
    fn changed(&mut self) {
        self.stale = true;
        self.moved = Some(Instant::now());
    }

    fn sight(&self) -> Option<Sight> {
        let camera = self.camera?;
        (self.size.iter().all(|&side| side > 0)).then_some(Sight { camera, size: self.size })
    }

    fn carry_out(&mut self, command: VolumeCommand) -> Result<(), FileFailure> {
        self.state_stale = true;
        match command {
            VolumeCommand::Open(subject) => {
                let scene = Scene::open(&subject)?;
                self.playing = false;
                self.pacer.stop();
                self.camera = None;
                self.scene = Some(scene);
                let state = self.state();
                state.into_iter().for_each(|state| (self.send)(VolumeEvent::Opened(state)));
                return Ok(());
            }
            VolumeCommand::Camera(camera) => {
                let scene = self.scene.as_ref();
                self.camera = Some(scene.map_or(camera, |scene| scene.recorded_camera(&camera)));
            }
            VolumeCommand::Size(size) => self.size = size,
            VolumeCommand::Look(look) => {
                if let Some(scene) = &mut self.scene {
                    scene.set_look(look);
                }
            }
            VolumeCommand::Play(playing) => self.play(playing),
            VolumeCommand::Quit => {}
            other => return self.carry_out_in_scene(other),
        }
        self.changed();
        Ok(())
    }

    /// Lets time run or stops it. Time runs to the end of the recording, and beyond it only while
    /// somebody does something.
    fn play(&mut self, playing: bool) {
        let Some(scene) = self.scene.as_ref().filter(|_| playing) else {
            self.playing = false;
            return self.pacer.stop();
        };
        let moment = scene.moment();
        let end = scene.end();
        self.stops_at = if moment < end { end } else { moment + RUN_ON };
        self.playing = true;
        self.pacer.start(Instant::now());
    }

    fn carry_out_in_scene(&mut self, command: VolumeCommand) -> Result<(), FileFailure> {
        let sight = self.sight();
        let Some(scene) = &mut self.scene else { return Ok(()) };
        match command {
            VolumeCommand::PenDown(grip, pen) => {
                let Some(sight) = sight else { return Ok(()) };
                if scene.pen_down(&sight, grip, pen)? {
                    self.play(true);
                    self.stops_at = u64::MAX;
                }
            }
            VolumeCommand::PenMove(pen) => {
                if let Some(sight) = sight {
                    scene.pen_move(&sight, pen);
                }
            }
            VolumeCommand::PenUp => {
                let worked = scene.is_at_work();
                scene.pen_up()?;
                if worked {
                    self.stops_at = scene.moment() + RUN_ON;
                }
            }
            VolumeCommand::Pick(at) => {
                let Some(sight) = sight else { return Ok(()) };
                let here = scene.here(&sight, at);
                (self.send)(VolumeEvent::Here(Box::new(here)));
                return Ok(());
            }
            VolumeCommand::StepOnce => {
                scene.step()?;
                self.play(false);
            }
            VolumeCommand::Seek(step) => {
                scene.go_to(step)?;
                self.play(false);
            }
            VolumeCommand::DryAll => scene.dry_all()?,
            VolumeCommand::Illuminant(light) => scene.set_illuminant(&light)?,
            VolumeCommand::Library(path) => scene.set_library(&path)?,
            VolumeCommand::Tube(number, pigment) => scene.set_tube(number, &pigment)?,
            VolumeCommand::Undo => scene.undo()?,
            VolumeCommand::Remove(event) => scene.remove(event)?,
            VolumeCommand::Draw(number, size) => {
                let Some(sight) = sight else { return Ok(()) };
                let picture = scene.image(&Sight { size, ..sight })?;
                (self.send)(VolumeEvent::Drawn(number, Arc::new(picture)));
                return Ok(());
            }
            VolumeCommand::Paint(number, size) => {
                let Some(sight) = sight else { return Ok(()) };
                let document = scene.painting(&Sight { size, ..sight })?;
                (self.send)(VolumeEvent::Painted(number, Arc::new(document)));
                return Ok(());
            }
            VolumeCommand::Recording(number) => {
                let recording = scene.recording(sight.map(|sight| sight.camera))?;
                (self.send)(VolumeEvent::Recording(number, Arc::new(recording)));
                return Ok(());
            }
            _ => {}
        }
        self.changed();
        Ok(())
    }

    /// Takes the painter that another thread makes, if it is ready. The next picture uses it.
    fn take_made(&mut self) -> Result<(), FileFailure> {
        let Some(scene) = &mut self.scene else { return Ok(()) };
        let before = scene.painters.is_making();
        let taken = scene.painters.take_made();
        if before && !scene.painters.is_making() {
            self.state_stale = true;
            self.changed();
        }
        taken.map(|_| ())
    }

    /// Takes as many of the steps that are due as there is time for.
    fn advance(&mut self) -> Result<(), FileFailure> {
        let Some(scene) = &mut self.scene else { return Ok(()) };
        let began = Instant::now();
        if scene.is_behind() {
            scene.catch_up(began + SEEK_TIME)?;
            self.pacer.forget(Instant::now());
            self.state_stale = true;
            if !scene.is_behind() {
                self.changed();
            }
            return Ok(());
        }
        let left = self.stops_at.saturating_sub(scene.moment());
        let due = self.pacer.due(began).min(left);
        let mut taken = 0;
        while taken < due && (taken == 0 || began.elapsed() < STEPS_TIME) {
            scene.step()?;
            taken += 1;
        }
        let now = Instant::now();
        let moment = scene.moment();
        if taken > 0 {
            self.pacer.took(taken, now);
            self.state_stale = true;
            self.changed();
        }
        if taken < due {
            self.pacer.forget(now);
        }
        if self.playing && moment >= self.stops_at {
            self.play(false);
        }
        Ok(())
    }

    /// Draws the picture if it changed. Draws it once more with all samples when it rests.
    fn draw(&mut self) -> Result<(), FileFailure> {
        let rests = self.moved.is_some_and(|moved| moved.elapsed() >= REST);
        if self.unconfirmed >= MOST_UNCONFIRMED || !(self.stale || rests) {
            return Ok(());
        }
        let Some(sight) = self.sight() else { return Ok(()) };
        let Some(scene) = self.scene.as_mut().filter(|scene| !scene.is_behind()) else {
            return Ok(());
        };
        let began = Instant::now();
        let moves = std::mem::take(&mut self.stale);
        let share = if moves { share_in_time(sight.size, self.pixel_seconds) } else { 1.0 };
        let size = sight.size.map(|side| ((side as f64 * share).round() as usize).max(1));
        if !moves {
            self.moved = None;
        }
        let quality = Quality { fine: !moves, share: share as f32, waits: false };
        let mixed = scene.painters.is_making();
        let pixels = scene.pixels(&Sight { size, ..sight }, quality)?;
        self.state_stale |= scene.painters.is_making() != mixed;
        let [width, height] = size;
        let step = scene.moment();
        let fine = !moves;
        let picture = ScenePicture { width, height, pixels, step, fine };
        (self.send)(VolumeEvent::Picture(Arc::new(picture)));
        self.unconfirmed += 1;
        if moves {
            self.pixel_seconds = began.elapsed().as_secs_f64() / (width * height) as f64;
        }
        Ok(())
    }

    fn send_state(&mut self) {
        let now = Instant::now();
        if !self.state_stale || now < self.state_due {
            return;
        }
        // The speed falls while nothing happens.
        self.state_stale = self.pacer.speed(now) > 0.0;
        self.state_due = now + STATE_INTERVAL;
        if let Some(state) = self.state() {
            (self.send)(VolumeEvent::State(state));
        }
    }

    fn state(&mut self) -> Option<Arc<SceneState>> {
        let scene = self.scene.as_ref()?;
        let time = SceneTime {
            step: scene.moment(),
            end: scene.end(),
            playing: self.playing,
            speed: if self.playing { self.pacer.speed(Instant::now()) } else { 0.0 },
        };
        Some(Arc::new(scene.state(time)))
    }
}

/// Handle of the worker that owns a scene. If you drop this, the thread ends, and the drop waits
/// for it for at most five seconds.
#[derive(Debug)]
pub struct VolumeWorker {
    inputs: Sender<Input>,
    events: Receiver<VolumeEvent>,
    works: Works<SceneLoop<'static>>,
}

impl VolumeWorker {
    /// Starts the thread. There is no scene until you send [`VolumeCommand::Open`]. The thread
    /// calls `wake` after each event, so that you can draw the window again.
    #[must_use]
    pub fn start(wake: impl Fn() + Send + 'static) -> Self {
        let (inputs, receiver) = channel();
        let (sender, events) = channel();
        let thread = Awaited::spawn(move || {
            let send = move |event| {
                // Sending fails only if the front end has dropped the receiver.
                let _ = sender.send(event);
                wake();
            };
            if catch_unwind(AssertUnwindSafe(|| SceneLoop::new(Inbox::new(receiver), &send).run()))
                .is_err()
            {
                send(VolumeEvent::Message {
                    text: "the scene has stopped by a fault of the program".to_owned(),
                    hint: Some(Hint::new("start it again; it takes up what was saved last")),
                    failed: true,
                });
            }
        });
        Self { inputs, events, works: Works::OnThread { _thread: thread } }
    }

    /// A worker without a thread, for a page in a browser. It works only while you call
    /// [`VolumeWorker::turn`], and calls `wake` after each event.
    #[must_use]
    pub fn in_turns(wake: impl Fn() + 'static) -> Self {
        let (inputs, receiver) = channel();
        let (sender, events) = channel();
        let work = SceneLoop::new(Inbox::new(receiver), move |event| {
            let _ = sender.send(event);
            wake();
        });
        Self { inputs, events, works: Works::in_turns(work) }
    }

    /// Lets a worker of [`VolumeWorker::in_turns`] work until `deadline`, or until it must wait. It
    /// finishes a step or a picture that it has begun by then. Returns how long you may wait until
    /// the next turn, where [`Wait::Forever`] means until the next command. On a worker with a
    /// thread this does nothing.
    pub fn turn(&self, deadline: Instant) -> Wait {
        self.works.turn(|work| work.turn(deadline))
    }

    /// Sends a command. This has no effect after the worker has ended.
    pub fn ask(&self, command: VolumeCommand) {
        let _ = self.inputs.send(Input::Command(Box::new(command)));
    }

    /// Events since the last call.
    pub fn events(&self) -> impl Iterator<Item = VolumeEvent> + '_ {
        let events: Vec<VolumeEvent> = self.events.try_iter().collect();
        let received = events
            .iter()
            .filter(|event: &&VolumeEvent| matches!(event, VolumeEvent::Picture(_)))
            .count();
        if received > 0 {
            let _ = self.inputs.send(Input::Confirmed(received));
        }
        events.into_iter()
    }
}

impl Drop for VolumeWorker {
    fn drop(&mut self) {
        self.ask(VolumeCommand::Quit);
    }
}

/// Time for a picture of a scene that moves. If it would take longer, it is drawn smaller.
const MOVING: PictureShareDuration = PictureShareDuration::from_millis(40);

/// Smallest share of width and height at which moving scenes are drawn.
const SMALLEST: f64 = 0.5;

/// Share of width and height, in eighths, so that a picture of `size` takes no longer than
/// [`MOVING`]. It is at least [`SMALLEST`].
pub(super) fn share_in_time([width, height]: [usize; 2], pixel_seconds: f64) -> f64 {
    let whole = pixel_seconds * (width * height) as f64;
    let share = (MOVING.as_secs_f64() / whole.max(1e-9)).sqrt();
    ((8.0 * share).floor() / 8.0).clamp(SMALLEST, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moving_picture_is_as_large_as_there_is_time_for() {
        assert_eq!(
            [0.0, 39.0, 41.0, 71.0, 170.0, 1e9]
                .map(|milliseconds: f64| share_in_time([800, 500], 1e-3 * milliseconds / 4e5)),
            [1.0, 1.0, 0.875, 0.75, 0.5, 0.5]
        );
    }
}
