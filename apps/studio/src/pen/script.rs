//! A synthetic pen for tests and demonstrations: reports at given times.

use web_time::{Duration, Instant};

use super::report::{Device, PointerState, Report, ReportKind};

/// Reports of one device, each with its time since the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Script {
    device: Device,
    steps: Vec<(Duration, ReportKind)>,
    next: usize,
}

impl Script {
    /// An empty script for one device.
    #[must_use]
    pub const fn new(device: Device) -> Self {
        Self { device, steps: Vec::new(), next: 0 }
    }

    /// Adds an event `after` the previous one.
    #[must_use]
    pub fn then(mut self, after: Duration, kind: ReportKind) -> Self {
        self.steps.push((self.length() + after, kind));
        self
    }

    /// Adds a stroke: pressed at the first state, moved through the others at intervals of
    /// `every`, and released.
    #[must_use]
    pub fn stroke(
        mut self,
        holds: impl IntoIterator<Item = PointerState>,
        every: Duration,
    ) -> Self {
        for (order, state) in holds.into_iter().enumerate() {
            let kind =
                if order == 0 { ReportKind::Pressed(state) } else { ReportKind::Moved(state) };
            self = self.then(every, kind);
        }
        self.then(every, ReportKind::Released)
    }

    /// Duration from the start to the last event.
    #[must_use]
    pub fn length(&self) -> Duration {
        self.steps.last().map_or(Duration::ZERO, |&(at, _)| at)
    }

    /// Reports that became due since the last call, for a script that began at `start`.
    pub fn due(&mut self, start: Instant, now: Instant) -> Vec<Report> {
        let mut due = Vec::new();
        while let Some(&(at, kind)) = self.steps.get(self.next)
            && start + at <= now
        {
            due.push(Report { device: self.device, arrived: start + at, kind });
            self.next += 1;
        }
        due
    }
}
