//! Intents of the workspace of scenes: everything that keys, menus and toolbar can request.

use session::volumes::SceneTool;

use crate::app::intent::Shortcut;

/// One action of the hand in a scene, or on its window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SceneIntent {
    /// Begins a scene on the village.
    New,
    /// Opens a model, a photograph or a script.
    Open,
    /// Saves the script.
    Save,
    /// Goes back to the easel.
    Easel,
    /// Closes the program.
    Quit,
    /// Takes back the last event.
    Undo,
    /// Lets time run, or stops it.
    Play,
    /// Takes one step.
    Step,
    /// Goes to the start.
    Start,
    /// Shows the volumes, or the final picture.
    Volumes,
    /// Hatches, or not.
    Hatching,
    /// Dries all paint.
    DryAll,
    /// Fills the tubes from a library.
    Library,
    /// Changes what volumes show inside.
    Inside,
    /// Frames the whole scene.
    Frame,
    /// Pours more in a second.
    More,
    /// Pours less in a second.
    Less,
    /// Takes a tube in hand, by its number from 1.
    Tube(u8),
    /// Takes a tool in hand.
    Tool(SceneTool),
    /// Shows or hides the panels.
    Panels,
    /// Toggles full screen.
    FullScreen,
    /// Shows or hides the table of keys.
    Keys,
}

/// Menu of the menu bar that holds an entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SceneMenu {
    /// Opening and saving.
    File,
    /// Events and time.
    Edit,
    /// The picture that is shown.
    View,
    /// Tools, which also stand in the toolbar.
    Tools,
    /// The table of keys.
    Help,
}

/// Menu entry of an intent.
#[derive(Debug, Clone, Copy)]
pub struct SceneEntry {
    /// Intent that the entry requests.
    pub intent: SceneIntent,
    /// Menu that holds the entry.
    pub menu: SceneMenu,
    /// Name shown in the menu.
    pub name: &'static str,
    /// Description shown in the tooltip and the table of keys.
    pub description: &'static str,
    /// Shortcuts; the first is shown beside the name.
    pub shortcuts: &'static [Shortcut],
}

impl SceneIntent {
    /// Whether a held key repeats it.
    pub(super) fn repeats(self) -> bool {
        matches!(self, Self::Step | Self::More | Self::Less | Self::Undo)
    }
}
