//! One history over two paintings.

use std::collections::VecDeque;

use crate::strokes::SurfaceId;

/// Where a brush's paint was before an action, and after it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Carried {
    pub(super) tool: usize,
    pub(super) from: SurfaceId,
    pub(super) to: SurfaceId,
}

/// An action that was done.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    /// What it was, for people.
    pub(super) label: String,
    /// Whether it is an action of the history of each surface.
    pub(super) on: [bool; 2],
    pub(super) carried: Option<Carried>,
}

/// Actions, the oldest first, and how many are of each surface.
#[derive(Debug, Default)]
pub(super) struct Entries {
    entries: VecDeque<Entry>,
    on: [usize; 2],
}

impl Entries {
    pub(super) fn push(&mut self, entry: Entry) {
        for (count, on) in self.on.iter_mut().zip(entry.on) {
            *count += usize::from(on);
        }
        self.entries.push_back(entry);
    }

    pub(super) fn pop(&mut self) -> Option<Entry> {
        let entry = self.entries.pop_back()?;
        self.left(&entry);
        Some(entry)
    }

    fn left(&mut self, entry: &Entry) {
        for (count, on) in self.on.iter_mut().zip(entry.on) {
            *count -= usize::from(on);
        }
    }

    /// Forgets those farthest from now, until no painting has fewer of them than
    /// the `kept` that it still knows.
    fn forget(&mut self, kept: [usize; 2]) {
        while self.on.iter().zip(kept).any(|(&told, kept)| told > kept) {
            let Some(farthest) = self.entries.pop_front() else { return };
            self.left(&farthest);
        }
    }

    pub(super) fn len(&self) -> usize {
        self.entries.len()
    }
}

/// What was done, and what was taken back.
#[derive(Debug, Default)]
pub(super) struct SharedHistory {
    pub(super) done: Entries,
    /// Taken back; what a redo does next comes last.
    pub(super) undone: Entries,
}

impl SharedHistory {
    /// Something new was done.
    pub(super) fn add(&mut self, entry: Entry) {
        self.undone = Entries::default();
        self.done.push(entry);
    }

    /// Follows what the paintings still know: how many actions each can undo, and
    /// redo. More than are told here are older than all of these.
    pub(super) fn follow(&mut self, undo: [usize; 2], redo: [usize; 2]) {
        self.done.forget(undo);
        self.undone.forget(redo);
    }

    /// Labels of all that can be reached, in the order of doing.
    pub(super) fn labels(&self) -> Vec<&str> {
        let undone = self.undone.entries.iter().rev();
        self.done.entries.iter().chain(undone).map(|entry| entry.label.as_str()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(label: &str, on: [bool; 2]) -> Entry {
        Entry { label: label.to_owned(), on, carried: None }
    }

    #[test]
    fn what_one_painting_forgot_hides_all_before_it() {
        let mut history = SharedHistory::default();
        history.add(entry("a", [true, false]));
        history.add(entry("b", [false, true]));
        history.add(entry("c", [true, true]));
        history.add(entry("d", [true, false]));
        history.follow([3, 2], [0, 0]);
        assert_eq!(history.labels(), ["a", "b", "c", "d"], "all is known");
        // The palette forgot `b`, so `a` cannot be reached, though the canvas knows it.
        history.follow([3, 1], [0, 0]);
        assert_eq!(history.labels(), ["c", "d"]);
        // That the canvas forgets `a` as well changes nothing.
        history.follow([2, 1], [0, 0]);
        assert_eq!(history.labels(), ["c", "d"]);
        history.follow([1, 1], [0, 0]);
        assert_eq!(history.labels(), ["d"]);
    }

    #[test]
    fn what_can_be_done_again_is_forgotten_from_its_far_end() {
        let mut history = SharedHistory::default();
        for label in ["a", "b", "c"] {
            history.add(entry(label, [true, label == "b"]));
        }
        for _ in 0..3 {
            let entry = history.done.pop().expect("there are three");
            history.undone.push(entry);
        }
        assert_eq!(history.labels(), ["a", "b", "c"]);
        history.follow([0, 0], [3, 0]);
        assert_eq!(history.labels(), ["a"], "`b` is lost, and with it `c` after it");
        history.add(entry("d", [true, false]));
        assert_eq!((history.labels(), history.undone.len()), (vec!["d"], 0));
    }
}
