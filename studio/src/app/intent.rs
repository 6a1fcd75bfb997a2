//! What keys and menus can ask for.

use eframe::egui::{Key, Modifiers};

use crate::panels::Mode;

/// What is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Intent {
    /// Begins a new painting.
    New,
    /// Opens a file.
    Open,
    /// Saves the painting.
    Save,
    /// Saves it under another name.
    SaveAs,
    /// Keeps a numbered revision.
    KeepRevision,
    /// Exports a picture.
    Export,
    /// Saves the recording of all strokes.
    SaveRecording,
    /// Pins a picture beside the canvas.
    OpenReference,
    /// Paints under a measured lamp.
    OpenLamp,
    /// Shows the preferences.
    Preferences,
    /// Ends the program.
    Quit,
    /// Takes the last action back.
    Undo,
    /// Does it again.
    Redo,
    /// Dries the wet paint.
    Dry,
    /// Washes the brush.
    Wash,
    /// Wipes the brush.
    Wipe,
    /// Scrapes the palette clean.
    ScrapePalette,
    /// Exchanges the light for the one before.
    OtherLight,
    /// Makes the brush larger.
    Larger,
    /// Makes it smaller.
    Smaller,
    /// Turns a brush that nothing tells the hold of about its handle, to the left.
    TwistLeft,
    /// The same to the right.
    TwistRight,
    /// Takes a brush of the stand in hand, counted from 1.
    Brush(u8),
    /// Takes up a tool.
    Tool(Mode),
    /// Zooms in.
    ZoomIn,
    /// Zooms out.
    ZoomOut,
    /// Shows all of the canvas.
    Fit,
    /// One cell is one pixel.
    ActualSize,
    /// Shows all of it, upright.
    Upright,
    /// Turns the view to the left.
    TurnLeft,
    /// Turns the view to the right.
    TurnRight,
    /// Exchanges left and right of the view.
    Mirror,
    /// Shows or hides all panels.
    Panels,
    /// Shows or hides the palette.
    Palette,
    /// Shows or hides the figures.
    Figures,
    /// Fills the screen, or no longer.
    FullScreen,
    /// Shows the table of keys.
    Keys,
}

/// Where it stands in the menu bar.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Menu {
    /// Files.
    File,
    /// The painting.
    Edit,
    /// The view.
    View,
    /// Tools: in the column at the left and the table of keys.
    Tools,
    /// Help.
    Help,
}

/// A key with what is held beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stroke {
    /// Held beside it: `COMMAND` is Ctrl, on a Mac the command key.
    pub modifiers: Modifiers,
    /// The key.
    pub key: Key,
}

/// One thing that can be asked for.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// What.
    pub intent: Intent,
    /// Where it stands.
    pub menu: Menu,
    /// Its name.
    pub name: &'static str,
    /// What it does, for the tooltip.
    pub told: &'static str,
    /// Its keys; the first is shown beside its name.
    pub keys: &'static [Stroke],
}

impl Stroke {
    /// As it is written.
    #[must_use]
    pub fn written(&self) -> String {
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

    /// Whether a pressed key is this one.
    #[must_use]
    pub fn is(&self, key: Key, modifiers: Modifiers) -> bool {
        // What shift makes of a key is told as the key.
        let shifted = matches!(key, Key::Plus);
        key == self.key
            && modifiers.command == self.modifiers.command
            && !modifiers.alt
            && (shifted || modifiers.shift == self.modifiers.shift)
    }
}
