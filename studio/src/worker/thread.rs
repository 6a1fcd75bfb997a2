//! The thread itself.

use std::sync::mpsc::{Receiver, Sender, channel};

use super::command::Command;
use super::event::Event;

/// The worker, seen from the window.
#[derive(Debug)]
pub struct Worker {
    commands: Sender<Command>,
    events: Receiver<Event>,
}

impl Worker {
    /// Starts the thread. `wake` is called from it after every event, so that the
    /// window draws again.
    #[must_use]
    pub fn start(wake: impl Fn() + Send + 'static) -> Self {
        let (commands, asked) = channel();
        let (told, events) = channel();
        std::thread::spawn(move || {
            for command in asked {
                if matches!(command, Command::Quit) {
                    break;
                }
                let _ = told.send(Event::Replayed);
                wake();
            }
        });
        Self { commands, events }
    }

    /// Asks for something. A worker that ended takes no more.
    pub fn ask(&self, command: Command) {
        let _ = self.commands.send(command);
    }

    /// What was told since the last call.
    pub fn events(&self) -> impl Iterator<Item = Event> + '_ {
        self.events.try_iter()
    }
}
