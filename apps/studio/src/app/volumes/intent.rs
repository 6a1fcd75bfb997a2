//! Intents of the workspace of scenes: everything that keys, menus and toolbar can request.

use serde::Serialize;
use session::volumes::SceneTool;

use crate::keymap::{Shortcut, name_of};

/// One action of the hand in a scene, or on its window. Its name in the preferences follows from
/// its name here.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SceneIntent {
    /// Begins a scene on the village.
    New,
    /// Opens a model, a photograph or a script.
    Open,
    /// Saves the script.
    Save,
    /// Goes back to the easel.
    Easel,
    /// Shows the preferences.
    Preferences,
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

impl SceneMenu {
    /// Name in the menu bar.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::File => "File",
            Self::Edit => "Edit",
            Self::View => "View",
            Self::Tools => "Tools",
            Self::Help => "Help",
        }
    }
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
    /// Name by which preferences keep its keys, such as `scene.step` or `scene.tool-pour`.
    #[must_use]
    pub fn name(self) -> String {
        format!("scene.{}", name_of(&self))
    }

    /// Whether a held key repeats it.
    pub(super) fn repeats(self) -> bool {
        matches!(self, Self::Step | Self::More | Self::Less | Self::Undo)
    }
}
