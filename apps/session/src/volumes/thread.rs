//! The worker of scenes as the front end sees it.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, channel};

use documents::hint::Hint;
use web_time::Instant;

use super::command::VolumeCommand;
use super::event::VolumeEvent;
use super::inbox::{Inbox, Input};
use super::worker::SceneLoop;
use crate::awaited::Awaited;
use crate::inbox::Wait;
use crate::works::Works;

/// Handle of the worker that owns a scene. Dropping it ends its thread and waits for that, at most
/// five seconds.
#[derive(Debug)]
pub struct VolumeWorker {
    inputs: Sender<Input>,
    events: Receiver<VolumeEvent>,
    works: Works<SceneLoop<'static>>,
}

impl VolumeWorker {
    /// Starts the thread. It has no scene until [`VolumeCommand::Open`]. `wake` is called on the
    /// thread after each event, so that a window can be drawn again.
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

    /// A worker without a thread, which works only while the front end calls
    /// [`VolumeWorker::turn`]: for a page in a browser. `wake` is called after each event.
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

    /// Lets a worker of [`VolumeWorker::in_turns`] work until `deadline`, or until it must wait; a step
    /// or a picture that it has begun by then it finishes. Returns how long it may wait for the
    /// next turn; [`Wait::Forever`] is until the next command. A worker on a thread does nothing here.
    pub fn turn(&self, deadline: Instant) -> Wait {
        self.works.turn(|work| work.turn(deadline))
    }

    /// Sends a command. Has no effect after the worker has ended.
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
