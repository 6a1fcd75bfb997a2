//! A value that is edited: its past for undo, and what is in its file.

/// Most states that undo returns to.
const MOST_PAST: usize = 200;

/// A value with its past states and the state that was last saved or opened.
#[derive(Debug, Clone, Default)]
pub(super) struct Edited<T> {
    now: T,
    past: Vec<T>,
    saved: T,
}

impl<T: Clone + PartialEq> Edited<T> {
    /// The current value.
    pub(super) fn now(&self) -> &T {
        &self.now
    }

    /// Changes the value, as one step of undo.
    pub(super) fn change(&mut self, change: impl FnOnce(&mut T)) {
        let before = self.now.clone();
        change(&mut self.now);
        if self.now != before {
            self.past.push(before);
            let excess = self.past.len().saturating_sub(MOST_PAST);
            self.past.drain(..excess);
        }
    }

    /// Changes the value without a step of undo.
    pub(super) fn adjust(&mut self, change: impl FnOnce(&mut T)) {
        change(&mut self.now);
    }

    /// Whether there is a change to undo.
    pub(super) fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Returns to the value before the last change; whether there was one.
    pub(super) fn undo(&mut self) -> bool {
        let before = self.past.pop();
        let undone = before.is_some();
        self.now = before.unwrap_or_else(|| self.now.clone());
        undone
    }

    /// Starts with a value from a file.
    pub(super) fn open(&mut self, value: T) {
        *self = Self { now: value.clone(), past: Vec::new(), saved: value };
    }

    /// Takes note that `value` is in a file.
    pub(super) fn saved(&mut self, value: T) {
        self.saved = value;
    }

    /// Whether the value differs from what is in a file.
    pub(super) fn is_unsaved(&self) -> bool {
        self.now != self.saved
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn undo_returns_to_each_state_and_tells_what_is_saved() {
        let mut lines: Edited<Vec<u8>> = Edited::default();
        lines.change(|lines| lines.push(1));
        lines.change(|_| {});
        lines.change(|lines| lines.push(2));
        assert!(lines.is_unsaved() && lines.can_undo());
        lines.saved(vec![1, 2]);
        assert!(!lines.is_unsaved());
        assert!(lines.undo());
        assert_eq!(lines.now(), &[1]);
        assert!(lines.is_unsaved(), "the file has more");
        assert!(lines.undo() && !lines.undo(), "there were two changes");
        lines.open(vec![7]);
        assert!(!lines.is_unsaved() && !lines.can_undo());
        for number in 0..300 {
            lines.change(|lines| lines[0] = (number % 250) as u8);
        }
        assert_eq!((0..400).filter(|_| lines.undo()).count(), MOST_PAST);
    }
}
