//! Context in which a panel is drawn: the painting, the tools, and a queue of requests.

use paint::strokes::{Action, Load, Recipe};

use super::tools::{Mode, Tools};
use crate::files::FileRequest;
use session::{Command, PaintingState};

/// Height of paint, in mm, below which a brush is full: the smallest load that the panel offers.
const LEAST_LOAD_MM: f64 = 0.02;

/// Number of mixtures that are remembered as loaded last.
const MOST_RECENT: usize = 6;

/// Request of a panel.
#[derive(Debug)]
pub enum Request {
    /// Command for the worker.
    Worker(Command),
    /// Request for the file manager.
    File(FileRequest),
}

/// Input and output of a panel in one frame.
#[derive(Debug)]
pub struct PanelContext<'a> {
    /// State of the painting as last reported by the worker.
    pub painting: &'a PaintingState,
    /// Selected tool, brush and tool settings.
    pub tools: &'a mut Tools,
    /// Requests in order; the window carries them out after the frame.
    pub requests: &'a mut Vec<Request>,
}

impl PanelContext<'_> {
    /// Queues a command for the worker.
    pub fn command(&mut self, command: Command) {
        self.requests.push(Request::Worker(command));
    }

    /// Queues an action, which becomes one entry of the history.
    pub fn act(&mut self, action: Action) {
        self.command(Command::Apply(action));
    }

    /// Adds paint of a recipe with this share of medium to the selected brush, as high as set in
    /// the tools or as the brush can still take, and selects the paint tool. What the brush holds
    /// stays on it until it is washed.
    pub fn load(&mut self, recipe: Recipe, vehicle: f64) {
        if recipe.len() > 1 {
            let recent = &mut self.tools.recent;
            recent.retain(|(known, _)| *known != recipe);
            recent.insert(0, (recipe.clone(), vehicle));
            recent.truncate(MOST_RECENT);
        }
        let brush = self.tools.brush.clone();
        let mut amount_mm = self.tools.load_mm;
        let state = self.painting.brushes.iter().find(|state| state.name == brush);
        // A full brush is sent the whole load, whose refusal names the way out.
        if let Some(most_mm) = state.map(|state| state.most_load_mm)
            && most_mm >= LEAST_LOAD_MM
        {
            amount_mm = amount_mm.min(most_mm);
        }
        self.act(Action::Load(Load { brush, recipe, vehicle, amount_mm }));
        self.tools.mode = Mode::Paint;
    }

    /// Queues a file request.
    pub fn file(&mut self, request: FileRequest) {
        self.requests.push(Request::File(request));
    }
}
