//! The history over both surfaces, and the recording of a session as a script.

use std::collections::VecDeque;

use crate::strokes::{
    Action, BrushSpec, MAX_ACTIONS, MAX_FILE_BYTES, MAX_NAMES, MAX_SAMPLES, PerSurface,
    StrokeScript, SurfaceId, action_line,
};

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
    /// Whether this action changed each surface, so that its history has the action.
    pub(super) changed: PerSurface<bool>,
    pub(super) carried: Option<Carried>,
}

/// Number of actions of each surface.
fn counts(entries: &VecDeque<Entry>) -> PerSurface<usize> {
    PerSurface::from_fn(|surface| entries.iter().filter(|entry| entry.changed[surface]).count())
}

/// Drops the entries farthest from the present, which are the first, until each surface has at most
/// `kept`, the number of actions that its painting still has. Returns the number of the last entry
/// dropped.
fn drop_farthest(entries: &mut VecDeque<Entry>, kept: PerSurface<usize>) -> Option<u64> {
    let mut last = None;
    while counts(entries).iter().zip(kept.iter()).any(|(count, kept)| count > kept) {
        last = entries.pop_front().map(|entry| entry.number);
    }
    last
}

/// Actions that are done, and actions that were undone.
#[derive(Debug, Default)]
pub(super) struct SharedHistory {
    /// Actions that are done, the oldest first.
    pub(super) done: VecDeque<Entry>,
    /// Undone actions. The next redo is the last one.
    pub(super) undone: VecDeque<Entry>,
    /// Number of the action added last. 0 before the first.
    last: u64,
    /// Number of the last done action that was dropped. 0 if none was.
    beginning: u64,
}

impl SharedHistory {
    /// Adds a new action. The undone ones are dropped.
    pub(super) fn add(
        &mut self,
        label: String,
        changed: PerSurface<bool>,
        carried: Option<Carried>,
    ) {
        self.undone.clear();
        self.last += 1;
        self.done.push_back(Entry { number: self.last, label, changed, carried });
    }

    /// Drops the actions that a painting has dropped. `undo` and `redo` are the numbers of
    /// actions that each painting can still undo and redo.
    pub(super) fn limit_to(&mut self, undo: PerSurface<usize>, redo: PerSurface<usize>) {
        self.beginning = drop_farthest(&mut self.done, undo).unwrap_or(self.beginning);
        drop_farthest(&mut self.undone, redo);
    }

    /// Numbers of actions of each surface that can be undone and redone.
    pub(super) fn counts(&self) -> (PerSurface<usize>, PerSurface<usize>) {
        (counts(&self.done), counts(&self.undone))
    }

    /// Labels of all actions that can be reached by undo and redo, in their order.
    pub(super) fn labels(&self) -> Vec<&str> {
        self.entries().map(|entry| entry.label.as_str()).collect()
    }

    /// The number of the action before these (0 if there is none), then the numbers of these
    /// actions in their order.
    pub(super) fn numbers(&self) -> Vec<u64> {
        [self.beginning].into_iter().chain(self.entries().map(|entry| entry.number)).collect()
    }

    fn entries(&self) -> impl Iterator<Item = &Entry> {
        self.done.iter().chain(self.undone.iter().rev())
    }
}

/// Bytes of a file that are reserved for everything but its actions.
const HEADER_BYTES: usize = 1 << 20;

/// Maximum size of a recording, within the limits of scripts that can be read.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    pub(super) actions: usize,
    pub(super) samples: usize,
    pub(super) bytes: usize,
    pub(super) brushes: usize,
}

impl Default for Limits {
    fn default() -> Self {
        let bytes = MAX_FILE_BYTES - HEADER_BYTES;
        Self { actions: MAX_ACTIONS, samples: MAX_SAMPLES, bytes, brushes: MAX_NAMES }
    }
}

/// A recording and its size.
#[derive(Debug)]
pub(super) struct Record {
    pub(super) script: StrokeScript,
    samples: usize,
    bytes: usize,
    pub(super) limits: Limits,
    /// Reason why it ended, if it did.
    pub(super) stopped: Option<String>,
}

impl Record {
    /// An empty recording with this header. Round the numbers of the header first.
    pub(super) fn new(header: StrokeScript) -> Self {
        Self { script: header, samples: 0, bytes: 0, limits: Limits::default(), stopped: None }
    }

    /// A recording that continues `script`. Round the numbers of the script first. Further brushes
    /// have the names of [`Record::add`].
    pub(super) fn resumed(mut script: StrokeScript) -> Self {
        let actions = std::mem::take(&mut script.actions);
        let mut record = Self::new(script);
        actions.into_iter().for_each(|action| record.add(action, None));
        record
    }

    /// Appends an action and, if it uses one, its brush. An action that would exceed a limit
    /// ends the recording.
    pub(super) fn add(&mut self, action: Action, brush: Option<(&str, &BrushSpec)>) {
        if self.stopped.is_some() {
            return;
        }
        let Ok(text) = action_line(&action) else {
            return self.stop("an action cannot be written");
        };
        let samples = action.stroke().map_or(0, |stroke| stroke.samples.len());
        let new_name = brush.filter(|(name, _)| !self.script.brushes.contains_key(*name));
        let most = self.limits;
        // 6 bytes for comma, line break and indent.
        let bytes = self.bytes + text.len() + 6;
        if self.script.actions.len() >= most.actions {
            self.stop(&format!("a recording holds {} actions", most.actions));
        } else if self.samples + samples > most.samples {
            self.stop(&format!("a recording holds {} samples", most.samples));
        } else if bytes > most.bytes {
            self.stop(&format!("a recording holds {} MiB", most.bytes >> 20));
        } else if new_name.is_some() && self.script.brushes.len() >= most.brushes {
            self.stop(&format!("a recording holds {} brushes", most.brushes));
        } else {
            if let Some((name, spec)) = new_name {
                self.script.brushes.insert(name.to_owned(), spec.clone());
            }
            (self.samples, self.bytes) = (self.samples + samples, bytes);
            self.script.actions.push(action);
        }
    }

    /// Ends the recording, for a reason.
    pub(super) fn stop(&mut self, reason: &str) {
        self.stopped.get_or_insert_with(|| reason.to_owned());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn add(history: &mut SharedHistory, label: &str, [canvas, palette]: [bool; 2]) {
        history.add(label.to_owned(), PerSurface { canvas, palette }, None);
    }

    fn kept(canvas: usize, palette: usize) -> PerSurface<usize> {
        PerSurface { canvas, palette }
    }

    #[test]
    fn an_action_dropped_by_one_painting_drops_all_before_it() {
        let mut history = SharedHistory::default();
        add(&mut history, "a", [true, false]);
        add(&mut history, "b", [false, true]);
        add(&mut history, "c", [true, true]);
        add(&mut history, "d", [true, false]);
        history.limit_to(kept(3, 2), kept(0, 0));
        assert_eq!(history.labels(), ["a", "b", "c", "d"], "all is known");
        // The palette forgot `b`, so `a` cannot be reached, though the canvas knows it.
        history.limit_to(kept(3, 1), kept(0, 0));
        assert_eq!(history.labels(), ["c", "d"]);
        // That the canvas forgets `a` as well changes nothing.
        history.limit_to(kept(2, 1), kept(0, 0));
        assert_eq!(history.labels(), ["c", "d"]);
        history.limit_to(kept(1, 1), kept(0, 0));
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
            let entry = history.done.pop_back().expect("there are three");
            history.undone.push_back(entry);
        }
        assert_eq!(history.labels(), ["a", "b", "c"]);
        history.limit_to(kept(0, 0), kept(3, 0));
        assert_eq!(history.labels(), ["a"], "`b` is lost, and with it `c` after it");
        add(&mut history, "d", [true, false]);
        assert_eq!((history.labels(), history.undone.len()), (vec!["d"], 0));
        assert_eq!(history.numbers(), [0, 4], "no number is given twice");
    }
}
