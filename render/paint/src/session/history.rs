//! One history over the paintings of both surfaces.

use std::collections::VecDeque;

use crate::strokes::{PerSurface, SurfaceId};

/// Move of a brush with its paint from one surface to another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Carried {
    pub(super) tool: usize,
    pub(super) from: SurfaceId,
    pub(super) to: SurfaceId,
}

/// An action of the history.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    /// Label for display.
    pub(super) label: String,
    /// Whether the history of each surface has this action.
    pub(super) on: PerSurface<bool>,
    pub(super) carried: Option<Carried>,
}

/// Actions, the oldest first, and their number on each surface.
#[derive(Debug, Default)]
pub(super) struct Entries {
    entries: VecDeque<Entry>,
    on: PerSurface<usize>,
}

impl Entries {
    pub(super) fn push(&mut self, entry: Entry) {
        self.on = PerSurface::from_fn(|surface| self.on[surface] + usize::from(entry.on[surface]));
        self.entries.push_back(entry);
    }

    pub(super) fn pop(&mut self) -> Option<Entry> {
        let entry = self.entries.pop_back()?;
        self.uncount(&entry);
        Some(entry)
    }

    fn uncount(&mut self, entry: &Entry) {
        self.on = PerSurface::from_fn(|surface| self.on[surface] - usize::from(entry.on[surface]));
    }

    /// Drops the entries farthest from the present until each surface has at most `kept`,
    /// the number of actions that its painting still has.
    fn drop_farthest(&mut self, kept: PerSurface<usize>) {
        while self.on.iter().zip(kept.iter()).any(|(count, kept)| count > kept) {
            let Some(farthest) = self.entries.pop_front() else { return };
            self.uncount(&farthest);
        }
    }

    pub(super) fn len(&self) -> usize {
        self.entries.len()
    }
}

/// Actions that are done, and actions that were undone.
#[derive(Debug, Default)]
pub(super) struct SharedHistory {
    pub(super) done: Entries,
    /// Undone actions; the next redo is the last one.
    pub(super) undone: Entries,
}

impl SharedHistory {
    /// Adds a new action; the undone ones are dropped.
    pub(super) fn add(&mut self, entry: Entry) {
        self.undone = Entries::default();
        self.done.push(entry);
    }

    /// Drops the actions that a painting has dropped; `undo` and `redo` are the numbers of
    /// actions that each painting can still undo and redo.
    pub(super) fn limit_to(&mut self, undo: PerSurface<usize>, redo: PerSurface<usize>) {
        self.done.drop_farthest(undo);
        self.undone.drop_farthest(redo);
    }

    /// Labels of all actions that can be reached by undo and redo, in their order.
    pub(super) fn labels(&self) -> Vec<&str> {
        let undone = self.undone.entries.iter().rev();
        self.done.entries.iter().chain(undone).map(|entry| entry.label.as_str()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(label: &str, [canvas, palette]: [bool; 2]) -> Entry {
        let on = PerSurface { canvas, palette };
        Entry { label: label.to_owned(), on, carried: None }
    }

    fn counts([canvas, palette]: [usize; 2]) -> PerSurface<usize> {
        PerSurface { canvas, palette }
    }

    #[test]
    fn an_action_dropped_by_one_painting_drops_all_before_it() {
        let mut history = SharedHistory::default();
        history.add(entry("a", [true, false]));
        history.add(entry("b", [false, true]));
        history.add(entry("c", [true, true]));
        history.add(entry("d", [true, false]));
        history.limit_to(counts([3, 2]), counts([0, 0]));
        assert_eq!(history.labels(), ["a", "b", "c", "d"], "all is known");
        // The palette forgot `b`, so `a` cannot be reached, though the canvas knows it.
        history.limit_to(counts([3, 1]), counts([0, 0]));
        assert_eq!(history.labels(), ["c", "d"]);
        // That the canvas forgets `a` as well changes nothing.
        history.limit_to(counts([2, 1]), counts([0, 0]));
        assert_eq!(history.labels(), ["c", "d"]);
        history.limit_to(counts([1, 1]), counts([0, 0]));
        assert_eq!(history.labels(), ["d"]);
    }

    #[test]
    fn redo_is_dropped_from_its_far_end() {
        let mut history = SharedHistory::default();
        for label in ["a", "b", "c"] {
            history.add(entry(label, [true, label == "b"]));
        }
        for _ in 0..3 {
            let entry = history.done.pop().expect("there are three");
            history.undone.push(entry);
        }
        assert_eq!(history.labels(), ["a", "b", "c"]);
        history.limit_to(counts([0, 0]), counts([3, 0]));
        assert_eq!(history.labels(), ["a"], "`b` is lost, and with it `c` after it");
        history.add(entry("d", [true, false]));
        assert_eq!((history.labels(), history.undone.len()), (vec!["d"], 0));
    }
}
