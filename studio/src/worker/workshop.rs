//! The loop.

use std::sync::mpsc::Receiver;

use super::command::Command;
use super::event::Event;
use super::thread::{Said, WorkerOptions};

/// All that the thread owns.
pub(super) struct Workshop<'a> {
    heard: Receiver<Said>,
    tell: &'a dyn Fn(Event),
}

impl<'a> Workshop<'a> {
    pub(super) fn new(_: WorkerOptions, heard: Receiver<Said>, tell: &'a dyn Fn(Event)) -> Self {
        Self { heard, tell }
    }

    /// Works until it is told to quit.
    pub(super) fn run(self) {
        let mut taken = 0;
        for said in &self.heard {
            match said {
                Said::Command(Command::Quit) => break,
                Said::Command(_) => (self.tell)(Event::Progress { done: taken, of: taken }),
                Said::Taken(count) => taken += count,
            }
        }
    }
}
