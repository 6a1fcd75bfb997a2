//! Context in which a panel of a scene is drawn: its state, the tools, and a queue of requests.

use std::path::PathBuf;

use super::chooser::TubeChooser;
use super::illuminant::SceneIlluminant;
use crate::files::SceneExport;
use session::volumes::{Grip, Here, Look, SceneState, VolumeCommand};

/// Tabs of the side panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SceneTab {
    /// The picture that is shown.
    #[default]
    View,
    /// The light.
    Light,
    /// What was found by the last right click.
    Here,
    /// The list of events.
    Events,
    /// Files that a scene makes.
    Export,
}

/// Tools and panels as they are set.
#[derive(Debug, Default)]
pub struct SceneTools {
    /// The tool in hand and how it is set.
    pub grip: Grip,
    /// The tab of the side panel.
    pub tab: SceneTab,
    /// Controls of the illuminant.
    pub illuminant: SceneIlluminant,
    /// Window that chooses the pigments of tubes.
    pub chooser: TubeChooser,
    /// The last answer to a right click.
    pub here: Option<Here>,
}

/// An action on files that menus and panels can request.
#[derive(Debug, Clone, PartialEq)]
pub enum SceneFileRequest {
    /// Opens a scene; asks for its file if none is given.
    Open(Option<PathBuf>),
    /// Fills the tubes from a library; asks for its file.
    Library,
    /// Writes a file; asks where.
    Export(SceneExport),
    /// Writes an export of the painting; asks which, and where.
    ExportOfPainting,
}

/// Request of a panel.
#[derive(Debug)]
pub enum SceneRequest {
    /// Command for the worker.
    Worker(VolumeCommand),
    /// Request for files.
    File(SceneFileRequest),
}

/// Input and output of a panel in one frame.
#[derive(Debug)]
pub struct SceneContext<'a> {
    /// State of the scene as last reported.
    pub state: &'a SceneState,
    /// Tools and panels.
    pub tools: &'a mut SceneTools,
    /// Requests in order; the window carries them out after the frame.
    pub requests: &'a mut Vec<SceneRequest>,
}

impl SceneContext<'_> {
    /// Queues a command for the worker.
    pub fn command(&mut self, command: VolumeCommand) {
        self.requests.push(SceneRequest::Worker(command));
    }

    /// Queues a request for files.
    pub fn file(&mut self, request: SceneFileRequest) {
        self.requests.push(SceneRequest::File(request));
    }

    /// Queues a change of what is shown.
    pub fn change_look(&mut self, change: impl FnOnce(&mut Look)) {
        let mut look = self.state.look;
        change(&mut look);
        if look != self.state.look {
            self.command(VolumeCommand::Look(look));
        }
    }
}
