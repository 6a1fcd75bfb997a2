//! What panels see, and what they can ask for.

use render::paint::strokes::Action;

use super::tools::Tools;
use crate::files::FileRequest;
use session::{Command, PaintingState};

/// What a panel asks for.
#[derive(Debug)]
pub enum Request {
    /// Of the worker.
    Worker(Command),
    /// Of the files.
    File(FileRequest),
}

/// What a panel sees, and where it puts what it asks for.
#[derive(Debug)]
pub struct Desk<'a> {
    /// The painting.
    pub easel: &'a PaintingState,
    /// What the painter has in hand.
    pub tools: &'a mut Tools,
    /// What is asked for, in order.
    pub asked: &'a mut Vec<Request>,
}

impl Desk<'_> {
    /// Asks the worker.
    pub fn command(&mut self, command: Command) {
        self.asked.push(Request::Worker(command));
    }

    /// Asks the worker for one action of the history.
    pub fn act(&mut self, action: Action) {
        self.command(Command::Apply(action));
    }

    /// Asks for something about files.
    pub fn file(&mut self, request: FileRequest) {
        self.asked.push(Request::File(request));
    }
}
