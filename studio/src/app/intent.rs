//! Intents: everything that keys, menus and toolbar can request.

use eframe::egui::{Key, Modifiers};

use crate::panels::Mode;

/// One user action.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Intent {
    /// Starts a new painting.
    New,
    /// Opens a file.
    Open,
    /// Saves the painting.
    Save,
    /// Saves the painting under another name.
    SaveAs,
    /// Keeps a numbered revision.
    KeepRevision,
    /// Exports a picture.
    Export,
    /// Saves the recording of all strokes.
    SaveRecording,
    /// Opens a reference picture beside the canvas.
    OpenReference,
    /// Lights the painting with a measured lamp.
    OpenLamp,
    /// Shows the preferences.
    Preferences,
    /// Begins a scene of paint volumes.
    NewScene,
    /// Opens a scene of paint volumes.
    OpenScene,
    /// Shows the scene that is open.
    ShowScene,
    /// Closes the program.
    Quit,
    /// Undoes the last action.
    Undo,
    /// Redoes the last undone action.
    Redo,
    /// Dries a share of the wet paint.
    Dry,
    /// Removes all paint from the brush.
    Wash,
    /// Removes most of the paint from the brush.
    Wipe,
    /// Removes all paint from the palette.
    ScrapePalette,
    /// Switches to the previous light.
    OtherLight,
    /// Increases the brush size by one step.
    Larger,
    /// Decreases the brush size by one step.
    Smaller,
    /// Rotates the brush about its handle to the left, for devices without twist.
    TwistLeft,
    /// Rotates the brush about its handle to the right, for devices without twist.
    TwistRight,
    /// Selects a brush of the list by its number, from 1.
    Brush(u8),
    /// Selects a tool.
    Tool(Mode),
    /// Enlarges the view by one step.
    ZoomIn,
    /// Reduces the view by one step.
    ZoomOut,
    /// Fits the whole canvas and the palette into their views, keeping the rotation.
    Fit,
    /// Shows one canvas cell as one screen pixel.
    ActualSize,
    /// Fits the whole canvas into the view, upright and not mirrored.
    Upright,
    /// Rotates the view to the left by one step.
    TurnLeft,
    /// Rotates the view to the right by one step.
    TurnRight,
    /// Mirrors the view horizontally.
    Mirror,
    /// Shows or hides all panels.
    Panels,
    /// Shows or hides the palette.
    Palette,
    /// Shows or hides the performance figures.
    Figures,
    /// Toggles full screen.
    FullScreen,
    /// Shows or hides the table of keys.
    Keys,
}

/// Menu of the menu bar that holds an entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Menu {
    /// Opening, saving and exporting.
    File,
    /// Changes to painting, brush and light.
    Edit,
    /// Zoom, rotation and visible parts.
    View,
    /// Tools, which also stand in the toolbar at the left.
    Tools,
    /// The table of keys.
    Help,
}

/// A keyboard shortcut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shortcut {
    /// Modifier keys; `COMMAND` is Ctrl, on a Mac the command key.
    pub modifiers: Modifiers,
    /// Key that triggers it.
    pub key: Key,
}

/// Menu entry of an intent.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Intent that the entry requests.
    pub intent: Intent,
    /// Menu that holds the entry.
    pub menu: Menu,
    /// Name shown in the menu.
    pub name: &'static str,
    /// Description shown in the tooltip and the table of keys.
    pub description: &'static str,
    /// Shortcuts; the first is shown beside the name.
    pub shortcuts: &'static [Shortcut],
}

impl Shortcut {
    /// Text of the shortcut, such as `Ctrl+Z`.
    #[must_use]
    pub fn text(&self) -> String {
        let mut words = Vec::new();
        if self.modifiers.command {
            words.push(if cfg!(target_os = "macos") { "Cmd" } else { "Ctrl" });
        }
        if self.modifiers.shift {
            words.push("Shift");
        }
        words.push(match self.key {
            Key::OpenBracket => "[",
            Key::CloseBracket => "]",
            Key::Plus => "+",
            Key::Minus => "-",
            Key::Comma => ",",
            Key::Period => ".",
            Key::Equals => "=",
            key => key.name(),
        });
        words.join("+")
    }

    /// Whether a pressed key with these modifiers triggers the shortcut.
    #[must_use]
    pub fn matches(&self, key: Key, modifiers: Modifiers) -> bool {
        // Plus may need shift, which is then reported as held.
        let shifted = matches!(key, Key::Plus);
        key == self.key
            && modifiers.command == self.modifiers.command
            && !modifiers.alt
            && (shifted || modifiers.shift == self.modifiers.shift)
    }
}
