//! A pen without a hand, for trying out: reports at given times.

use std::time::{Duration, Instant};

use super::report::{Device, Hold, Report, What};

/// Reports and when they come.
#[derive(Debug, Clone, PartialEq)]
pub struct Script {
    device: Device,
    steps: Vec<(Duration, What)>,
    next: usize,
}

impl Script {
    /// Nothing yet.
    #[must_use]
    pub const fn new(device: Device) -> Self {
        Self { device, steps: Vec::new(), next: 0 }
    }

    /// Adds something, so long after what came before.
    #[must_use]
    pub fn then(mut self, after: Duration, what: What) -> Self {
        self.steps.push((self.length() + after, what));
        self
    }

    /// Adds a stroke: set down at the first hold, led through all of them, one
    /// `every` so often, and lifted.
    #[must_use]
    pub fn stroke(mut self, holds: impl IntoIterator<Item = Hold>, every: Duration) -> Self {
        for (order, hold) in holds.into_iter().enumerate() {
            let what = if order == 0 { What::Pressed(hold) } else { What::Moved(hold) };
            self = self.then(every, what);
        }
        self.then(every, What::Released)
    }

    /// How long it takes.
    #[must_use]
    pub fn length(&self) -> Duration {
        self.steps.last().map_or(Duration::ZERO, |&(at, _)| at)
    }

    /// What came since the last call, if it began at `start` and it is `now`.
    pub fn due(&mut self, start: Instant, now: Instant) -> Vec<Report> {
        let mut due = Vec::new();
        while let Some(&(at, what)) = self.steps.get(self.next)
            && start + at <= now
        {
            due.push(Report { device: self.device, arrived: start + at, what });
            self.next += 1;
        }
        due
    }
}
