//! The loop: hears the window, paints for a moment, shows it, and so on.

use std::time::{Duration, Instant};

use render::gpu::DeviceError;
use render::paint::painting::PaintingError;
use render::paint::session::SessionError;
use spectra::hint::{Explain, Hint};

use super::backend::Backend;
use super::event::{Event, Snapshot};
use super::inbox::{Inbox, Wait};
use super::meter::Meter;
use super::outbox::Outbox;
use super::prepare::PreparedPainting;
use super::replay::Replay;
use super::report::Reporter;
use super::state::Performance;
use super::stroke::LiveStroke;

/// The least time between two tellings of the state: 20 a second.
const STATES: Duration = Duration::from_millis(50);

/// Between two tellings of the figures, while there is a stroke and else.
const FIGURES: [Duration; 2] = [Duration::from_millis(250), Duration::from_secs(1)];

/// All that the thread owns.
pub(super) struct WorkerLoop<'a> {
    pub(super) tell: &'a dyn Fn(Event),
    pub(super) inbox: Inbox,
    pub(super) outbox: Outbox,
    pub(super) meter: Meter,
    pub(super) backend: Backend,
    pub(super) undo_bytes: u64,
    pub(super) stage: Option<OpenPainting>,
    pub(super) live: Option<LiveStroke>,
    pub(super) playing: Option<Replay>,
    /// When the recording that is played goes on.
    pub(super) pause: Option<Instant>,
    /// What was last told whole, if a device may be lost.
    pub(super) kept: Option<Snapshot>,
    /// Counts changes of the painting.
    pub(super) revision: u64,
    /// Whether the window is to be told of the state.
    pub(super) stale: bool,
    /// Whether pictures may have changed since they were last computed.
    pub(super) unseen: bool,
    state_due: Instant,
    figures_told: Option<Instant>,
    figures: Performance,
    /// Whether the window draws the head.
    head: bool,
}

/// The painting, and what is kept to tell of it.
pub(super) struct OpenPainting {
    pub(super) opened: PreparedPainting,
    pub(super) teller: Reporter,
}

impl<'a> WorkerLoop<'a> {
    pub(super) fn new(
        inbox: Inbox,
        backend: Backend,
        undo_bytes: u64,
        tell: &'a dyn Fn(Event),
    ) -> Self {
        let now = Instant::now();
        Self {
            tell,
            inbox,
            outbox: Outbox::new(),
            meter: Meter::default(),
            backend,
            undo_bytes,
            stage: None,
            live: None,
            playing: None,
            pause: None,
            kept: None,
            revision: 0,
            stale: false,
            unseen: false,
            state_due: now,
            figures_told: None,
            figures: Performance::default(),
            head: false,
        }
    }

    /// Works until it is told to quit.
    pub(super) fn run(mut self) {
        loop {
            self.inbox.listen(self.patience());
            if self.inbox.quit {
                break;
            }
            self.outbox.taken(std::mem::take(&mut self.inbox.taken));
            if std::mem::take(&mut self.inbox.cancelled) {
                self.cancel();
            }
            let done = self.work().and_then(|()| self.show()).and_then(|()| self.tell_state());
            if let Err(error) = done {
                self.failed(&error);
            }
            self.tell_figures();
        }
    }

    /// How long nothing need be done.
    fn patience(&self) -> Wait {
        let paints = self.live.as_ref().is_some_and(|live| live.waiting > 0 || live.lifted);
        let plays = self.playing.is_some() && self.pause.is_none();
        let waits = !self.inbox.is_empty() && self.playing.is_none();
        let looks = self.stage.as_ref().is_some_and(|stage| stage.teller.layers.is_behind());
        if paints || plays || waits || looks {
            return Wait::None;
        }
        let shows = self.unseen || self.outbox.is_behind();
        let times = [
            self.pause,
            self.outbox.due().filter(|_| shows),
            self.stale.then_some(self.state_due),
            self.figures_due().filter(|_| self.live.is_some() || !self.meter.is_idle()),
        ];
        times.into_iter().flatten().min().map_or(Wait::Forever, Wait::Until)
    }

    /// Computes and tells what changed of the pictures, and the head with them.
    fn show(&mut self) -> Result<(), SessionError> {
        let Some(stage) = &mut self.stage else { return Ok(()) };
        let session = &mut stage.opened.session;
        if self.outbox.is_due(Instant::now()) && (self.unseen || self.outbox.is_behind()) {
            self.unseen = false;
            self.outbox.show(session, &mut self.meter, self.tell)?;
            if let Some(head) = self.live.as_ref().and_then(|live| live.head(session)) {
                self.outbox.tell_head(head, self.tell);
                self.head = true;
            }
        }
        if self.head && self.live.is_none() {
            self.head = false;
            (self.tell)(Event::Head(None));
        }
        Ok(())
    }

    /// Tells what changed besides pixels, or looks at a layer where there is time.
    fn tell_state(&mut self) -> Result<(), SessionError> {
        if self.stale && Instant::now() >= self.state_due {
            self.stale = false;
            if let Some(state) = self.state()? {
                (self.tell)(Event::State(state));
            }
            self.state_due = Instant::now() + STATES;
        }
        let busy = self.live.is_some() || self.playing.is_some() || !self.inbox.is_empty();
        if let Some(OpenPainting { opened, teller }) = &mut self.stage
            && !busy
            && teller.layers.is_behind()
        {
            teller.layers.look(opened.session.canvas_mut())?;
            self.stale = true;
        }
        Ok(())
    }

    /// Tells how it keeps up: while painting often, then until nothing happens.
    fn tell_figures(&mut self) {
        let now = Instant::now();
        if self.figures_due().is_some_and(|due| now < due) {
            return;
        }
        let behind = self.live.as_ref().map_or(0, |live| {
            live.waiting + (self.inbox.samples() as f64 * live.substeps_a_sample()) as usize
        });
        let figures = self.meter.figures(now, behind);
        if figures != self.figures {
            self.figures = figures;
            (self.tell)(Event::Performance(figures));
        }
        self.figures_told = Some(now);
    }

    fn figures_due(&self) -> Option<Instant> {
        Some(self.figures_told? + FIGURES[usize::from(self.live.is_none())])
    }

    /// Tells why something could not be done.
    pub(super) fn say(&self, text: String, hint: Option<Hint>, failed: bool) {
        (self.tell)(Event::Message { text, hint, failed });
    }

    /// Something could not be done; the painting is as it was, unless its device
    /// was lost.
    pub(super) fn failed(&mut self, error: &SessionError) {
        self.say(error.to_string(), error.hint(), true);
        self.stale = true;
        if let SessionError::Painting(PaintingError::Engine(
            DeviceError::Lost { .. } | DeviceError::Refused { .. },
        )) = error
        {
            self.recover();
        }
    }
}
