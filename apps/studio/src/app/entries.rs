//! All menu entries, one table per menu (name, description and shortcuts), and the rows of the
//! table of keys made from them.

use eframe::egui::{Context, Key, Modifiers};

use super::intent::{Entry, Intent};
use crate::app::intent::Menu;
use crate::keymap::{self, KeyRow, Shortcut};
use crate::language::{tr, tr_format};
use crate::panels::Mode;
use crate::theme::ThemeChoice;

/// All entries in menu order.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    [FILE_ENTRIES, EDIT_ENTRIES, VIEW_ENTRIES, TOOLS_ENTRIES, HELP_ENTRIES].into_iter().flatten()
}

impl Entry {
    /// Returns the entry of an intent, if it has one.
    #[must_use]
    pub fn of(intent: Intent) -> Option<&'static Self> {
        entries().find(|entry| entry.intent == intent)
    }

    /// Text of the entry's first key in use, e.g. `Ctrl+Shift+S`, or an empty text if it has none.
    /// Before you install any keys, this is its first standard key.
    #[must_use]
    pub fn shortcut_text(&self, context: &Context) -> String {
        keymap::text(context, &self.intent.name())
            .unwrap_or_else(|| self.shortcuts.first().map_or_else(String::new, Shortcut::text))
    }
}

const NONE: Modifiers = Modifiers::NONE;
const SHIFT: Modifiers = Modifiers::SHIFT;
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

const FILE_ENTRIES: &[Entry] = &[
    entry(Intent::New, Menu::File, "New", "Starts a new painting", &[key(CTRL, Key::N)]),
    entry(
        Intent::Open,
        Menu::File,
        "Open...",
        "Opens a painting, a pigment library or a recording of strokes",
        &[key(CTRL, Key::O)],
    ),
    entry(
        Intent::Sample,
        Menu::File,
        "Sample painting",
        "Opens a small still life to try things on: it has dry layers, glazes and wet paint",
        &[],
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
        "Makes a picture, layers for other programs, a spectral EXR, or maps of the pigments",
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
        Intent::ExportTimelapse,
        Menu::File,
        "Export timelapse...",
        "Shows how the painting was made, as a GIF, an animated PNG or frames",
        &[],
    ),
    entry(
        Intent::OpenReference,
        Menu::File,
        "Pin a picture...",
        "Shows a reference picture beside the canvas, to match its colours",
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
];

const EDIT_ENTRIES: &[Entry] = &[
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
        Intent::Crop,
        Menu::Edit,
        "Crop...",
        "Frames the part of the canvas that stays; Enter cuts off the rest",
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
        Intent::Pen,
        Menu::Edit,
        "Pen...",
        "Pressure curve, stabiliser, and tilt and twist of single brushes, with a field to try them",
        &[key(Modifiers::SHIFT, Key::P)],
    ),
    entry(
        Intent::BrushSets,
        Menu::Edit,
        "Own brushes...",
        "Sets of kept brushes: use, keep, order, export and import them",
        &[key(Modifiers::SHIFT, Key::B)],
    ),
    entry(
        Intent::Preferences,
        Menu::Edit,
        "Preferences...",
        "Autosave, undo memory, backend, sizes, and settings of pens and mice",
        &[key(CTRL, Key::Comma)],
    ),
];

const VIEW_ENTRIES: &[Entry] = &[
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
        Intent::ReferenceOver,
        Menu::View,
        "Reference over the canvas",
        "Lays the pinned picture over the canvas, to draw after; it is never painted",
        &[key(NONE, Key::O)],
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
        Intent::StandardLayout,
        Menu::View,
        "Standard layout",
        "Puts all panels back to their usual places and sizes",
        &[],
    ),
    entry(
        Intent::Theme(ThemeChoice::Dark),
        Menu::View,
        "Dark theme",
        "Light text on dark panels",
        &[],
    ),
    entry(
        Intent::Theme(ThemeChoice::Light),
        Menu::View,
        "Light theme",
        "Dark text on light panels",
        &[],
    ),
    entry(
        Intent::Theme(ThemeChoice::System),
        Menu::View,
        "Theme of the system",
        "Dark or light, as the system prefers",
        &[],
    ),
    entry(
        Intent::TouchTargets,
        Menu::View,
        "Large targets for touch",
        "Makes all buttons, rows and handles at least 44 points high and wide",
        &[],
    ),
    entry(
        Intent::LargerInterface,
        Menu::View,
        "Larger interface",
        "Enlarges text and controls, as far as they fit into the window",
        &[],
    ),
    entry(
        Intent::SmallerInterface,
        Menu::View,
        "Smaller interface",
        "Reduces text and controls",
        &[],
    ),
];

const TOOLS_ENTRIES: &[Entry] = &[
    entry(
        Intent::Tool(Mode::Paint),
        Menu::Tools,
        "Paint",
        "The pen paints with the brush",
        &[key(NONE, Key::B)],
    ),
    entry(
        Intent::Tool(Mode::Blend),
        Menu::Tools,
        "Blend",
        "The pen softens and mixes wet paint with the clean head of the brush",
        &[key(NONE, Key::N)],
    ),
    entry(
        Intent::Tool(Mode::Scrape),
        Menu::Tools,
        "Scrape",
        "The pen scrapes wet paint off, down to a height; a knife scrapes with a straight edge",
        &[key(NONE, Key::S)],
    ),
    entry(
        Intent::Tool(Mode::Erase),
        Menu::Tools,
        "Erase",
        "The pen rubs wet paint off, as with a rag",
        &[key(NONE, Key::E)],
    ),
    entry(
        Intent::Tool(Mode::Mask),
        Menu::Tools,
        "Mask",
        "The pen draws what a mask leaves open; with shift a rectangle",
        &[key(NONE, Key::K)],
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
    entry(
        Intent::QuickPalette,
        Menu::Tools,
        "Quick palette",
        "Opens tubes, mixtures and brush sizes at the pointer; so does the right button on the canvas",
        &[key(NONE, Key::C)],
    ),
    entry(
        Intent::DrawingAids,
        Menu::Tools,
        "Drawing aids...",
        "Ruler, perspective and symmetry with their handles and settings",
        &[key(SHIFT, Key::G)],
    ),
    entry(
        Intent::Ruler,
        Menu::Tools,
        "Ruler",
        "Shows a line or an ellipse that strokes keep to",
        &[key(NONE, Key::U)],
    ),
    entry(
        Intent::Perspective,
        Menu::Tools,
        "Perspective",
        "Shows vanishing points that strokes run to",
        &[key(NONE, Key::V)],
    ),
    entry(
        Intent::Snapping,
        Menu::Tools,
        "Strokes follow the guide",
        "Leads strokes along ruler or perspective; otherwise they are only shown",
        &[key(NONE, Key::G)],
    ),
    entry(
        Intent::Symmetry,
        Menu::Tools,
        "Symmetry",
        "Paints each stroke again when it ends, mirrored or turned",
        &[key(NONE, Key::Y)],
    ),
];

const HELP_ENTRIES: &[Entry] = &[
    entry(Intent::Keys, Menu::Help, "Keys", "Shows and changes keys", &[key(NONE, Key::F1)]),
    entry(
        Intent::FirstSteps,
        Menu::Help,
        "First steps",
        "Shows a few lines over canvas, palette and tubes until the next stroke",
        &[],
    ),
    entry(
        Intent::Tour,
        Menu::Help,
        "Guided tour",
        "Six steps to try: load, paint, mix, dry, glaze and relight; goes on where it was left",
        &[],
    ),
];

/// Keys that select a brush of the list.
const NUMBERS: [Key; 9] = [
    Key::Num1,
    Key::Num2,
    Key::Num3,
    Key::Num4,
    Key::Num5,
    Key::Num6,
    Key::Num7,
    Key::Num8,
    Key::Num9,
];

/// All actions of the easel with their standard keys: the entries, and the brushes of the list.
#[must_use]
pub fn key_rows() -> Vec<KeyRow> {
    let entries = entries().map(|entry| {
        let (name, group) = (entry.intent.name(), entry.menu.name());
        KeyRow::new(name, tr(entry.name), tr(entry.description), tr(group), entry.shortcuts)
    });
    let brushes = (1_u8..).zip(NUMBERS).map(|(number, key)| {
        let name = Intent::Brush(number).name();
        let title = tr_format!("Brush {number}", number);
        let description = tr_format!("Selects brush {number} of the list", number);
        KeyRow::new(
            name,
            title,
            description,
            tr("Brushes"),
            &[Shortcut { modifiers: Modifiers::NONE, key }],
        )
    });
    entries.chain(brushes).collect()
}

/// The intent of this name, if there is one.
#[must_use]
pub(super) fn intent_named(name: &str) -> Option<Intent> {
    let brushes = (1_u8..=9).map(Intent::Brush);
    let mut intents = entries().map(|entry| entry.intent).chain(brushes);
    intents.find(|intent| intent.name() == name)
}

#[cfg(test)]
mod tests {
    //! Tests of the shortcuts of the menu entries.

    use super::{entries, *};
    use crate::app::intent::{Entry, Intent};
    use crate::panels::Mode;
    use eframe::egui::{Context, Key, Modifiers};

    #[test]
    fn every_action_has_a_name_of_its_own_by_which_it_is_found() {
        let rows = key_rows();
        for (at, row) in rows.iter().enumerate() {
            let intent = intent_named(&row.name).unwrap();
            assert_eq!(intent.name(), row.name);
            assert!(!rows[..at].iter().any(|other| other.name == row.name), "{}", row.name);
        }
        // You find these names in preferences, so they must stay.
        for (intent, name) in [
            (Intent::SaveAs, "save-as"),
            (Intent::OtherLight, "other-light"),
            (Intent::Tool(Mode::Paint), "tool-paint"),
            (Intent::Tool(Mode::Rotate), "tool-rotate"),
            (Intent::Brush(3), "brush-3"),
            (Intent::FullScreen, "full-screen"),
        ] {
            assert_eq!((intent.name().as_str(), intent_named(name)), (name, Some(intent)));
        }
        assert_eq!(intent_named("fly"), None);
    }

    const NONE: Modifiers = Modifiers::NONE;
    const CTRL: Modifiers = Modifiers::COMMAND;
    const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

    #[test]
    fn no_shortcut_has_two_entries() {
        let mut seen: Vec<String> = Vec::new();
        for entry in entries() {
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
        assert_eq!(redo.shortcut_text(&Context::default()), "Ctrl+Shift+Z");
        // On many keyboards plus needs shift.
        let held = Modifiers { shift: true, ..NONE };
        let plus = Entry::of(Intent::ZoomIn).unwrap().shortcuts[2];
        assert!(plus.matches(Key::Plus, held), "{plus:?}");
    }
}
