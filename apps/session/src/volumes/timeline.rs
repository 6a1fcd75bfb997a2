//! Plays the recording of a scene: the present moment, snapshots to go back to, and how many steps
//! are due so that the scene keeps time with the clock.

use std::collections::{BTreeMap, VecDeque};

use graphics::mesh::Mesh;
use volumes::performance::{FirstView, Performance};
use volumes::script::{Event, Script};
use volumes::settings::Settings;
use web_time::{Duration, Instant};

use crate::failure::FileFailure;

/// Most snapshots. If there are more, we drop every second one and take later ones twice as far
/// apart.
const MOST_SNAPSHOTS: usize = 128;

/// Plays a script forwards and backwards.
#[derive(Debug)]
pub(super) struct Timeline {
    now: Performance,
    /// Snapshots by their steps. The first is the start.
    snapshots: BTreeMap<u64, Performance>,
    every: u64,
    /// The moment that the user went to. This is the present one unless it still has to play there.
    goal: u64,
    reached: u64,
}

impl Timeline {
    /// The start of a script on a scene. Fails if the world cannot be made.
    pub(super) fn new(
        script: &Script,
        scene: &Mesh,
        settings: &Settings,
        view: &FirstView,
    ) -> Result<Self, FileFailure> {
        let now = Performance::new(script, scene, settings, view);
        let now = now.map_err(|error| FileFailure::explained(&error))?;
        let snapshots = BTreeMap::from([(0, now.clone())]);
        Ok(Self { now, snapshots, every: STEPS_A_SECOND, goal: 0, reached: 0 })
    }

    /// Notes that there is something to play until step `step`.
    pub(super) fn reach(&mut self, step: u64) {
        self.reached = self.reached.max(step);
    }

    pub(super) fn now(&self) -> &Performance {
        &self.now
    }

    /// The moment that is shown, or that the user went to.
    pub(super) fn moment(&self) -> u64 {
        self.goal
    }

    pub(super) fn reached(&self) -> u64 {
        self.reached
    }

    /// Whether it still plays towards the moment that the user went to.
    pub(super) fn is_behind(&self) -> bool {
        self.now.step() < self.goal
    }

    /// Takes one step. If an event fails, nothing has changed.
    pub(super) fn step(&mut self) -> Result<(), FileFailure> {
        let next = self.now.step() + 1;
        if let Err(error) = self.now.advance_to(next) {
            self.goal = self.now.step();
            return Err(FileFailure::explained(&error));
        }
        self.goal = self.goal.max(next);
        self.reached = self.reached.max(next);
        if next.is_multiple_of(self.every) && !self.snapshots.contains_key(&next) {
            self.snapshots.insert(next, self.now.clone());
            self.thin_out();
        }
        Ok(())
    }

    /// Drops every second snapshot if there are too many.
    fn thin_out(&mut self) {
        if self.snapshots.len() > MOST_SNAPSHOTS {
            self.every *= 2;
            let every = self.every;
            self.snapshots.retain(|step, _| step.is_multiple_of(every));
        }
    }

    /// Plays at least one step, and until `until`, towards the moment that the user went to. If an
    /// event fails, the moment before it stays.
    pub(super) fn catch_up(&mut self, until: Instant) -> Result<(), FileFailure> {
        while self.is_behind() {
            self.step()?;
            if Instant::now() >= until {
                break;
            }
        }
        Ok(())
    }

    /// Goes to a moment from here, or from the last snapshot before it. Pass the same `script`,
    /// `scene` and
    /// `view` as before.
    pub(super) fn seek(
        &mut self,
        goal: u64,
        (script, scene, view): (&Script, &Mesh, &FirstView),
    ) -> Result<(), FileFailure> {
        let snapshot = self.snapshots.range(..=goal).next_back();
        let here = self.now.step();
        if let Some((&step, snapshot)) = snapshot
            && (here > goal || here < step)
        {
            let mut now = snapshot.clone();
            // Events may have been added since the snapshot.
            now.go_on_by(script, scene, view).map_err(|error| FileFailure::explained(&error))?;
            self.now = now;
        }
        self.goal = goal;
        Ok(())
    }

    /// Adds an event. It begins with the next step.
    pub(super) fn add(&mut self, event: Event) {
        self.forget_after(event.start.into());
        self.now.add(event);
    }

    /// Plays another script to the same moment. Its events before step `from` must be the same.
    pub(super) fn replay(
        &mut self,
        from: u64,
        played: (&Script, &Mesh, &FirstView),
    ) -> Result<(), FileFailure> {
        self.forget_after(from);
        let moment = self.goal;
        self.seek(from.min(self.now.step()), played)?;
        let (script, scene, view) = played;
        let gone_on = self.now.go_on_by(script, scene, view);
        gone_on.map_err(|error| FileFailure::explained(&error))?;
        self.goal = moment;
        Ok(())
    }

    fn forget_after(&mut self, from: u64) {
        self.snapshots.retain(|&step, _| step <= from);
    }
}

/// Steps of a scene in a second.
pub const STEPS_A_SECOND: u64 = 120;

/// Most steps that may be due. A slow machine skips the rest: the scene becomes slower, but still
/// answers in time.
const MOST_DUE: u64 = 12;

/// The speed is averaged over this time.
const SPAN: Duration = Duration::from_secs(1);

/// Counts the steps that are due by the clock.
#[derive(Debug, Default)]
pub(super) struct Pacer {
    /// When counting began, and how many steps were taken since.
    running: Option<(Instant, u64)>,
    recent: VecDeque<(Instant, u64)>,
}

impl Pacer {
    /// Begins to count at `now`, unless it is counting already.
    pub(super) fn start(&mut self, now: Instant) {
        self.running.get_or_insert((now, 0));
    }

    /// Stops counting, because time stands.
    pub(super) fn stop(&mut self) {
        self.running = None;
    }

    /// Steps due at `now`.
    pub(super) fn due(&mut self, now: Instant) -> u64 {
        let Some((since, taken)) = &mut self.running else { return 0 };
        let passed = now.saturating_duration_since(*since).as_nanos();
        let owed = (passed * u128::from(STEPS_A_SECOND) / 1_000_000_000) as u64;
        let due = owed.saturating_sub(*taken);
        if due > MOST_DUE {
            *taken = owed - MOST_DUE;
        }
        due.min(MOST_DUE)
    }

    /// When the next step is due, or `None` while time stands.
    pub(super) fn next(&self) -> Option<Instant> {
        let (since, taken) = self.running?;
        let nanoseconds = (taken + 1) * 1_000_000_000 / STEPS_A_SECOND + 1;
        Some(since + Duration::from_nanos(nanoseconds))
    }

    /// Counts `steps` that were taken until `now`.
    pub(super) fn took(&mut self, steps: u64, now: Instant) {
        if let Some((_, taken)) = &mut self.running {
            *taken += steps;
        }
        self.recent.push_back((now, steps));
    }

    /// Forgets the steps that are still due. Use this when they would delay the answers.
    pub(super) fn forget(&mut self, now: Instant) {
        if self.running.is_some() {
            self.running = Some((now, 0));
        }
    }

    /// Speed over the last second. Real time is 1.
    pub(super) fn speed(&mut self, now: Instant) -> f64 {
        while self.recent.front().is_some_and(|(at, _)| now.saturating_duration_since(*at) > SPAN) {
            self.recent.pop_front();
        }
        let steps: u64 = self.recent.iter().map(|(_, steps)| steps).sum();
        steps as f64 / (STEPS_A_SECOND as f64 * SPAN.as_secs_f64())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_has_120_steps_however_it_is_divided() {
        let mut pacer = Pacer::default();
        let start = Instant::now();
        pacer.start(start);
        let mut taken = 0;
        for millisecond in [0, 7, 8, 9, 41, 100, 101, 180, 260, 330, 420, 500, 590, 680] {
            let now = start + Duration::from_millis(millisecond);
            let due = pacer.due(now);
            pacer.took(due, now);
            taken += due;
        }
        assert_eq!(taken, 81, "680 ms are 81.6 steps");
        let next = pacer.next().unwrap();
        assert_eq!(pacer.due(next - Duration::from_nanos(2)), 0);
        assert_eq!(pacer.due(next), 1);
        assert!((pacer.speed(start + Duration::from_millis(990)) - 0.675).abs() < 1e-9);
    }

    #[test]
    fn a_slow_machine_forgets_what_it_owes() {
        let mut pacer = Pacer::default();
        let start = Instant::now();
        assert_eq!(pacer.due(start + Duration::from_secs(9)), 0, "time stands");
        pacer.start(start);
        let late = start + Duration::from_secs(3);
        assert_eq!(pacer.due(late), MOST_DUE);
        pacer.took(5, late);
        assert_eq!(pacer.due(late), MOST_DUE - 5, "the rest of them is still due");
        pacer.forget(late);
        assert_eq!(pacer.due(late), 0);
        assert_eq!(pacer.due(late + Duration::from_millis(17)), 2);
        pacer.stop();
        assert_eq!((pacer.due(late + SPAN), pacer.next()), (0, None));
    }
}
