//! Order of what a search finds, and the line that Enter takes.

use eframe::egui::{Key, Modifiers, Ui};

/// How well a name matches what was typed, the best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Match {
    /// It is the whole name.
    Exact,
    /// The name begins with it.
    Start,
    /// Another word of the name begins with it.
    Word,
    /// The name contains it.
    Inside,
    /// Something else that is searched contains it.
    Elsewhere,
}

impl Match {
    /// How well `name` matches `wanted`, ignoring case.
    pub(super) fn of(name: &str, wanted: &str) -> Self {
        let name = name.to_lowercase();
        let wanted = wanted.trim().to_lowercase();
        if name == wanted {
            Self::Exact
        } else if name.starts_with(&wanted) {
            Self::Start
        } else if name.match_indices(&wanted).any(|(at, _): (usize, &str)| {
            name[..at].chars().next_back().is_some_and(|before| !before.is_alphanumeric())
        }) {
            Self::Word
        } else if name.contains(&wanted) {
            Self::Inside
        } else {
            Self::Elsewhere
        }
    }
}

/// Sorts what was found: the best matches first, equal ones in the order that they had.
pub(super) fn sort<'a, T>(found: &mut [T], wanted: &str, name: impl Fn(&T) -> &'a str) {
    if !wanted.trim().is_empty() {
        found.sort_by_key(|one| Match::of(name(one), wanted));
    }
}

/// The line of a list that Enter takes; the arrow keys move it.
#[derive(Debug, Clone, Default)]
pub(super) struct Highlight {
    line: usize,
    search: String,
    /// Whether the list must scroll to the line.
    pub(super) moved: bool,
}

impl Highlight {
    /// Takes the arrow keys while the field of the search has the keyboard. Call before the field
    /// is drawn, which would move its cursor with them.
    pub(super) fn read_arrows(&mut self, ui: &Ui, focused: bool) {
        if !focused {
            return;
        }
        let pressed = |key| ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key));
        let down = pressed(Key::ArrowDown);
        let up = pressed(Key::ArrowUp);
        self.line = (self.line + down).saturating_sub(up);
        self.moved |= down + up > 0;
    }

    /// The highlighted one of `count` lines found by `search`; the first after the search changed.
    pub(super) fn among(&mut self, search: &str, count: usize) -> usize {
        if self.search != search {
            (self.line, self.moved) = (0, true);
            search.clone_into(&mut self.search);
        }
        self.line = self.line.min(count.saturating_sub(1));
        self.line
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_name_comes_before_its_beginning_and_that_before_the_rest() {
        let mut names = vec!["Cobalt", "Lead-Tin Red", "Minium red", "Predella", "Red Lead", "red"];
        sort(&mut names, "RED ", |name| name);
        let wanted = ["red", "Red Lead", "Lead-Tin Red", "Minium red", "Predella", "Cobalt"];
        assert_eq!(names, wanted);
        let mut lights = vec!["D65", "B", "A", "ID65"];
        sort(&mut lights, "a", |name| name);
        assert_eq!(lights[0], "A");
        sort(&mut lights, "", |name| name);
        assert_eq!(lights[0], "A", "no search, no order");
    }

    #[test]
    fn another_search_begins_at_the_first_line() {
        let mut highlight = Highlight { line: 4, ..Highlight::default() };
        assert_eq!(highlight.among("a", 9), 0);
        highlight.line = 7;
        assert_eq!((highlight.among("a", 9), highlight.among("a", 3)), (7, 2));
        assert_eq!(highlight.among("ab", 3), 0);
        assert_eq!(highlight.among("abc", 0), 0, "nothing was found");
    }
}
