//! Commands of the front end that wait to be executed.

use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use web_time::Instant;

use paint::strokes::Action;

use super::command::Command;

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

/// How long the worker may wait for commands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Wait {
    /// Not at all: there is work to do.
    None,
    /// Until this time at most.
    Until(Instant),
    /// Without a time limit.
    Forever,
}

impl Wait {
    /// Waits until `then`, or forever if this is `None`.
    pub(crate) fn until(then: Option<Instant>) -> Self {
        match then {
            None => Self::Forever,
            Some(then) if then <= Instant::now() => Self::None,
            Some(then) => Self::Until(then),
        }
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

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

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
}
