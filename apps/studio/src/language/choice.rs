//! The languages, and which of them the system speaks.

use serde::{Deserialize, Serialize};

/// A language of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// The texts as they stand in the sources.
    #[default]
    English,
    /// The texts of `german.json`.
    German,
}

impl Language {
    /// Every language, in the order in which the preferences list them.
    pub const ALL: [Self; 2] = [Self::English, Self::German];

    /// Name of the language in itself.
    #[must_use]
    pub fn own_name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::German => "Deutsch",
        }
    }

    /// The language that the environment variables `LC_ALL`, `LC_MESSAGES` and `LANG` name: the
    /// first that is not empty decides. English if none names a language of the window.
    #[must_use]
    pub fn of_environment() -> Self {
        Self::of_locales(["LC_ALL", "LC_MESSAGES", "LANG"].map(|name| std::env::var(name).ok()))
    }

    /// The language of a name such as `de-AT`.
    #[must_use]
    pub fn of_name(name: &str) -> Self {
        Self::of_locales([Some(name.to_owned()), None, None])
    }

    /// The language of the first name that is not empty, such as `de_AT.UTF-8`.
    fn of_locales(names: [Option<String>; 3]) -> Self {
        let name = names.into_iter().flatten().find(|name| !name.is_empty());
        let word = name.as_deref().and_then(|name| name.split(['_', '.', '@', '-']).next());
        if word == Some("de") { Self::German } else { Self::English }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_name_that_is_not_empty_decides() {
        let language = |names: [&str; 3]| {
            Language::of_locales(names.map(|name| Some(name.to_owned()).filter(|_| name != "-")))
        };
        assert_eq!(language(["-", "-", "-"]), Language::English);
        assert_eq!(language(["-", "-", "de_AT.UTF-8"]), Language::German);
        assert_eq!(language(["", "de", "en_GB.UTF-8"]), Language::German);
        assert_eq!(language(["C", "de_DE", "de_DE"]), Language::English);
        assert_eq!(language(["-", "-", "den_CA"]), Language::English, "Slavey is not German");
    }
}
