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
    /// Number from 1 that no other action of the session has.
    pub(super) number: u64,
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
    /// the number of actions that its painting still has. Returns the number of the last one.
    fn drop_farthest(&mut self, kept: PerSurface<usize>) -> Option<u64> {
        let mut last = None;
        while self.on.iter().zip(kept.iter()).any(|(count, kept)| count > kept) {
            let Some(farthest) = self.entries.pop_front() else { return last };
            self.uncount(&farthest);
            last = Some(farthest.number);
        }
        last
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
    /// Number of the action added last; 0 before the first.
    last: u64,
    /// Number of the last done action that was dropped; 0 if none was.
    beginning: u64,
}

impl SharedHistory {
    /// Adds a new action; the undone ones are dropped.
    pub(super) fn add(&mut self, label: String, on: PerSurface<bool>, carried: Option<Carried>) {
        self.undone = Entries::default();
        self.last += 1;
        self.done.push(Entry { number: self.last, label, on, carried });
    }

    /// Drops the actions that a painting has dropped; `undo` and `redo` are the numbers of
    /// actions that each painting can still undo and redo.
    pub(super) fn limit_to(&mut self, undo: PerSurface<usize>, redo: PerSurface<usize>) {
        self.beginning = self.done.drop_farthest(undo).unwrap_or(self.beginning);
        self.undone.drop_farthest(redo);
    }

    /// Numbers of actions of each surface that can be undone and redone.
    pub(super) fn counts(&self) -> (PerSurface<usize>, PerSurface<usize>) {
        (self.done.on, self.undone.on)
    }

    /// Labels of all actions that can be reached by undo and redo, in their order.
    pub(super) fn labels(&self) -> Vec<&str> {
        self.entries().map(|entry| entry.label.as_str()).collect()
    }

    /// Number of the action before these, 0 if there is none, then their own in the same order.
    pub(super) fn numbers(&self) -> Vec<u64> {
        [self.beginning].into_iter().chain(self.entries().map(|entry| entry.number)).collect()
    }

    fn entries(&self) -> impl Iterator<Item = &Entry> {
        self.done.entries.iter().chain(self.undone.entries.iter().rev())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn add(history: &mut SharedHistory, label: &str, [canvas, palette]: [bool; 2]) {
        history.add(label.to_owned(), PerSurface { canvas, palette }, None);
    }

    fn counts([canvas, palette]: [usize; 2]) -> PerSurface<usize> {
        PerSurface { canvas, palette }
    }

    #[test]
    fn an_action_dropped_by_one_painting_drops_all_before_it() {
        let mut history = SharedHistory::default();
        add(&mut history, "a", [true, false]);
        add(&mut history, "b", [false, true]);
        add(&mut history, "c", [true, true]);
        add(&mut history, "d", [true, false]);
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
        assert_eq!(history.numbers(), [3, 4], "it begins after `c`");
    }

    #[test]
    fn redo_is_dropped_from_its_far_end() {
        let mut history = SharedHistory::default();
        for label in ["a", "b", "c"] {
            add(&mut history, label, [true, label == "b"]);
        }
        for _ in 0..3 {
            let entry = history.done.pop().expect("there are three");
            history.undone.push(entry);
        }
        assert_eq!(history.labels(), ["a", "b", "c"]);
        history.limit_to(counts([0, 0]), counts([3, 0]));
        assert_eq!(history.labels(), ["a"], "`b` is lost, and with it `c` after it");
        add(&mut history, "d", [true, false]);
        assert_eq!((history.labels(), history.undone.len()), (vec!["d"], 0));
        assert_eq!(history.numbers(), [0, 4], "no number is given twice");
    }
}
