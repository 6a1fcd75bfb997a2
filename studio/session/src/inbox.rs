//! What the window asked for and is not done yet.

use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::Instant;

use render::paint::strokes::Action;

use super::command::Command;

/// What reaches the thread.
#[derive(Debug)]
pub(super) enum Input {
    /// The window asks for something.
    Command(Command),
    /// The window took this many parts of the picture.
    Taken(usize),
}

/// Commands in order, and what cannot wait for its turn.
#[derive(Debug)]
pub(super) struct Inbox {
    heard: Receiver<Input>,
    waiting: VecDeque<Command>,
    /// Parts of pictures that the window took since this was last looked at.
    pub(super) taken: usize,
    /// Whether a replay is to end.
    pub(super) cancelled: bool,
    /// Whether the thread is to end, or the window is gone.
    pub(super) quit: bool,
}

impl Inbox {
    pub(super) fn new(heard: Receiver<Input>) -> Self {
        Self { heard, waiting: VecDeque::new(), taken: 0, cancelled: false, quit: false }
    }

    /// Takes in all that was said; with `patience` waits for something, at most
    /// so long.
    pub(super) fn listen(&mut self, patience: Wait) {
        let first = match patience {
            Wait::None => None,
            Wait::Forever => match self.heard.recv() {
                Ok(said) => Some(said),
                Err(_) => return self.quit = true,
            },
            Wait::Until(then) => {
                match self.heard.recv_timeout(then.saturating_duration_since(Instant::now())) {
                    Ok(said) => Some(said),
                    Err(RecvTimeoutError::Timeout) => None,
                    Err(RecvTimeoutError::Disconnected) => return self.quit = true,
                }
            }
        };
        if let Some(said) = first {
            self.take_in(said);
        }
        loop {
            match self.heard.try_recv() {
                Ok(said) => self.take_in(said),
                Err(TryRecvError::Empty) => break,
                Err(TryRecvError::Disconnected) => return self.quit = true,
            }
        }
    }

    fn take_in(&mut self, said: Input) {
        match said {
            Input::Taken(parts) => self.taken += parts,
            Input::Command(Command::Quit) => self.quit = true,
            Input::Command(Command::Cancel) => self.cancelled = true,
            Input::Command(command) => {
                if let Some(last) = self.waiting.back_mut()
                    && outdated(last, &command)
                {
                    *last = command;
                } else {
                    self.waiting.push_back(command);
                }
            }
        }
    }

    /// The next in order.
    pub(super) fn next(&mut self) -> Option<Command> {
        self.waiting.pop_front()
    }

    /// The next in order, if `wanted`.
    pub(super) fn next_if(&mut self, wanted: impl FnOnce(&Command) -> bool) -> Option<Command> {
        if wanted(self.waiting.front()?) { self.waiting.pop_front() } else { None }
    }

    /// Whether the next in order is `wanted`.
    pub(super) fn next_is(&self, wanted: impl FnOnce(&Command) -> bool) -> bool {
        self.waiting.front().is_some_and(wanted)
    }

    /// Questions that a replay can answer on its way, out of their order.
    pub(super) fn take_questions(&mut self) -> Vec<Command> {
        let is_question = |command: &Command| {
            matches!(
                command,
                Command::Snapshot(_) | Command::Pick { .. } | Command::SetUndoBytes(_)
            )
        };
        let (questions, others) = self.waiting.drain(..).partition(is_question);
        self.waiting = others;
        Vec::from(questions)
    }

    /// Whether nothing waits.
    pub(super) fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Samples of strokes that wait.
    pub(super) fn samples(&self) -> usize {
        let samples = |command: &Command| match command {
            Command::PenMove(samples) => samples.len(),
            _ => 0,
        };
        self.waiting.iter().map(samples).sum()
    }
}

/// How long to wait for something to be said.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wait {
    /// Not at all: there is work.
    None,
    /// Until then.
    Until(Instant),
    /// As long as it takes.
    Forever,
}

/// Whether `waiting` need not be done when `new` follows: a control that is
/// dragged is only ever set to its last place.
fn outdated(waiting: &Command, new: &Command) -> bool {
    match (waiting, new) {
        (Command::Adjust(Action::Light(_)), Command::Adjust(Action::Light(_)))
        | (Command::Adjust(Action::Gloss { .. }), Command::Adjust(Action::Gloss { .. }))
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

    use render::paint::document::Lighting;
    use render::paint::strokes::LayerRef;

    use super::*;

    fn heard(commands: Vec<Command>) -> Inbox {
        let (say, heard) = channel();
        let mut inbox = Inbox::new(heard);
        for command in commands {
            say.send(Input::Command(command)).unwrap();
        }
        inbox.listen(Wait::None);
        inbox
    }

    fn light(azimuth_deg: f64) -> Action {
        Action::Light(Lighting { azimuth_deg, ..Lighting::default() })
    }

    #[test]
    fn of_a_drag_only_the_last_place_is_kept() {
        let opacity =
            |layer, value| Command::Adjust(Action::Opacity { layer: LayerRef::Dry(layer), value });
        let mut inbox = heard(vec![
            Command::Adjust(light(1.0)),
            Command::Adjust(light(2.0)),
            opacity(0, 0.5),
            opacity(0, 0.6),
            opacity(1, 0.7),
            Command::EndAdjustment,
            Command::Apply(light(3.0)),
            Command::Apply(light(4.0)),
        ]);
        let told: Vec<String> =
            std::iter::from_fn(|| inbox.next()).map(|command| format!("{command:?}")).collect();
        let wanted = [
            Command::Adjust(light(2.0)),
            opacity(0, 0.6),
            opacity(1, 0.7),
            Command::EndAdjustment,
            Command::Apply(light(3.0)),
            Command::Apply(light(4.0)),
        ];
        assert_eq!(told, wanted.map(|command| format!("{command:?}")));
    }

    #[test]
    fn what_is_urgent_does_not_wait_for_its_turn() {
        let mut inbox = heard(vec![
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
        let (say, heard) = channel::<Input>();
        drop(say);
        let mut inbox = Inbox::new(heard);
        inbox.listen(Wait::Forever);
        assert!(inbox.quit, "nobody is left to ask");
    }
}
