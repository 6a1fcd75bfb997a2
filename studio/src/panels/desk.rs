//! What panels see, and what they can ask for.

use std::path::PathBuf;

use render::paint::strokes::Action;

use super::tools::Tools;
use crate::worker::{Command, EaselState};

/// Something about files, done off the window's thread.
#[derive(Debug, Clone, PartialEq)]
pub enum FileRequest {
    /// Opens a painting, a library or a recording; asks for the file if none is
    /// named.
    Open(Option<PathBuf>),
    /// Saves where the painting came from, or asks.
    Save,
    /// Asks where to save.
    SaveAs,
    /// Keeps a numbered revision beside the painting.
    KeepRevision,
    /// Asks what to export, and where.
    Export,
    /// Saves the recording of all strokes; asks where.
    SaveRecording,
    /// Pins a picture beside the canvas; asks for the file if none is named.
    OpenReference(Option<PathBuf>),
    /// Takes the picture beside the canvas away.
    CloseReference,
    /// Paints under a lamp measured in a file; asks for the file.
    OpenLamp,
    /// Begins a new painting.
    New,
    /// Takes up what a lost session left.
    Recover(PathBuf),
    /// Throws away what a lost session left.
    Discard(PathBuf),
}

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
    pub easel: &'a EaselState,
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
        self.command(Command::Act(action));
    }

    /// Asks for something about files.
    pub fn file(&mut self, request: FileRequest) {
        self.asked.push(Request::File(request));
    }
}
