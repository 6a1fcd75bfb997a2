//! A key with its modifiers, and its text.

use std::str::FromStr;

use eframe::egui::{Key, Modifiers};

use crate::language::english;

/// Keys whose sign is shorter than their name.
const SIGNS: [(Key, &str); 16] = [
    (Key::OpenBracket, "["),
    (Key::CloseBracket, "]"),
    (Key::Plus, "+"),
    (Key::Minus, "-"),
    (Key::Comma, ","),
    (Key::Period, "."),
    (Key::Equals, "="),
    (Key::Colon, ":"),
    (Key::Semicolon, ";"),
    (Key::Backslash, "\\"),
    (Key::Slash, "/"),
    (Key::Pipe, "|"),
    (Key::Questionmark, "?"),
    (Key::Exclamationmark, "!"),
    (Key::Backtick, "`"),
    (Key::Quote, "'"),
];

/// A keyboard shortcut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shortcut {
    /// Modifier keys; `COMMAND` is Ctrl, on a Mac the command key.
    pub modifiers: Modifiers,
    /// Key that triggers it.
    pub key: Key,
}

/// The reason why a key cannot be a shortcut, or a text is none.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum InvalidShortcut {
    /// A word of the text is no key and no modifier.
    #[error("`{0}` is no key")]
    Unknown(String),
    /// The key has a meaning that cannot be changed.
    #[error("{0}")]
    Reserved(&'static str),
}

impl Shortcut {
    /// The shortcut of a pressed key.
    ///
    /// # Errors
    /// `InvalidShortcut` if the key or a modifier has a meaning of its own.
    pub fn of_press(key: Key, held: Modifiers) -> Result<Self, InvalidShortcut> {
        let reserved = |why| Err(InvalidShortcut::Reserved(why));
        match key {
            Key::Space => reserved(english("the space bar moves the view while it is held")),
            Key::Escape => reserved(english("Escape closes windows")),
            Key::Enter => reserved(english("Enter presses the main button of a dialog")),
            Key::Copy | Key::Cut | Key::Paste => {
                reserved(english("the system uses it for the clipboard"))
            }
            _ if held.alt => reserved(english("Alt picks a colour while it is held")),
            _ => {
                let mut modifiers = Modifiers::NONE;
                (modifiers.command, modifiers.shift) = (held.command, held.shift);
                Ok(Self { modifiers, key })
            }
        }
    }

    /// Text of the shortcut as this system names it, such as `Ctrl+Z`.
    #[must_use]
    pub fn text(&self) -> String {
        self.words(if cfg!(target_os = "macos") { "Cmd" } else { "Ctrl" })
    }

    /// Text of the shortcut in files, where it does not depend on the system.
    #[must_use]
    pub fn stored(&self) -> String {
        self.words("Ctrl")
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

    fn words(&self, command: &'static str) -> String {
        let sign = SIGNS.iter().find(|(key, _)| *key == self.key);
        let key = sign.map_or(self.key.name(), |(_, sign)| sign);
        let modifiers = [(self.modifiers.command, command), (self.modifiers.shift, "Shift")];
        let held = modifiers.iter().filter(|(held, _)| *held).map(|(_, word)| *word);
        held.chain([key]).collect::<Vec<_>>().join("+")
    }
}

impl FromStr for Shortcut {
    type Err = InvalidShortcut;

    /// Reads a text such as `Ctrl+Shift+Z`; `Cmd` is read as `Ctrl`.
    fn from_str(text: &str) -> Result<Self, InvalidShortcut> {
        let text = text.trim();
        // The key itself may be a plus.
        let (held, key) = match text.strip_suffix('+') {
            Some(held) => (held.strip_suffix('+').unwrap_or(held), "+"),
            None => text.rsplit_once('+').unwrap_or(("", text)),
        };
        let mut modifiers = Modifiers::NONE;
        for word in held.split('+').filter(|word| !word.is_empty()) {
            match word.to_ascii_lowercase().as_str() {
                "ctrl" | "cmd" => modifiers.command = true,
                "shift" => modifiers.shift = true,
                "alt" => modifiers.alt = true,
                _ => return Err(InvalidShortcut::Unknown(word.to_owned())),
            }
        }
        let key = Key::from_name(key).ok_or_else(|| InvalidShortcut::Unknown(key.to_owned()))?;
        Self::of_press(key, modifiers)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_survives_its_text() {
        let mut tried = 0;
        for &key in Key::ALL {
            for command in [false, true] {
                for shift in [false, true] {
                    let held = Modifiers { command, shift, ..Modifiers::NONE };
                    let Ok(shortcut) = Shortcut::of_press(key, held) else { continue };
                    let text = shortcut.stored();
                    assert_eq!(text.parse(), Ok(shortcut), "{text}");
                    tried += 1;
                }
            }
        }
        assert!(tried > 300, "{tried} shortcuts");
        let command = Shortcut { modifiers: Modifiers::COMMAND, key: Key::Plus };
        assert_eq!(command.stored(), "Ctrl++");
        assert_eq!("cmd+shift+z".parse::<Shortcut>().unwrap().stored(), "Ctrl+Shift+Z");
    }

    #[test]
    fn keys_with_a_meaning_of_their_own_are_refused() {
        for text in ["Space", "Escape", "Ctrl+Enter", "Alt+K", "Ctrl+", "", "Hyper+K", "Ctrl+Kk"] {
            let read = text.parse::<Shortcut>();
            assert!(read.is_err() || text == "Ctrl+", "{text}: {read:?}");
        }
        assert_eq!("+".parse::<Shortcut>().unwrap().key, Key::Plus);
    }
}
