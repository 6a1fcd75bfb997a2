//! The language that a thread speaks. Only the thread of the window draws; all others speak
//! English, as the tests do.

use std::cell::Cell;
use std::sync::OnceLock;

use super::choice::Language;

thread_local! {
    static SPOKEN: Cell<Language> = const { Cell::new(Language::English) };
}

/// The language of the system, once the program has told it.
static SYSTEM: OnceLock<Language> = OnceLock::new();

/// Tells the language of the system, once, when the program starts. Libraries and tests, which
/// do not tell it, speak English whatever the environment.
pub fn set_system(language: Language) {
    // Only the first call counts.
    let _ = SYSTEM.set(language);
}

/// Makes this thread speak the chosen language, or that of the system where none was chosen.
pub fn speak(chosen: Option<Language>) {
    let system = SYSTEM.get().copied().unwrap_or_default();
    SPOKEN.set(chosen.unwrap_or(system));
}

/// The language that this thread speaks.
#[must_use]
pub fn spoken() -> Language {
    SPOKEN.get()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thread_speaks_english_until_another_language_is_chosen_for_it() {
        assert_eq!(spoken(), Language::English);
        speak(Some(Language::German));
        assert_eq!(spoken(), Language::German);
        assert_eq!(std::thread::spawn(spoken).join().unwrap(), Language::English);
        speak(None);
        assert_eq!(spoken(), Language::English, "no program has told the system's");
    }
}
