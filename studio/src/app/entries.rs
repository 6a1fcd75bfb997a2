//! Everything that can be asked for, as data: its menu, its words, its keys.

use eframe::egui::{Key, Modifiers};

use super::intent::{Entry, Intent, Menu, Stroke};
use crate::panels::Mode;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

const fn key(modifiers: Modifiers, key: Key) -> Stroke {
    Stroke { modifiers, key }
}

const fn entry(
    intent: Intent,
    menu: Menu,
    name: &'static str,
    told: &'static str,
    keys: &'static [Stroke],
) -> Entry {
    Entry { intent, menu, name, told, keys }
}

/// Everything, in the order of the menus.
pub const ENTRIES: &[Entry] = &[
    entry(Intent::New, Menu::File, "New", "Begins a new painting", &[key(CTRL, Key::N)]),
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
        "Saves all strokes since the painting was taken up, to be played again",
        &[],
    ),
    entry(
        Intent::OpenReference,
        Menu::File,
        "Pin a picture...",
        "Pins a picture beside the canvas, to look at and to match colours of",
        &[],
    ),
    entry(
        Intent::OpenLamp,
        Menu::File,
        "Light of a lamp...",
        "Lights the painting with a lamp measured in a file",
        &[],
    ),
    entry(Intent::Quit, Menu::File, "Quit", "Ends the program", &[key(CTRL, Key::Q)]),
    entry(Intent::Undo, Menu::Edit, "Undo", "Takes the last action back", &[key(CTRL, Key::Z)]),
    entry(
        Intent::Redo,
        Menu::Edit,
        "Redo",
        "Does again what was taken back",
        &[key(CTRL_SHIFT, Key::Z), key(CTRL, Key::Y)],
    ),
    entry(
        Intent::Dry,
        Menu::Edit,
        "Dry",
        "Dries the share of the wet paint that the panel of the layers says",
        &[key(NONE, Key::D)],
    ),
    entry(
        Intent::Wash,
        Menu::Edit,
        "Wash the brush",
        "Takes all paint off the brush",
        &[key(NONE, Key::W)],
    ),
    entry(
        Intent::Wipe,
        Menu::Edit,
        "Wipe the brush",
        "Takes most of the paint off the brush",
        &[key(NONE, Key::X)],
    ),
    entry(
        Intent::ScrapePalette,
        Menu::Edit,
        "Scrape the palette",
        "Takes all paint off the palette",
        &[],
    ),
    entry(
        Intent::OtherLight,
        Menu::Edit,
        "Other light",
        "Exchanges the light for the one before, at first for a bulb, and back",
        &[key(NONE, Key::L)],
    ),
    entry(
        Intent::Larger,
        Menu::Edit,
        "Larger brush",
        "Makes the brush in hand larger",
        &[key(NONE, Key::CloseBracket)],
    ),
    entry(
        Intent::Smaller,
        Menu::Edit,
        "Smaller brush",
        "Makes the brush in hand smaller",
        &[key(NONE, Key::OpenBracket)],
    ),
    entry(
        Intent::TwistLeft,
        Menu::Edit,
        "Twist left",
        "Turns a brush that the mouse leads about its handle, to the left",
        &[key(NONE, Key::Comma)],
    ),
    entry(
        Intent::TwistRight,
        Menu::Edit,
        "Twist right",
        "Turns a brush that the mouse leads about its handle, to the right",
        &[key(NONE, Key::Period)],
    ),
    entry(
        Intent::Preferences,
        Menu::Edit,
        "Preferences...",
        "Autosave, undo memory, what computes, sizes, and how pens and mice lead a brush",
        &[key(CTRL, Key::Comma)],
    ),
    entry(
        Intent::ZoomIn,
        Menu::View,
        "Zoom in",
        "Makes the view larger",
        &[key(CTRL, Key::Plus), key(CTRL, Key::Equals), key(NONE, Key::Plus)],
    ),
    entry(
        Intent::ZoomOut,
        Menu::View,
        "Zoom out",
        "Makes the view smaller",
        &[key(CTRL, Key::Minus), key(NONE, Key::Minus)],
    ),
    entry(
        Intent::Fit,
        Menu::View,
        "Whole canvas",
        "Shows all of the canvas, as it is turned",
        &[key(CTRL, Key::Num0), key(NONE, Key::Num0)],
    ),
    entry(
        Intent::ActualSize,
        Menu::View,
        "Actual cells",
        "One cell of the canvas is one pixel of the screen",
        &[key(CTRL, Key::Num1)],
    ),
    entry(
        Intent::Upright,
        Menu::View,
        "Upright",
        "Shows all of the canvas, upright and not mirrored",
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
        "Exchanges left and right of the view; the painting stays as it is",
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
        "Shows frames a second, latency and how the engine keeps up",
        &[key(NONE, Key::F12), key(NONE, Key::F3)],
    ),
    entry(
        Intent::FullScreen,
        Menu::View,
        "Full screen",
        "Fills the screen, or no longer",
        &[key(NONE, Key::F11)],
    ),
    entry(
        Intent::Tool(Mode::Paint),
        Menu::Tools,
        "Paint",
        "The pen leads the brush",
        &[key(NONE, Key::B)],
    ),
    entry(
        Intent::Tool(Mode::Squeeze),
        Menu::Tools,
        "Squeeze",
        "The pen squeezes paint of the chosen tube",
        &[key(NONE, Key::Q)],
    ),
    entry(
        Intent::Tool(Mode::Pick),
        Menu::Tools,
        "Eyedropper",
        "The pen asks what paint lies there; also while Alt is held",
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
    entry(Intent::Keys, Menu::Help, "Keys", "Shows what the keys do", &[key(NONE, Key::F1)]),
];

impl Entry {
    /// The entry of an intent, if it stands in a menu.
    #[must_use]
    pub fn of(intent: Intent) -> Option<&'static Self> {
        ENTRIES.iter().find(|entry| entry.intent == intent)
    }

    /// Its first keys, as they are written: `Ctrl+Shift+S`.
    #[must_use]
    pub fn keys_written(&self) -> String {
        self.keys.first().map_or_else(String::new, Stroke::written)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_asks_for_two_things() {
        let mut seen: Vec<String> = Vec::new();
        for entry in ENTRIES {
            for stroke in entry.keys {
                let written = stroke.written();
                assert!(!seen.contains(&written), "{written} of {} is taken", entry.name);
                seen.push(written);
            }
        }
        assert!(seen.len() > 30, "{seen:?}");
    }

    #[test]
    fn keys_are_told_apart_by_what_is_held() {
        let undo = Entry::of(Intent::Undo).unwrap().keys[0];
        assert!(undo.is(Key::Z, CTRL) && !undo.is(Key::Z, CTRL_SHIFT), "{undo:?}");
        assert!(!undo.is(Key::Z, NONE), "{undo:?}");
        let redo = Entry::of(Intent::Redo).unwrap();
        assert_eq!(redo.keys_written(), "Ctrl+Shift+Z");
        // Plus is shift and something else on many keyboards.
        let held = Modifiers { shift: true, ..NONE };
        let plus = Entry::of(Intent::ZoomIn).unwrap().keys[2];
        assert!(plus.is(Key::Plus, held), "{plus:?}");
    }
}
