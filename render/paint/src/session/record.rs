//! The recording of a session as a script.

use crate::strokes::{
    Action, BrushSpec, MAX_ACTIONS, MAX_FILE_BYTES, MAX_NAMES, MAX_SAMPLES, StrokeScript,
    action_line,
};

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
    /// An empty recording with this header, whose numbers must be rounded.
    pub(super) fn new(header: StrokeScript) -> Self {
        Self { script: header, samples: 0, bytes: 0, limits: Limits::default(), stopped: None }
    }

    /// A recording that continues `script`, whose numbers must be rounded. Further brushes have the
    /// names of [`Record::add`].
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
