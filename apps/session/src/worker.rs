//! The loop of the worker thread: it receives commands, paints for a moment and sends events.

use web_time::{Duration, Instant};

use documents::hint::{Explain, Hint};
use graphics::gpu::DeviceError;
use paint::painting::{OpenStroke, PaintingError};
use paint::session::PaintingSession;

use super::backend::Backend;
use super::event::{Event, Snapshot};
use super::inbox::{Inbox, Wait};
use super::meter::Meter;
use super::miniature::Shots;
use super::outbox::{Outbox, head_on_canvas, is_lifted, waiting_substeps};
use super::prepare::PreparedPainting;
use super::replay::{Groups, Replay};
use super::report::Reporter;
use super::state::Performance;

/// Minimum time between two states: 20 a second.
const STATE_INTERVAL: Duration = Duration::from_millis(50);

/// Time between two reports of performance while a stroke is open.
const STROKE_REPORT_INTERVAL: Duration = Duration::from_millis(250);

/// Time between two reports of performance while no stroke is open.
const IDLE_REPORT_INTERVAL: Duration = Duration::from_secs(1);

/// Shortest time between two pictures of the history during a replay.
const REPLAY_SHOT_INTERVAL: Duration = Duration::from_millis(500);

pub(super) struct WorkerLoop<'a> {
    pub(super) send: Box<dyn Fn(Event) + 'a>,
    pub(super) inbox: Inbox,
    pub(super) outbox: Outbox,
    pub(super) meter: Meter,
    pub(super) backend: Backend,
    pub(super) undo_bytes: u64,
    pub(super) open: Option<OpenPainting>,
    /// Whether a sample of the open stroke was refused.
    pub(super) sample_refused: bool,
    pub(super) playing: Option<Replay>,
    /// When a replay at the pace of the painter continues. It is `None` if it need not wait.
    pub(super) pause: Option<Instant>,
    /// The last snapshot that was sent. We keep it while the paint is on a device that may be lost.
    pub(super) kept: Option<Snapshot>,
    /// Counts changes of the painting.
    pub(super) revision: u64,
    pub(super) state_stale: bool,
    /// Whether pictures may have changed since they were last rendered.
    pub(super) picture_stale: bool,
    state_due: Instant,
    performance_sent: Option<Instant>,
    performance: Performance,
    /// Whether the front end knows of a dirty brush.
    pub(super) dirty_reported: bool,
    head_shown: bool,
    /// The count of changes when we last checked whether the history needs a picture.
    pub(super) shot_revision: Option<u64>,
    /// Before this time, a fast replay takes no picture for the history.
    shot_due: Instant,
}

pub(super) struct OpenPainting {
    pub(super) prepared: PreparedPainting,
    pub(super) reporter: Reporter,
    pub(super) shots: Shots,
    /// Strokes that are undone together.
    pub(super) groups: Groups,
    /// Whether a message said that the recording ended early.
    pub(super) recording_stop_reported: bool,
}

impl OpenPainting {
    pub(super) fn session(&self) -> &PaintingSession {
        &self.prepared.session
    }
}

impl<'a> WorkerLoop<'a> {
    pub(super) fn new(
        inbox: Inbox,
        backend: Backend,
        undo_bytes: u64,
        send: impl Fn(Event) + 'a,
    ) -> Self {
        let now = Instant::now();
        Self {
            send: Box::new(send),
            inbox,
            outbox: Outbox::new(),
            meter: Meter::default(),
            backend,
            undo_bytes,
            open: None,
            sample_refused: false,
            playing: None,
            pause: None,
            kept: None,
            revision: 0,
            state_stale: false,
            picture_stale: false,
            state_due: now,
            performance_sent: None,
            performance: Performance::default(),
            dirty_reported: false,
            head_shown: false,
            shot_revision: None,
            shot_due: now,
        }
    }

    /// The open stroke, if one is open.
    pub(super) fn stroke(&self) -> Option<&OpenStroke> {
        self.open.as_ref()?.session().open_stroke()
    }

    /// Works until the command to quit.
    pub(super) fn run(mut self) {
        loop {
            self.inbox.receive(self.wait_time());
            if self.inbox.quit {
                return;
            }
            self.step();
        }
    }

    /// Works until `deadline`, or until it must wait, and returns for how long. It finishes a slice
    /// of painting or a command that has begun. Returns `None` after the command to quit.
    pub(super) fn turn(&mut self, deadline: Instant) -> Option<Wait> {
        loop {
            self.inbox.receive(Wait::None);
            if self.inbox.quit {
                return None;
            }
            self.step();
            let wait = self.wait_time();
            if wait != Wait::None || Instant::now() >= deadline {
                return Some(wait);
            }
        }
    }

    /// Executes a command or paints a slice, and sends what has changed.
    fn step(&mut self) {
        self.outbox.confirm(std::mem::take(&mut self.inbox.confirmed));
        if std::mem::take(&mut self.inbox.cancelled) {
            self.cancel();
        }
        let result = self.work().and_then(|()| self.take_shot());
        let result = result.and_then(|()| self.send_pictures());
        if let Err(error) = result.and_then(|()| self.send_state()) {
            self.report_failure(&error);
        }
        self.report_recording_stop();
        self.send_performance();
    }

    /// How long the worker may wait for commands until it has other work to do.
    fn wait_time(&self) -> Wait {
        let paints = self
            .open
            .as_ref()
            .is_some_and(|open| waiting_substeps(open.session()) > 0 || is_lifted(open.session()));
        let plays = self.playing.is_some() && self.pause.is_none();
        let waits = !self.inbox.is_empty() && self.playing.is_none();
        let summarizes = self.open.as_ref().is_some_and(|open| open.reporter.layers.is_behind());
        if paints || plays || waits || summarizes {
            return Wait::None;
        }
        let shows = self.picture_stale || self.outbox.is_behind();
        let times = [
            self.pause,
            self.outbox.due().filter(|_| shows),
            self.state_stale.then_some(self.state_due),
            self.performance_due().filter(|_| self.stroke().is_some() || !self.meter.is_idle()),
        ];
        times.into_iter().flatten().min().map_or(Wait::Forever, Wait::Until)
    }

    /// Takes a picture for the history if an action has ended. A replay ends actions faster than
    /// anyone could look, so it takes only few pictures.
    fn take_shot(&mut self) -> Result<(), PaintingError> {
        let Some(OpenPainting { prepared, shots, .. }) = &mut self.open else { return Ok(()) };
        let session = &mut prepared.session;
        let now = Instant::now();
        let hurries = self.playing.is_some() && now < self.shot_due;
        if session.open_stroke().is_some() || hurries || self.shot_revision == Some(self.revision) {
            return Ok(());
        }
        self.shot_revision = Some(self.revision);
        let done = session.history().1;
        shots.follow(&session.history_numbers());
        if !shots.has(done) {
            shots.keep(done, self.outbox.small_picture(session.canvas_mut())?);
            self.shot_due = now + REPLAY_SHOT_INTERVAL;
            self.state_stale = true;
        }
        Ok(())
    }

    /// Renders and sends the changed parts of the pictures, and the head with them.
    fn send_pictures(&mut self) -> Result<(), PaintingError> {
        let Some(open) = &mut self.open else { return Ok(()) };
        let session = &mut open.prepared.session;
        if self.outbox.is_due(Instant::now()) && (self.picture_stale || self.outbox.is_behind()) {
            self.picture_stale = false;
            self.outbox.send_changes(session, &mut self.meter, &*self.send)?;
            if let Some(head) = head_on_canvas(session) {
                self.outbox.send_head(head, &*self.send);
                self.head_shown = true;
            }
        }
        if self.head_shown && session.open_stroke().is_none() {
            self.head_shown = false;
            (self.send)(Event::Head(None));
        }
        Ok(())
    }

    /// Sends the state if it changed. While idle, summarizes a dry layer.
    fn send_state(&mut self) -> Result<(), PaintingError> {
        if self.state_stale && Instant::now() >= self.state_due {
            self.state_stale = false;
            if let Some(state) = self.state()? {
                (self.send)(Event::State(state));
            }
            self.state_due = Instant::now() + STATE_INTERVAL;
        }
        let busy = self.stroke().is_some() || self.playing.is_some() || !self.inbox.is_empty();
        if let Some(OpenPainting { prepared, reporter, .. }) = &mut self.open
            && !busy
            && reporter.layers.is_behind()
        {
            reporter.layers.summarize_next(prepared.session.canvas_mut())?;
            self.state_stale = true;
        }
        Ok(())
    }

    /// Sends a message if the recording ended early, once per painting.
    pub(super) fn report_recording_stop(&mut self) {
        let Some(open) = &mut self.open else { return };
        if let Some(reason) = open.prepared.session.recording_stopped()
            && !std::mem::replace(&mut open.recording_stop_reported, true)
        {
            let actions =
                open.prepared.session.recording().map_or(0, |script| script.actions.len());
            let text = format!("the recording ended early, after {actions} actions: {reason}");
            let hint =
                Hint::new("paint on and save the painting itself; the recording holds all before");
            self.send_message(text, Some(hint), false);
        }
    }

    /// Sends the performance if it changed. This happens more often while a stroke is open.
    fn send_performance(&mut self) {
        let now = Instant::now();
        if self.performance_due().is_some_and(|due| now < due) {
            return;
        }
        let behind = self.stroke().map_or(0, |stroke| {
            let unread = self.inbox.samples() as f64 * stroke.substeps_per_sample();
            stroke.waiting() + unread as usize
        });
        let performance = self.meter.performance(now, behind);
        self.outbox.paint_is_behind = performance.paint_is_behind;
        if performance != self.performance {
            self.performance = performance;
            (self.send)(Event::Performance(performance));
        }
        self.performance_sent = Some(now);
    }

    fn performance_due(&self) -> Option<Instant> {
        let open = self.stroke().is_some();
        let interval = if open { STROKE_REPORT_INTERVAL } else { IDLE_REPORT_INTERVAL };
        Some(self.performance_sent? + interval)
    }

    pub(super) fn send_message(&self, text: String, hint: Option<Hint>, failed: bool) {
        (self.send)(Event::Message { text, hint, failed });
    }

    /// Sends the message of an error. The painting has not changed, unless the device was lost:
    /// then it is recovered on the processor.
    pub(super) fn report_failure(&mut self, error: &PaintingError) {
        self.send_message(error.to_string(), error.hint(), true);
        self.state_stale = true;
        if let PaintingError::Engine(DeviceError::Lost { .. } | DeviceError::Refused { .. }) = error
        {
            self.recover();
        }
    }
}
