//! The worker that owns the paint. The front end holds a [`Worker`]. Its loop takes commands from
//! the inbox, paints the open stroke for a moment and sends events. It runs on a thread of its own,
//! or in the turns that the front end gives it. If you drop a worker, it waits for its thread to
//! end.

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, TryRecvError, channel};

use web_time::{Duration, Instant};

use documents::hint::{Explain, Hint};
use graphics::gpu::{BackendChoice, DeviceError};
use paint::painting::{OpenStroke, PaintingError, UNDO_BYTES};
use paint::session::PaintingSession;
use paint::strokes::{Action, Stroke};

use super::backend::Backend;
use super::command::{Command, PenSample};
use super::event::{Event, Snapshot};
use super::meter::{Meter, stroke_message};
use super::miniature::Shots;
use super::outbox::{Outbox, head_on_canvas, is_lifted, waiting_substeps};
use super::prepare::PreparedPainting;
use super::replay::{Groups, Replay};
use super::report::Reporter;
use super::state::Performance;
use super::thread::{Awaited, Wait, Works};

/// Minimum time between two states: 20 a second.
const STATE_INTERVAL: Duration = Duration::from_millis(50);

/// Time between two reports of performance while a stroke is open.
const STROKE_REPORT_INTERVAL: Duration = Duration::from_millis(250);

/// Time between two reports of performance while no stroke is open.
const IDLE_REPORT_INTERVAL: Duration = Duration::from_secs(1);

/// Shortest time between two pictures of the history during a replay.
const REPLAY_SHOT_INTERVAL: Duration = Duration::from_millis(500);

#[derive(Debug)]
pub(super) enum Input {
    Command(Command),
    /// The front end received this many parts of pictures.
    Confirmed(usize),
}

/// Commands in order, and urgent requests.
#[derive(Debug)]
pub(super) struct Inbox {
    receiver: Receiver<Input>,
    waiting: VecDeque<Command>,
    /// How many parts of pictures the front end confirmed since this was last reset.
    pub(super) confirmed: usize,
    pub(super) cancelled: bool,
    /// Whether the thread must end, because of [`Command::Quit`] or because the front end dropped
    /// its handle.
    pub(super) quit: bool,
}

impl Inbox {
    pub(super) fn new(receiver: Receiver<Input>) -> Self {
        Self { receiver, waiting: VecDeque::new(), confirmed: 0, cancelled: false, quit: false }
    }

    /// Receives all messages. If there are none, waits as long as `wait` allows.
    pub(super) fn receive(&mut self, wait: Wait) {
        let first = match wait {
            Wait::None => None,
            Wait::Forever => match self.receiver.recv() {
                Ok(input) => Some(input),
                Err(_) => return self.quit = true,
            },
            Wait::Until(then) => {
                match self.receiver.recv_timeout(then.saturating_duration_since(Instant::now())) {
                    Ok(input) => Some(input),
                    Err(RecvTimeoutError::Timeout) => None,
                    Err(RecvTimeoutError::Disconnected) => return self.quit = true,
                }
            }
        };
        if let Some(input) = first {
            self.sort_in(input);
        }
        loop {
            match self.receiver.try_recv() {
                Ok(input) => self.sort_in(input),
                Err(TryRecvError::Empty) => break,
                Err(TryRecvError::Disconnected) => return self.quit = true,
            }
        }
    }

    fn sort_in(&mut self, input: Input) {
        match input {
            Input::Confirmed(parts) => self.confirmed += parts,
            Input::Command(Command::Quit) => self.quit = true,
            Input::Command(Command::Cancel) => self.cancelled = true,
            Input::Command(command) => {
                if let Some(last) = self.waiting.back_mut()
                    && is_outdated_by(last, &command)
                {
                    *last = command;
                } else {
                    self.waiting.push_back(command);
                }
            }
        }
    }

    pub(super) fn next(&mut self) -> Option<Command> {
        self.waiting.pop_front()
    }

    /// Removes the next command if it is `wanted`.
    pub(super) fn next_if(&mut self, wanted: impl FnOnce(&Command) -> bool) -> Option<Command> {
        if wanted(self.waiting.front()?) { self.waiting.pop_front() } else { None }
    }

    /// Whether the next command is `wanted`.
    pub(super) fn next_is(&self, wanted: impl FnOnce(&Command) -> bool) -> bool {
        self.waiting.front().is_some_and(wanted)
    }

    /// Removes the commands that can be executed during a replay, even if others come before them.
    pub(super) fn take_questions(&mut self) -> Vec<Command> {
        let (questions, others) = self.waiting.drain(..).partition(|command| {
            matches!(
                command,
                Command::Snapshot(_)
                    | Command::Keep { .. }
                    | Command::Pick { .. }
                    | Command::SetUndoBytes(_)
            )
        });
        self.waiting = others;
        Vec::from(questions)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Number of pen samples in waiting commands.
    pub(super) fn samples(&self) -> usize {
        self.waiting
            .iter()
            .map(|command: &Command| match command {
                Command::PenMove(samples) => samples.len(),
                _ => 0,
            })
            .sum()
    }
}

/// Whether `new` replaces `waiting`: only the last value counts while you drag a slider.
fn is_outdated_by(waiting: &Command, new: &Command) -> bool {
    match (waiting, new) {
        (Command::Adjust(Action::Light(_)), Command::Adjust(Action::Light(_)))
        | (Command::Adjust(Action::Gloss { .. }), Command::Adjust(Action::Gloss { .. }))
        | (Command::Adjust(Action::Stiffness { .. }), Command::Adjust(Action::Stiffness { .. }))
        | (Command::SetSecondLight(_), Command::SetSecondLight(_)) => true,
        (
            Command::Adjust(Action::Opacity { layer, .. }),
            Command::Adjust(Action::Opacity { layer: new, .. }),
        ) => layer == new,
        _ => false,
    }
}

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
    fn run(mut self) {
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
    fn turn(&mut self, deadline: Instant) -> Option<Wait> {
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

    /// Paints a slice of a stroke, or executes the next command.
    fn work(&mut self) -> Result<(), PaintingError> {
        if self.playing.is_some() {
            for question in self.inbox.take_questions() {
                self.answer(question)?;
            }
            self.play()
        } else if self.stroke().is_some() {
            self.paint()
        } else if let Some(command) = self.inbox.next() {
            self.execute(command)
        } else {
            Ok(())
        }
    }

    /// Continues the open stroke: adds all samples that arrived, then answers a question or paints
    /// a slice. Any other command lifts the brush first.
    fn paint(&mut self) -> Result<(), PaintingError> {
        while let Some(Command::PenMove(samples)) =
            self.inbox.next_if(|command| matches!(command, Command::PenMove(_)))
        {
            self.extend(&samples)?;
        }
        let waiting = self.open.as_ref().map_or(0, |open| waiting_substeps(open.session()));
        if waiting == 0
            && let Some(question) = self.inbox.next_if(Command::is_question)
        {
            return self.answer(question);
        }
        if self.inbox.next_if(|command| matches!(command, Command::PenUp)).is_some()
            || self.inbox.next_is(|command| !command.is_question())
        {
            // Any other command finishes the stroke first.
            self.lift()?;
        }
        self.paint_slice()
    }

    fn extend(&mut self, samples: &[PenSample]) -> Result<(), PaintingError> {
        let Some(open) = &mut self.open else { return Ok(()) };
        let session = &mut open.prepared.session;
        if is_lifted(session) {
            return Ok(());
        }
        for PenSample { sample, arrived } in samples {
            match session.extend(&[*sample]) {
                Ok(()) => self.outbox.add_sample(*arrived),
                Err(error) if !std::mem::replace(&mut self.sample_refused, true) => {
                    let hint = Some(Hint::new("the stroke goes on without it"));
                    (self.send)(Event::Message { text: error.to_string(), hint, failed: true });
                }
                Err(_) => {}
            }
        }
        session.advance(0).map(|_| ())
    }

    /// Lifts the brush of the open stroke, if one is open.
    pub(super) fn lift(&mut self) -> Result<(), PaintingError> {
        match &mut self.open {
            Some(open) if open.session().open_stroke().is_some() => open.prepared.session.lift(),
            _ => Ok(()),
        }
    }

    /// Paints a slice of the open stroke, about 8 ms of work. Closes the stroke once all is
    /// painted.
    pub(super) fn paint_slice(&mut self) -> Result<(), PaintingError> {
        let Some(open) = &mut self.open else { return Ok(()) };
        let session = &mut open.prepared.session;
        if session.open_stroke().is_none() {
            return Ok(());
        }
        let known = session.advance(0)?;
        let start = Instant::now();
        let waiting = session.advance(self.meter.slice())?;
        let now = Instant::now();
        self.meter.add_slice(now, known - waiting, now - start);
        let Some(stroke) = session.open_stroke() else { return Ok(()) };
        self.outbox.follow(stroke);
        self.picture_stale |= known > waiting;
        self.revision += u64::from(known > waiting);
        if stroke.is_lifted() && waiting == 0 {
            let Stroke { brush, tool, .. } = stroke.stroke();
            let brush = brush.clone();
            let tool = *tool;
            let report = session.end_stroke()?;
            if let (Some(report), false) = (report, tool.is_paint()) {
                // In a replay this message would come after every stroke.
                if self.playing.is_none() {
                    let (text, hint) = stroke_message(tool, &report.taken, session.canvas());
                    (self.send)(Event::Message { text, hint, failed: false });
                }
                open.reporter.tool_ended(&brush);
            } else if open.reporter.is_dirty_after_stroke(session, &brush)?
                && !std::mem::replace(&mut self.dirty_reported, true)
            {
                (self.send)(Event::DirtyBrush(brush));
            }
            (self.picture_stale, self.state_stale) = (true, true);
        }
        Ok(())
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
        if let PaintingError::Engine(DeviceError::Lost(..) | DeviceError::Refused { .. }) = error {
            self.recover();
        }
    }
}

/// Settings of a worker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WorkerOptions {
    /// Backend that computes the paint. The default is the best one available.
    pub backend: BackendChoice,
    /// Limit of the memory for undo, in bytes. The default is 512 MiB.
    pub undo_bytes: u64,
}

impl Default for WorkerOptions {
    fn default() -> Self {
        Self { backend: BackendChoice::Auto, undo_bytes: UNDO_BYTES }
    }
}

/// Handle of the worker that owns the paint. If you drop this, the thread ends, and the drop waits
/// for it for at most five seconds.
#[derive(Debug)]
pub struct Worker {
    // Dropped first, so that the thread ends.
    inputs: Sender<Input>,
    events: Receiver<Event>,
    works: Works<WorkerLoop<'static>>,
}

impl Worker {
    /// Starts the thread. There is no painting until you send [`Command::Open`]. The thread calls
    /// `wake` after each event, so that you can draw the window again.
    ///
    /// The worker sends only a few parts of pictures until you receive them with
    /// [`Worker::events`]. If you read rarely, you get the changes in between combined.
    #[must_use]
    pub fn start(options: WorkerOptions, wake: impl Fn() + Send + 'static) -> Self {
        let (inputs, receiver) = channel();
        let (sender, events) = channel();
        let thread = Awaited::spawn(move || {
            let send = move |event| {
                // Sending fails only if the front end has dropped the receiver.
                let _ = sender.send(event);
                wake();
            };
            report_panic(&send, || {
                let backend = Backend::new(options.backend);
                WorkerLoop::new(Inbox::new(receiver), backend, options.undo_bytes, &send).run();
            });
        });
        Self { inputs, events, works: Works::OnThread { _thread: thread } }
    }

    /// A worker without a thread, for a page in a browser. It works only while you call
    /// [`Worker::turn`], and calls `wake` after each event.
    #[must_use]
    pub fn in_turns(options: WorkerOptions, wake: impl Fn() + 'static) -> Self {
        let (inputs, receiver) = channel();
        let (sender, events) = channel();
        let send = move |event| {
            // Sending fails only if the front end has dropped the receiver.
            let _ = sender.send(event);
            wake();
        };
        let backend = Backend::new(options.backend);
        let work = WorkerLoop::new(Inbox::new(receiver), backend, options.undo_bytes, send);
        Self { inputs, events, works: Works::in_turns(work) }
    }

    /// Lets a worker of [`Worker::in_turns`] work until `deadline`, or until it must wait. It
    /// finishes what it has begun by then, at most a slice of 8 ms or one command. Returns how long
    /// you may wait until the next turn, where [`Wait::Forever`] means until the next command. On a
    /// worker with a thread this does nothing.
    pub fn turn(&self, deadline: Instant) -> Wait {
        self.works.turn(|work| work.turn(deadline))
    }

    /// Sends a command. This has no effect after the worker has ended.
    pub fn ask(&self, command: Command) {
        let _ = self.inputs.send(Input::Command(command));
    }

    /// Events since the last call.
    pub fn events(&self) -> impl Iterator<Item = Event> + '_ {
        let events: Vec<Event> = self.events.try_iter().collect();
        let received = events
            .iter()
            .filter(|event: &&Event| matches!(event, Event::Tiles { .. } | Event::Head(Some(_))))
            .count();
        if received > 0 {
            let _ = self.inputs.send(Input::Confirmed(received));
        }
        events.into_iter()
    }
}

/// Runs `work`, and sends a message if it panics.
fn report_panic(send: &dyn Fn(Event), work: impl FnOnce()) {
    let Err(panic) = catch_unwind(AssertUnwindSafe(work)) else { return };
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    let reason = text.unwrap_or("no reason given");
    send(Event::Message {
        text: format!("painting has stopped by a fault of the program: {reason}"),
        hint: Some(Hint::new("start it again; it takes up what was saved last")),
        failed: true,
    });
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use paint::document::Lighting;
    use paint::strokes::LayerRef;

    use super::*;

    fn received(commands: Vec<Command>) -> Inbox {
        let (sender, receiver) = channel();
        let mut inbox = Inbox::new(receiver);
        for command in commands {
            sender.send(Input::Command(command)).unwrap();
        }
        inbox.receive(Wait::None);
        inbox
    }

    fn light(azimuth_deg: f64) -> Action {
        Action::Light(Lighting { azimuth_deg, ..Lighting::default() })
    }

    #[test]
    fn only_the_last_value_of_a_drag_is_kept() {
        fn opacity(layer: usize, value: f64) -> Command {
            Command::Adjust(Action::Opacity { layer: LayerRef::Dry(layer), value })
        }
        fn stiffness(value: f64) -> Command {
            Command::Adjust(Action::Stiffness { value })
        }
        let mut inbox = received(vec![
            Command::Adjust(light(1.0)),
            Command::Adjust(light(2.0)),
            opacity(0, 0.5),
            opacity(0, 0.6),
            opacity(1, 0.7),
            stiffness(0.8),
            stiffness(0.9),
            Command::EndAdjustment,
            Command::Apply(light(3.0)),
            Command::Apply(light(4.0)),
        ]);
        let commands: Vec<String> =
            std::iter::from_fn(|| inbox.next()).map(|command| format!("{command:?}")).collect();
        let wanted = [
            Command::Adjust(light(2.0)),
            opacity(0, 0.6),
            opacity(1, 0.7),
            stiffness(0.9),
            Command::EndAdjustment,
            Command::Apply(light(3.0)),
            Command::Apply(light(4.0)),
        ];
        assert_eq!(commands, wanted.map(|command| format!("{command:?}")));
    }

    #[test]
    fn urgent_commands_skip_the_queue() {
        let mut inbox = received(vec![
            Command::PenUp,
            Command::Snapshot(1),
            Command::Cancel,
            Command::Recording(2),
            Command::Snapshot(3),
        ]);
        assert!(inbox.cancelled && !inbox.quit, "a replay ends, the thread does not");
        let numbers: Vec<u64> = inbox
            .take_questions()
            .into_iter()
            .map(|command| match command {
                Command::Snapshot(number) => number,
                other => panic!("no question: {other:?}"),
            })
            .collect();
        assert_eq!(numbers, [1, 3]);
        assert!(matches!(inbox.next(), Some(Command::PenUp)), "the others keep their order");
        assert!(matches!(inbox.next(), Some(Command::Recording(2))), "the others keep their order");
        assert!(inbox.is_empty(), "that was all");
    }

    #[test]
    fn a_window_that_is_gone_ends_the_thread() {
        let (sender, receiver) = channel::<Input>();
        drop(sender);
        let mut inbox = Inbox::new(receiver);
        inbox.receive(Wait::Forever);
        assert!(inbox.quit, "nobody is left to ask");
    }

    #[test]
    fn a_panic_is_reported() {
        let events = RefCell::new(Vec::new());
        let send = |event| events.borrow_mut().push(event);
        report_panic(&send, || {});
        assert!(events.borrow().is_empty(), "nothing happened");
        let cells = 3;
        report_panic(&send, || assert!(cells > 7, "there are {cells} cells"));
        let [Event::Message { text, hint, failed: true }] = &events.borrow()[..] else {
            panic!("one message: {events:?}");
        };
        assert!(text.contains("there are 3 cells") && hint.is_some(), "{text}");
    }
}
