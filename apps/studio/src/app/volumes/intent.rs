//! Intents of the workspace of scenes, and the table of its menu entries.

use eframe::egui::{Context, Key, Modifiers, Ui};
use serde::Serialize;
use session::volumes::SceneTool;

use crate::keymap::{self, KeyRow, KeyTable, Shortcut, name_of};
use crate::language::{tr, tr_format};

/// One action in a scene, or on its window. Preferences name it as this enum does.
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
    /// Starts or stops time.
    Play,
    /// Simulates one step of time.
    Step,
    /// Goes back to the start of time.
    Start,
    /// Shows the volumes, or the final picture.
    Volumes,
    /// Switches hatching on or off.
    Hatching,
    /// Dries all paint.
    DryAll,
    /// Fills the tubes from a library.
    Library,
    /// Changes what you see inside the volumes.
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
    /// Shortcuts. The first stands beside the name.
    pub shortcuts: &'static [Shortcut],
}

impl SceneIntent {
    /// Name of its keys in preferences, e.g. `scene.step` or `scene.tool-pour`.
    #[must_use]
    pub fn name(self) -> String {
        format!("scene.{}", name_of(&self))
    }

    pub(super) fn repeats(self) -> bool {
        matches!(self, Self::Step | Self::More | Self::Less | Self::Undo)
    }

    /// Intent of a key press with these keys, if any.
    #[must_use]
    pub(super) fn of_key(table: &KeyTable, key: Key, modifiers: Modifiers) -> Option<Self> {
        let name = &table.find(key, modifiers)?.name;
        let tubes = (1_u8..=8).map(Self::Tube);
        let mut intents = SCENE_ENTRIES.iter().map(|entry| entry.intent).chain(tubes);
        intents.find(|intent| intent.name() == *name)
    }
}

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

const fn key(modifiers: Modifiers, key: Key) -> Shortcut {
    Shortcut { modifiers, key }
}

const fn entry(
    intent: SceneIntent,
    menu: SceneMenu,
    name: &'static str,
    description: &'static str,
    shortcuts: &'static [Shortcut],
) -> SceneEntry {
    SceneEntry { intent, menu, name, description, shortcuts }
}

/// All entries in menu order.
pub const SCENE_ENTRIES: &[SceneEntry] = &[
    entry(
        SceneIntent::New,
        SceneMenu::File,
        "New scene",
        "Begins a scene on the village that comes with the program",
        &[key(CTRL, Key::N)],
    ),
    entry(
        SceneIntent::Open,
        SceneMenu::File,
        "Open scene...",
        "Opens a model (.glb, .obj, .ply), a photograph or a script (.toml)",
        &[key(CTRL, Key::O)],
    ),
    entry(
        SceneIntent::Save,
        SceneMenu::File,
        "Save script...",
        "Saves all that was done as a script that plays it again",
        &[key(CTRL, Key::S)],
    ),
    entry(
        SceneIntent::Library,
        SceneMenu::File,
        "Open library...",
        "Fills the tubes from a pigment library (.json); what was poured is paint of its pigments",
        &[key(CTRL, Key::L)],
    ),
    entry(
        SceneIntent::Easel,
        SceneMenu::File,
        "Back to the easel",
        "Shows the painting on the easel; the scene stays as it is",
        &[key(CTRL, Key::E)],
    ),
    entry(SceneIntent::Quit, SceneMenu::File, "Quit", "Closes the program", &[key(CTRL, Key::Q)]),
    entry(
        SceneIntent::Undo,
        SceneMenu::Edit,
        "Undo",
        "Takes back the last event, and replays the scene without it",
        &[key(CTRL, Key::Z)],
    ),
    entry(
        SceneIntent::Play,
        SceneMenu::Edit,
        "Play or pause",
        "Lets time run, or stops it",
        &[key(NONE, Key::P)],
    ),
    entry(
        SceneIntent::Step,
        SceneMenu::Edit,
        "One step",
        "Takes one step of 1/120 s",
        &[key(NONE, Key::Period)],
    ),
    entry(
        SceneIntent::Start,
        SceneMenu::Edit,
        "From the start",
        "Goes to the start; drag the time bar for any other moment",
        &[key(NONE, Key::R)],
    ),
    entry(
        SceneIntent::More,
        SceneMenu::Edit,
        "Pour more",
        "Pours more paint in a second",
        &[key(NONE, Key::CloseBracket)],
    ),
    entry(
        SceneIntent::Less,
        SceneMenu::Edit,
        "Pour less",
        "Pours less paint in a second",
        &[key(NONE, Key::OpenBracket)],
    ),
    entry(
        SceneIntent::Preferences,
        SceneMenu::Edit,
        "Preferences...",
        "Theme, sizes, autosave, and settings of pens and mice",
        &[key(CTRL, Key::Comma)],
    ),
    entry(
        SceneIntent::Volumes,
        SceneMenu::View,
        "Show volumes",
        "Shows the volumes themselves, or the final picture",
        &[key(NONE, Key::V)],
    ),
    entry(
        SceneIntent::Hatching,
        SceneMenu::View,
        "Hatching",
        "Shows the light by pencil strokes",
        &[key(NONE, Key::H)],
    ),
    entry(
        SceneIntent::Inside,
        SceneMenu::View,
        "Inside: next",
        "Own colours, a glaze of the pigments, or both inside of the volumes",
        &[key(NONE, Key::G)],
    ),
    entry(
        SceneIntent::Frame,
        SceneMenu::View,
        "Whole scene",
        "Frames the whole scene",
        &[key(NONE, Key::Home), key(CTRL, Key::Num0)],
    ),
    entry(
        SceneIntent::Panels,
        SceneMenu::View,
        "Panels",
        "Shows or hides all panels",
        &[key(NONE, Key::Tab)],
    ),
    entry(
        SceneIntent::FullScreen,
        SceneMenu::View,
        "Full screen",
        "Toggles full screen",
        &[key(NONE, Key::F11)],
    ),
    entry(
        SceneIntent::Tool(SceneTool::Pour),
        SceneMenu::Tools,
        "Pour",
        "The pen pours the tube in hand where it is held",
        &[key(NONE, Key::Q)],
    ),
    entry(
        SceneIntent::Tool(SceneTool::Push),
        SceneMenu::Tools,
        "Push",
        "The pen blows paint along the drag",
        &[key(NONE, Key::W)],
    ),
    entry(
        SceneIntent::Tool(SceneTool::Lift),
        SceneMenu::Tools,
        "Lift",
        "The pen takes paint up, as a sponge does",
        &[key(NONE, Key::E)],
    ),
    entry(
        SceneIntent::Tool(SceneTool::Dry),
        SceneMenu::Tools,
        "Dry",
        "The pen dries the volumes below it, paint and shape",
        &[key(NONE, Key::D)],
    ),
    entry(
        SceneIntent::DryAll,
        SceneMenu::Tools,
        "Dry all paint",
        "Dries all paint and its shape at once",
        &[key(Modifiers::SHIFT, Key::D)],
    ),
    entry(
        SceneIntent::Keys,
        SceneMenu::Help,
        "Keys",
        "Shows and changes keys",
        &[key(NONE, Key::F1)],
    ),
];

/// Effects of the pointer, and keys that are in no menu.
pub(in crate::app) const SCENE_POINTER: &[(&str, &str)] = &[
    ("Hold or draw", "Uses the tool in hand; pressure sets the rate"),
    ("Middle button", "Turns the scene"),
    ("Shift + middle", "Moves the scene"),
    ("pointer|Wheel", "Zooms about the pointer"),
    ("Right click", "Tells what is there: paint, height, colour, region"),
    ("Drag the time bar", "Goes to a moment, which is replayed to the bit"),
];

impl SceneEntry {
    /// The entry of an intent, if it has one.
    #[must_use]
    pub fn of(intent: SceneIntent) -> Option<&'static Self> {
        SCENE_ENTRIES.iter().find(|entry| entry.intent == intent)
    }

    /// Text of the entry's first key in use, or an empty text if it has none. Before you install
    /// any keys, this is its first standard key.
    #[must_use]
    pub fn shortcut_text(&self, context: &Context) -> String {
        keymap::text(context, &self.intent.name())
            .unwrap_or_else(|| self.shortcuts.first().map_or_else(String::new, Shortcut::text))
    }
}

const TUBES: [Key; 8] =
    [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8];

/// All actions of scenes with their standard keys: the entries, and the tubes.
#[must_use]
pub fn scene_key_rows() -> Vec<KeyRow> {
    let entries = SCENE_ENTRIES.iter().map(|entry| {
        let (name, group) = (entry.intent.name(), entry.menu.name());
        KeyRow::new(name, tr(entry.name), tr(entry.description), tr(group), entry.shortcuts)
    });
    let tubes = (1_u8..).zip(TUBES).map(|(number, key)| {
        let name = SceneIntent::Tube(number).name();
        let title = tr_format!("Tube {number}", number);
        let description = tr_format!("Takes tube {number} in hand", number);
        KeyRow::new(name, title, description, tr("Tubes"), &[self::key(NONE, key)])
    });
    entries.chain(tubes).collect()
}

/// Tooltip of an entry: name, shortcut and description.
pub(super) fn tip(ui: &mut Ui, entry: &SceneEntry) {
    ui.horizontal(|ui| {
        ui.strong(tr(entry.name));
        ui.weak(entry.shortcut_text(ui.ctx()));
    });
    ui.label(tr(entry.description));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_shortcut_has_two_entries_and_every_key_is_found() {
        let table = KeyTable::new(scene_key_rows());
        let mut seen: Vec<String> = Vec::new();
        for entry in SCENE_ENTRIES {
            for shortcut in entry.shortcuts {
                let text = shortcut.text();
                assert!(!seen.contains(&text), "{text} of {} is taken", entry.name);
                let found = SceneIntent::of_key(&table, shortcut.key, shortcut.modifiers);
                assert_eq!(found, Some(entry.intent), "{text}");
                seen.push(text);
            }
        }
        assert!(seen.len() > 20, "{seen:?}");
        assert_eq!(SceneIntent::of_key(&table, Key::Num8, NONE), Some(SceneIntent::Tube(8)));
        assert_eq!(SceneIntent::of_key(&table, Key::Num9, NONE), None, "there are eight tubes");
    }

    #[test]
    fn every_key_does_what_the_table_of_keys_says() {
        let table = KeyTable::new(scene_key_rows());
        const SHIFT: Modifiers = Modifiers::SHIFT;
        let keys = [
            (NONE, Key::P, SceneIntent::Play),
            (NONE, Key::Period, SceneIntent::Step),
            (NONE, Key::R, SceneIntent::Start),
            (NONE, Key::V, SceneIntent::Volumes),
            (NONE, Key::H, SceneIntent::Hatching),
            (NONE, Key::G, SceneIntent::Inside),
            (NONE, Key::OpenBracket, SceneIntent::Less),
            (NONE, Key::CloseBracket, SceneIntent::More),
            (NONE, Key::Home, SceneIntent::Frame),
            (NONE, Key::Q, SceneIntent::Tool(SceneTool::Pour)),
            (NONE, Key::W, SceneIntent::Tool(SceneTool::Push)),
            (NONE, Key::E, SceneIntent::Tool(SceneTool::Lift)),
            (NONE, Key::D, SceneIntent::Tool(SceneTool::Dry)),
            (SHIFT, Key::D, SceneIntent::DryAll),
            (NONE, Key::Tab, SceneIntent::Panels),
            (NONE, Key::F1, SceneIntent::Keys),
            (NONE, Key::F11, SceneIntent::FullScreen),
            (CTRL, Key::Z, SceneIntent::Undo),
            (CTRL, Key::N, SceneIntent::New),
            (CTRL, Key::O, SceneIntent::Open),
            (CTRL, Key::S, SceneIntent::Save),
            (CTRL, Key::L, SceneIntent::Library),
            (CTRL, Key::E, SceneIntent::Easel),
            (CTRL, Key::Q, SceneIntent::Quit),
            (CTRL, Key::Comma, SceneIntent::Preferences),
        ];
        for (modifiers, key, wanted) in keys {
            let found = SceneIntent::of_key(&table, key, modifiers);
            assert_eq!(found, Some(wanted), "{modifiers:?} {key:?}");
        }
        let with_keys = SCENE_ENTRIES.iter().filter(|entry| !entry.shortcuts.is_empty());
        assert_eq!(with_keys.count(), keys.len(), "each entry is here");
    }
}
