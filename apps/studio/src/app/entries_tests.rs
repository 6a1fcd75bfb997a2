//! Tests of the shortcuts of the menu entries.

use eframe::egui::{Context, Key, Modifiers};

use super::entries::entries;
use super::intent::{Entry, Intent};

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
