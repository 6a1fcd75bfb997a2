//! Table of all menu entries: menu, name, description and shortcuts.

use eframe::egui::{Key, Modifiers};

use super::intent::{Entry, Intent, Menu, Shortcut};
use crate::panels::Mode;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

const fn key(modifiers: Modifiers, key: Key) -> Shortcut {
    Shortcut { modifiers, key }
}

const fn entry(
    intent: Intent,
    menu: Menu,
    name: &'static str,
    description: &'static str,
    shortcuts: &'static [Shortcut],
) -> Entry {
    Entry { intent, menu, name, description, shortcuts }
}

/// All entries in menu order.
pub const ENTRIES: &[Entry] = &[
    entry(Intent::New, Menu::File, "New", "Starts a new painting", &[key(CTRL, Key::N)]),
    entry(
        Intent::Open,
        Menu::File,
        "Open...",
        "Opens a painting, a pigment library or a recording of strokes",
        &[key(CTRL, Key::O)],
    ),
    entry(Intent::Save, Menu::File, "Save", "Saves the painting", &[key(CTRL, Key::S)]),
    entry(
        Intent::SaveAs,
        Menu::File,
        "Save as...",
        "Saves the painting in another file",
        &[key(CTRL_SHIFT, Key::S)],
    ),
    entry(
        Intent::KeepRevision,
        Menu::File,
        "Keep revision",
        "Keeps a numbered copy beside the painting",
        &[key(CTRL, Key::K)],
    ),
    entry(
        Intent::Export,
        Menu::File,
        "Export...",
        "Makes a PNG, a linear or spectral EXR, or maps of the pigments",
        &[key(CTRL, Key::E)],
    ),
    entry(
        Intent::SaveRecording,
        Menu::File,
        "Save recording...",
        "Saves all strokes since the painting was opened, for playback",
        &[],
    ),
    entry(
        Intent::OpenReference,
        Menu::File,
        "Pin a picture...",
        "Shows a reference picture beside the canvas, to match colours of",
        &[],
    ),
    entry(
        Intent::OpenLamp,
        Menu::File,
        "Light of a lamp...",
        "Lights the painting with a lamp measured in a file",
        &[],
    ),
    entry(
        Intent::NewScene,
        Menu::File,
        "New scene",
        "Begins a scene of paint volumes: a drawing that colour is poured over",
        &[],
    ),
    entry(
        Intent::OpenScene,
        Menu::File,
        "Open scene...",
        "Opens a model, a photograph or a script of paint volumes",
        &[],
    ),
    entry(
        Intent::ShowScene,
        Menu::File,
        "Back to the scene",
        "Shows the scene that is open; the painting stays as it is",
        &[],
    ),
    entry(Intent::Quit, Menu::File, "Quit", "Closes the program", &[key(CTRL, Key::Q)]),
    entry(Intent::Undo, Menu::Edit, "Undo", "Undoes the last action", &[key(CTRL, Key::Z)]),
    entry(
        Intent::Redo,
        Menu::Edit,
        "Redo",
        "Redoes the last undone action",
        &[key(CTRL_SHIFT, Key::Z), key(CTRL, Key::Y)],
    ),
    entry(
        Intent::Dry,
        Menu::Edit,
        "Dry",
        "Dries the share of the wet paint that is set in the layer panel",
        &[key(NONE, Key::D)],
    ),
    entry(
        Intent::Wash,
        Menu::Edit,
        "Wash the brush",
        "Removes all paint from the brush",
        &[key(NONE, Key::W)],
    ),
    entry(
        Intent::Wipe,
        Menu::Edit,
        "Wipe the brush",
        "Removes most of the paint from the brush",
        &[key(NONE, Key::X)],
    ),
    entry(
        Intent::ScrapePalette,
        Menu::Edit,
        "Scrape the palette",
        "Removes all paint from the palette",
        &[],
    ),
    entry(
        Intent::OtherLight,
        Menu::Edit,
        "Other light",
        "Switches between the current and the previous light, at first a tungsten bulb",
        &[key(NONE, Key::L)],
    ),
    entry(
        Intent::Larger,
        Menu::Edit,
        "Larger brush",
        "Makes the selected brush larger",
        &[key(NONE, Key::CloseBracket)],
    ),
    entry(
        Intent::Smaller,
        Menu::Edit,
        "Smaller brush",
        "Makes the selected brush smaller",
        &[key(NONE, Key::OpenBracket)],
    ),
    entry(
        Intent::TwistLeft,
        Menu::Edit,
        "Twist left",
        "Rotates a brush moved by the mouse about its handle to the left",
        &[key(NONE, Key::Comma)],
    ),
    entry(
        Intent::TwistRight,
        Menu::Edit,
        "Twist right",
        "Rotates a brush moved by the mouse about its handle to the right",
        &[key(NONE, Key::Period)],
    ),
    entry(
        Intent::Preferences,
        Menu::Edit,
        "Preferences...",
        "Autosave, undo memory, backend, sizes, and settings of pens and mice",
        &[key(CTRL, Key::Comma)],
    ),
    entry(
        Intent::ZoomIn,
        Menu::View,
        "Zoom in",
        "Enlarges the view",
        &[key(CTRL, Key::Plus), key(CTRL, Key::Equals), key(NONE, Key::Plus)],
    ),
    entry(
        Intent::ZoomOut,
        Menu::View,
        "Zoom out",
        "Reduces the view",
        &[key(CTRL, Key::Minus), key(NONE, Key::Minus)],
    ),
    entry(
        Intent::Fit,
        Menu::View,
        "Whole canvas",
        "Fits the whole canvas and the palette into their views, keeping the rotation",
        &[key(CTRL, Key::Num0), key(NONE, Key::Num0)],
    ),
    entry(
        Intent::ActualSize,
        Menu::View,
        "Actual cells",
        "Shows one canvas cell as one screen pixel",
        &[key(CTRL, Key::Num1)],
    ),
    entry(
        Intent::Upright,
        Menu::View,
        "Upright",
        "Fits the whole canvas into the view, upright and not mirrored",
        &[key(NONE, Key::Home)],
    ),
    entry(
        Intent::TurnLeft,
        Menu::View,
        "Turn left",
        "Turns the view by 15 degrees to the left",
        &[key(CTRL, Key::OpenBracket)],
    ),
    entry(
        Intent::TurnRight,
        Menu::View,
        "Turn right",
        "Turns the view by 15 degrees to the right",
        &[key(CTRL, Key::CloseBracket)],
    ),
    entry(
        Intent::Mirror,
        Menu::View,
        "Mirror",
        "Mirrors the view; the painting does not change",
        &[key(NONE, Key::M)],
    ),
    entry(
        Intent::Panels,
        Menu::View,
        "Panels",
        "Shows or hides all panels",
        &[key(NONE, Key::Tab)],
    ),
    entry(
        Intent::Palette,
        Menu::View,
        "Palette",
        "Shows or hides palette and tubes",
        &[key(NONE, Key::P)],
    ),
    entry(
        Intent::Figures,
        Menu::View,
        "Figures",
        "Shows frame rate, latency and speed of the paint engine",
        &[key(NONE, Key::F12), key(NONE, Key::F3)],
    ),
    entry(
        Intent::FullScreen,
        Menu::View,
        "Full screen",
        "Toggles full screen",
        &[key(NONE, Key::F11)],
    ),
    entry(
        Intent::Tool(Mode::Paint),
        Menu::Tools,
        "Paint",
        "The pen paints with the brush",
        &[key(NONE, Key::B)],
    ),
    entry(
        Intent::Tool(Mode::Squeeze),
        Menu::Tools,
        "Squeeze",
        "The pen squeezes paint from the selected tube",
        &[key(NONE, Key::Q)],
    ),
    entry(
        Intent::Tool(Mode::Pick),
        Menu::Tools,
        "Eyedropper",
        "The pen picks colour and paint; also while Alt is held",
        &[key(NONE, Key::I)],
    ),
    entry(
        Intent::Tool(Mode::Pan),
        Menu::Tools,
        "Hand",
        "The pen moves the view; also while the space bar is held, or with the middle button",
        &[key(NONE, Key::H)],
    ),
    entry(
        Intent::Tool(Mode::Rotate),
        Menu::Tools,
        "Turn",
        "The pen turns the view; also while shift and the space bar are held",
        &[key(NONE, Key::R)],
    ),
    entry(
        Intent::Tool(Mode::Zoom),
        Menu::Tools,
        "Zoom",
        "The pen zooms, upwards in; so does the wheel",
        &[key(NONE, Key::Z)],
    ),
    entry(Intent::Keys, Menu::Help, "Keys", "Shows the table of keys", &[key(NONE, Key::F1)]),
];

impl Entry {
    /// Returns the entry of an intent, if it has one.
    #[must_use]
    pub fn of(intent: Intent) -> Option<&'static Self> {
        ENTRIES.iter().find(|entry| entry.intent == intent)
    }

    /// Text of the first shortcut, such as `Ctrl+Shift+S`; empty without one.
    #[must_use]
    pub fn shortcut_text(&self) -> String {
        self.shortcuts.first().map_or_else(String::new, Shortcut::text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_shortcut_has_two_entries() {
        let mut seen: Vec<String> = Vec::new();
        for entry in ENTRIES {
            for shortcut in entry.shortcuts {
                let text = shortcut.text();
                assert!(!seen.contains(&text), "{text} of {} is taken", entry.name);
                seen.push(text);
            }
        }
        assert!(seen.len() > 30, "{seen:?}");
    }

    #[test]
    fn modifiers_distinguish_shortcuts() {
        let undo = Entry::of(Intent::Undo).unwrap().shortcuts[0];
        assert!(undo.matches(Key::Z, CTRL) && !undo.matches(Key::Z, CTRL_SHIFT), "{undo:?}");
        assert!(!undo.matches(Key::Z, NONE), "{undo:?}");
        let redo = Entry::of(Intent::Redo).unwrap();
        assert_eq!(redo.shortcut_text(), "Ctrl+Shift+Z");
        // On many keyboards plus needs shift.
        let held = Modifiers { shift: true, ..NONE };
        let plus = Entry::of(Intent::ZoomIn).unwrap().shortcuts[2];
        assert!(plus.matches(Key::Plus, held), "{plus:?}");
    }
}
