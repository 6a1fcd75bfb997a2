//! Where the tour is, and how it goes on.

use super::facts::Facts;
use super::step::TourStep;

/// The guided tour. It can be left and goes on with the same step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tour {
    running: bool,
    /// Index of the step; the number of steps at the end.
    at: usize,
    /// The painting when the step began; `None` before the painting was seen.
    begun: Option<Facts>,
    done: [bool; TourStep::ALL.len()],
}

impl Tour {
    /// Starts the tour, or goes on where it was left; from the start if it had ended.
    pub fn start(&mut self) {
        if self.at == TourStep::ALL.len() {
            *self = Self::default();
        }
        (self.running, self.begun) = (true, None);
    }

    /// Leaves the tour.
    pub fn leave(&mut self) {
        self.running = false;
    }

    /// Whether the tour is shown.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.running
    }

    /// The step that is shown; `None` while the tour is not running, and after the last step.
    #[must_use]
    pub fn step(&self) -> Option<TourStep> {
        TourStep::ALL.get(self.at).copied().filter(|_| self.running)
    }

    /// Index of the step from 0; the number of steps at the end.
    #[must_use]
    pub fn number(&self) -> usize {
        self.at
    }

    /// Which steps were done.
    #[must_use]
    pub fn done(&self) -> [bool; TourStep::ALL.len()] {
        self.done
    }

    /// Looks at the painting, and goes on if the step was done. Returns whether it was.
    pub fn observe(&mut self, now: Facts) -> bool {
        let Some(step) = self.step() else { return false };
        let Some(begun) = &mut self.begun else {
            self.begun = Some(now);
            return false;
        };
        if step.is_done(begun, &now) {
            self.done[self.at] = true;
            (self.at, self.begun) = (self.at + 1, Some(now));
            return true;
        }
        begun.lower_to(&now);
        false
    }

    /// Another painting was opened: what it holds is not done by the painter.
    pub fn forget(&mut self) {
        self.begun = None;
    }

    /// Goes on without doing the step.
    pub fn next(&mut self) {
        (self.at, self.begun) = ((self.at + 1).min(TourStep::ALL.len()), None);
    }

    /// Goes back by a step.
    pub fn back(&mut self) {
        (self.at, self.begun) = (self.at.saturating_sub(1), None);
    }
}
