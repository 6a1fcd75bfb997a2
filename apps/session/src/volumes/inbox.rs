//! Commands of the front end that wait to be carried out.

use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use web_time::Instant;

use super::command::VolumeCommand;

#[derive(Debug)]
pub(super) enum Input {
    Command(Box<VolumeCommand>),
    /// The front end received this many pictures.
    Confirmed(usize),
}

#[derive(Debug)]
pub(super) struct Inbox {
    receiver: Receiver<Input>,
    waiting: VecDeque<VolumeCommand>,
    /// How many pictures the front end confirmed since this was last reset.
    pub(super) confirmed: usize,
    pub(super) quit: bool,
}

impl Inbox {
    pub(super) fn new(receiver: Receiver<Input>) -> Self {
        Self { receiver, waiting: VecDeque::new(), confirmed: 0, quit: false }
    }

    /// Waits until `then` or until there is a message, and receives all messages. If `then` is
    /// `None`, it waits without limit.
    pub(super) fn receive(&mut self, then: Option<Instant>) {
        let first = match then {
            None => self.receiver.recv().map_err(|_| RecvTimeoutError::Disconnected),
            Some(then) => {
                self.receiver.recv_timeout(then.saturating_duration_since(Instant::now()))
            }
        };
        match first {
            Ok(input) => self.sort_in(input),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => self.quit = true,
        }
        self.receive_all();
    }

    pub(super) fn receive_all(&mut self) {
        loop {
            match self.receiver.try_recv() {
                Ok(input) => self.sort_in(input),
                Err(TryRecvError::Empty) => return,
                Err(TryRecvError::Disconnected) => return self.quit = true,
            }
        }
    }

    fn sort_in(&mut self, input: Input) {
        match input {
            Input::Confirmed(pictures) => self.confirmed += pictures,
            Input::Command(command) if matches!(*command, VolumeCommand::Quit) => self.quit = true,
            Input::Command(command) => match self.waiting.back_mut() {
                Some(last) if last.is_outdated_by(&command) => *last = *command,
                _ => self.waiting.push_back(*command),
            },
        }
    }

    pub(super) fn next(&mut self) -> Option<VolumeCommand> {
        self.waiting.pop_front()
    }

    pub(super) fn has_waiting(&self) -> bool {
        !self.waiting.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::*;
    use VolumeCommand::{PenMove, PenUp, Play, Quit, Seek};

    use crate::volumes::command::ScenePen;

    #[test]
    fn commands_keep_their_order_and_the_last_of_a_drag_wins() {
        let (sender, receiver) = channel();
        let mut inbox = Inbox::new(receiver);
        fn pen(x: f32) -> ScenePen {
            ScenePen { at: [x, 0.5], pressure: 1.0 }
        }
        for command in
            [Seek(4), Seek(9), PenMove(pen(0.1)), PenMove(pen(0.2)), PenUp, PenMove(pen(0.3))]
        {
            sender.send(Input::Command(Box::new(command))).unwrap();
        }
        sender.send(Input::Confirmed(2)).unwrap();
        inbox.receive(None);
        let mut names = Vec::new();
        while let Some(command) = inbox.next() {
            names.push(match command {
                Seek(step) => format!("seek {step}"),
                PenMove(pen) => format!("move {}", pen.at[0]),
                other => format!("{other:?}"),
            });
        }
        assert_eq!(names, ["seek 9", "move 0.2", "PenUp", "move 0.3"]);
        assert_eq!((inbox.confirmed, inbox.quit), (2, false));
        sender.send(Input::Command(Box::new(Play(true)))).unwrap();
        sender.send(Input::Command(Box::new(Quit))).unwrap();
        inbox.receive(Some(Instant::now()));
        assert!(inbox.quit && inbox.has_waiting(), "quitting does not wait");
    }
}
