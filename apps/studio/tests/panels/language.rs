//! Tests of the languages: every text of the sources has a translation, and you can read all of the
//! German window.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use eframe::egui::{Key, Modifiers, Vec2, vec2};
use egui_kittest::kittest::Queryable;
use paint::document::Lighting;
use paint::strokes::{Action, Recipe, Squeeze, SurfaceId};
use session::Command;
use studio::app::Tab;
use studio::language::{Language, PAINTS, PATTERNS, Table, WORDS, placeholders, table};
use studio::panels::Mode;
use studio::theme::ThemeChoice;

use super::fixture::targets;
use super::harness::Window;
use super::look::{check, cut, set_look};
use super::volumes::scene;

/// Sources that hold English texts in tables and translate them where they show them. Each text in
/// them needs a translation. All other sources mark their texts with `tr`, `tr_format!` or
/// `english`.
const TABLES: [&str; 10] = [
    "app/crop.rs",
    "app/entries.rs",
    "app/guide.rs",
    "app/intent.rs",
    "app/perform.rs",
    "app/side.rs",
    "app/volumes/bars.rs",
    "app/volumes/intent.rs",
    "app/volumes/workspace.rs",
    "files/new_canvas.rs",
];

/// Code before the texts that you never see in these sources: for example names of widgets and
/// labels of the history.
const UNSEEN: [&str; 7] = [
    "Id::unique(",
    "Id::unique((",
    "from_id_salt(",
    "strip_prefix(",
    "count(",
    "format!(",
    "skip_serializing_if =",
];

/// All sources of the studio, by their paths below `src`.
fn sources() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut folders: Vec<PathBuf> = vec![root.clone()];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let below = path.strip_prefix(&root).unwrap();
                let name = below.to_str().unwrap().replace('\\', "/");
                found.push((name, std::fs::read_to_string(&path).unwrap()));
            }
        }
    }
    found.sort();
    found
}

/// The string literals of a source without its tests. Each comes with the code before and after it.
fn literals(source: &str) -> Vec<(&str, String, &str)> {
    let source = source.split("#[cfg(test)]").next().unwrap_or_default();
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(offset) = source[at..].find(['"', '/', '\'']) {
        let start = at + offset;
        let rest = &source[start..];
        if rest.starts_with("//") {
            at = start + rest.find('\n').unwrap_or(rest.len());
        } else if rest.starts_with("'\"'") || rest.starts_with("'\\\"'") {
            at = start + rest[1..].find('\'').unwrap() + 2;
        } else if rest.starts_with('"') {
            let end = closing(rest);
            found.push((&source[..start], text(&rest[1..end]), &rest[end + 1..]));
            at = start + end + 1;
        } else {
            at = start + 1;
        }
    }
    found
}

/// Index of the quotation mark that ends a string literal.
fn closing(rest: &str) -> usize {
    let mut escaped = false;
    for (at, letter) in rest.char_indices().skip(1) {
        match letter {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return at,
            _ => {}
        }
    }
    panic!("a text has no end: {}", &rest[..rest.len().min(80)]);
}

/// The text of a literal. This resolves escapes and joins continued lines.
fn text(literal: &str) -> String {
    let mut found = String::new();
    let mut rest = literal;
    while let Some((before, after)) = rest.split_once('\\') {
        found.push_str(before);
        rest = match after.chars().next().unwrap() {
            'n' => {
                found.push('\n');
                &after[1..]
            }
            'u' => {
                let (code, after) = after[2..].split_once('}').unwrap();
                found.push(char::from_u32(u32::from_str_radix(code, 16).unwrap()).unwrap());
                after
            }
            '\n' => after.trim_start(),
            'x' => &after[3..],
            letter => {
                found.push(letter);
                &after[letter.len_utf8()..]
            }
        };
    }
    found + rest
}

/// Whether you see a text of a table in the window. It has a word, and is not a name, e.g.
/// `save-as`.
fn is_shown(text: &str) -> bool {
    let units = ["mm", "cm", "Cmd", "Ctrl", "Shift", "Alt"];
    let mut words = text.split(|letter: char| !letter.is_ascii_alphabetic());
    let has_word = words.any(|word| word.len() > 2 && !units.contains(&word));
    has_word && text.contains(|letter: char| letter == ' ' || letter.is_ascii_uppercase())
}

/// Whether a text is the name of a pigment in a recipe such as `[("Zinc White", 40.0)]`.
fn is_paint_with_parts(before: &str, after: &str) -> bool {
    let opens = before.strip_suffix('(').map(str::trim_end);
    let opens = opens.is_some_and(|before| before.ends_with(['[', ',']));
    let number = after.strip_prefix(", ").and_then(|rest| rest.split(')').next());
    opens && number.is_some_and(|number| number.parse::<f64>().is_ok())
}

/// Every text that the window may show, with the source that has it.
fn shown() -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = Vec::new();
    for (name, source) in sources() {
        for (before, text, after) in literals(&source) {
            let before = before.trim_end();
            let marks = ["tr(", "tr_format!(", "english("];
            let marked = marks.iter().any(|mark| {
                let Some(before) = before.strip_suffix(mark) else { return false };
                !before.ends_with(|last: char| last.is_alphanumeric() || last == '_')
            });
            let of_language = name.starts_with("language/");
            let of_table = TABLES.contains(&name.as_str())
                && is_shown(&text)
                && !UNSEEN.iter().any(|unseen| before.ends_with(unseen))
                && !is_paint_with_parts(before, after);
            if !of_language && (marked || of_table) {
                found.push((text, name.clone()));
            }
        }
    }
    let labels = PATTERNS.iter().chain(&PAINTS).chain(&WORDS);
    found.extend(labels.map(|text| ((*text).to_owned(), "language".to_owned())));
    found
}

fn german() -> &'static Table {
    table(Language::German).unwrap()
}

#[test]
fn every_text_has_a_german_one() {
    let shown = shown();
    assert!(shown.len() > 1000, "{} texts were found", shown.len());
    for name in TABLES {
        assert!(shown.iter().any(|(_, source)| source == name), "{name} holds no text");
    }
    let without = shown.iter().filter(|(text, _)| !german().contains_key(text));
    let without: Vec<String> =
        without.map(|(text, name)| format!("{}: \"\",   {name}", json(text))).collect();
    assert!(without.is_empty(), "add to german.json:\n{}", without.join("\n"));
}

/// A text as JSON.
fn json(text: &str) -> String {
    serde_json::to_string(text).unwrap()
}

#[test]
fn every_german_text_is_used() {
    let shown: BTreeSet<String> = shown().into_iter().map(|(text, _)| text).collect();
    let unused: Vec<&String> = german().keys().filter(|text| !shown.contains(*text)).collect();
    assert!(unused.is_empty(), "remove from german.json: {unused:#?}");
}

#[test]
fn german_texts_have_the_placeholders_of_the_english_ones() {
    for (english, german) in german() {
        assert_eq!(placeholders(english), placeholders(german), "{english}: {german}");
        assert_eq!(english.is_empty(), german.is_empty(), "{english}");
        for space in [char::is_whitespace, |letter: char| letter == '\n'] {
            assert_eq!(english.starts_with(space), german.starts_with(space), "{english:?}");
            assert_eq!(english.ends_with(space), german.ends_with(space), "{english:?}");
        }
    }
}

/// A German window with wet paint over a dry layer, two lights and a picked colour.
fn german_window(name: &'static str, size: Vec2) -> Window {
    let mut window = Window::sized(name, size, 1.0);
    let recipe: Recipe = [("Vermilion".to_owned(), 1.0), ("Zinc White".to_owned(), 1.0)].into();
    let on = SurfaceId::Canvas;
    let x_mm = 16.0;
    let y_mm = 10.0;
    let heap = Squeeze { on, recipe, vehicle: 0.4, x_mm, y_mm, volume_mm3: 30.0 };
    for action in [
        Action::Squeeze(heap.clone()),
        Action::Dry { fraction: 0.5 },
        Action::Dry { fraction: 1.0 },
        Action::Squeeze(heap),
        Action::Light(Lighting { illuminant: "A".to_owned(), ..Lighting::default() }),
    ] {
        window.studio_mut().ask(Command::Apply(action));
    }
    window.studio_mut().ask(Command::SetSecondLight(Some(Lighting::default())));
    window.studio_mut().ask(Command::Pick { surface: on, x_mm, y_mm, radius_mm: 0.5 });
    window.studio_mut().files.preferences.language = Some(Language::German);
    window.settle();
    window
}

#[test]
fn the_language_changes_at_once_and_every_german_letter_has_a_glyph() {
    let mut window = Window::open("german");
    assert!(window.harness().query_by_label("Wash").is_some(), "English is the standard");
    window.studio_mut().files.preferences.language = Some(Language::German);
    window.settle();
    assert!(window.harness().query_by_label("Wash").is_none());
    assert!(window.harness().query_by_label("Auswaschen").is_some());
    let menus = ["Datei", "Bearbeiten", "Ansicht", "Werkzeuge", "Hilfe"];
    for menu in menus {
        window.harness().get_all_by_label(menu).next().unwrap().click();
        window.harness().run_ok();
        check(&mut window, menu);
        window.key(Modifiers::NONE, Key::Escape);
    }
    window.key(Modifiers::NONE, Key::F1);
    assert!(check(&mut window, "the table of keys") > 60, "it is open");
    assert!(window.shows("Macht die letzte Aktion r"), "the table of keys is German too");
    window.studio_mut().files.preferences.language = Some(Language::English);
    window.settle();
    assert!(window.shows("Undoes the last action"), "and English again");
}

#[test]
fn no_german_text_is_cut_in_any_size() {
    for size in [vec2(1280.0, 800.0), vec2(1440.0, 1000.0), vec2(1920.0, 1080.0)] {
        let mut window = german_window("german-cut", size);
        for look in [(ThemeChoice::Dark, false), (ThemeChoice::Light, true)] {
            set_look(&mut window, look);
            // We show the small window in the dark theme and the larger ones in the light theme.
            let save = |window: &mut Window, name: &str| {
                if look.1 == (size.x > 1300.0) {
                    window.show(name);
                }
            };
            for mode in [Mode::Blend, Mode::Scrape, Mode::Erase, Mode::Mask, Mode::Paint] {
                window.studio_mut().panels.select(Tab::Brush);
                window.studio_mut().tools.mode = mode;
                window.harness().run_ok();
                save(&mut window, &format!("german-{}-{mode:?}", size.x));
                assert_is_whole(&mut window, size, &format!("{size} {look:?} {mode:?}"));
            }
            for tab in TABS {
                window.studio_mut().panels.select(tab);
                window.harness().step();
                window.harness().run_ok();
                save(&mut window, &format!("german-{}-{tab:?}", size.x));
                assert_is_whole(&mut window, size, &format!("{size} {look:?} {tab:?}"));
            }
        }
    }
}

/// Checks that no text is cut, and that everything clickable lies inside the window.
fn assert_is_whole(window: &mut Window, size: Vec2, place: &str) {
    let cut = cut(window);
    assert!(cut.is_empty(), "{place}: {cut:#?}");
    let mut beyond = targets(&window.harness().root());
    beyond.retain(|target| target.right > size.x - 2.0);
    assert!(beyond.is_empty(), "{place}: {beyond:#?}");
}

const TABS: [Tab; 8] = [
    Tab::Brush,
    Tab::Layers,
    Tab::Light,
    Tab::Color,
    Tab::Wheel,
    Tab::Swatches,
    Tab::History,
    Tab::Files,
];

/// Menus and entries that open a dialog or a window.
const DIALOGS: [(&str, &str); 9] = [
    ("Datei", "Neu"),
    ("Datei", "\u{d6}ffnen..."),
    ("Datei", "Exportieren..."),
    ("Datei", "Zeitraffer exportieren..."),
    ("Bearbeiten", "Zuschneiden..."),
    ("Bearbeiten", "Stift..."),
    ("Bearbeiten", "Eigene Pinsel..."),
    ("Bearbeiten", "Einstellungen..."),
    ("Hilfe", "Rundgang"),
];

#[test]
fn no_german_text_of_a_dialog_is_cut() {
    let mut window = german_window("german-dialogs", vec2(1280.0, 800.0));
    for (at, (menu, entry)) in DIALOGS.into_iter().enumerate() {
        window.harness().get_all_by_label(menu).next().unwrap().click();
        window.harness().run_steps(3);
        let before = cut(&mut window);
        window.show(&format!("german-menu-{menu}"));
        assert!(before.is_empty(), "{menu}: {before:#?}");
        // We want the control left of a control of the panels with this name.
        let named = window.harness().get_all_by_label(entry);
        let left = named.min_by(|a, b| a.rect().left().total_cmp(&b.rect().left()));
        left.unwrap().click();
        window.harness().run_steps(3);
        window.settle();
        check(&mut window, entry);
        window.show(&format!("german-dialog-{at}"));
        assert_is_whole(&mut window, vec2(1280.0, 800.0), entry);
        window.key(Modifiers::NONE, Key::Escape);
    }
}

#[test]
fn no_german_text_of_a_scene_is_cut() {
    let mut window = scene("german-scene");
    window.studio_mut().files.preferences.language = Some(Language::German);
    window.settle();
    for tab in ["Ansicht", "Licht", "Hier", "Verlauf", "Export"] {
        // This label stands after the menu of the same name.
        window.harness().get_all_by_label(tab).last().unwrap().click();
        window.harness().run_ok();
        check(&mut window, tab);
        window.show(&format!("german-scene-{tab}"));
        assert_is_whole(&mut window, vec2(1280.0, 800.0), tab);
    }
}
