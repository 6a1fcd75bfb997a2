//! Actions of the easel as rows of the table of keys.

use eframe::egui::{Key, Modifiers};

use super::entries::entries;
use super::intent::Intent;
use crate::keymap::{KeyRow, Shortcut};
use crate::language::{tr, tr_format};

/// Keys of the brushes of the list.
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
    use crate::panels::Mode;

    use super::*;

    #[test]
    fn every_action_has_a_name_of_its_own_by_which_it_is_found() {
        let rows = key_rows();
        for (at, row) in rows.iter().enumerate() {
            let intent = intent_named(&row.name).unwrap();
            assert_eq!(intent.name(), row.name);
            assert!(!rows[..at].iter().any(|other| other.name == row.name), "{}", row.name);
        }
        // Preferences of painters hold these: they must stay.
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
}
