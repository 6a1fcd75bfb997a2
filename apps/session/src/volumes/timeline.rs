//! The recording played: the present moment, and snapshots to go back to.

use std::collections::BTreeMap;
use web_time::Instant;

use graphics::mesh::Mesh;
use volumes::performance::{FirstView, Performance};
use volumes::script::{Event, Script};
use volumes::settings::Settings;

use super::pacer::STEPS_A_SECOND;
use crate::failure::FileFailure;

/// Most snapshots. Beyond, every second one is given up, and those that follow are twice as far
/// apart.
const MOST_SNAPSHOTS: usize = 128;

/// A script being played, forwards and back.
#[derive(Debug)]
pub(super) struct Timeline {
    now: Performance,
    /// Snapshots by their steps; the first is the start.
    snapshots: BTreeMap<u64, Performance>,
    /// Steps between two snapshots.
    every: u64,
    /// The moment that is sought; the present one if none is.
    goal: u64,
    /// The last moment that was reached.
    reached: u64,
}

impl Timeline {
    /// The start of a script on a scene.
    ///
    /// # Errors
    /// [`FileFailure`] if the world cannot be made.
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

    /// The performance at the present moment.
    pub(super) fn now(&self) -> &Performance {
        &self.now
    }

    /// The moment that is shown or sought.
    pub(super) fn moment(&self) -> u64 {
        self.goal
    }

    /// The last moment that was reached.
    pub(super) fn reached(&self) -> u64 {
        self.reached
    }

    /// Whether the moment that is sought has not been reached.
    pub(super) fn is_behind(&self) -> bool {
        self.now.step() < self.goal
    }

    /// Takes one step.
    ///
    /// # Errors
    /// [`FileFailure`] for an event that cannot be done; nothing has changed then.
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

    /// Gives up every second snapshot if there are too many.
    fn thin_out(&mut self) {
        if self.snapshots.len() > MOST_SNAPSHOTS {
            self.every *= 2;
            let every = self.every;
            self.snapshots.retain(|step, _| step.is_multiple_of(every));
        }
    }

    /// Plays towards the moment that is sought until `until`, at least one step.
    ///
    /// # Errors
    /// [`FileFailure`] for an event that cannot be done; the moment before it is kept.
    pub(super) fn catch_up(&mut self, until: Instant) -> Result<(), FileFailure> {
        while self.is_behind() {
            self.step()?;
            if Instant::now() >= until {
                break;
            }
        }
        Ok(())
    }

    /// Seeks a moment: goes on from here, or from the last snapshot before it. `script`, `scene`
    /// and `view` are those that are played.
    ///
    /// # Errors
    /// [`FileFailure`] if the script cannot be played on this scene.
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
            // Events may have been added since.
            now.go_on_by(script, scene, view).map_err(|error| FileFailure::explained(&error))?;
            self.now = now;
        }
        self.goal = goal;
        Ok(())
    }

    /// Adds an event that begins with the next step.
    pub(super) fn add(&mut self, event: Event) {
        self.forget_after(event.start.into());
        self.now.add(event);
    }

    /// Plays another script, whose events before step `from` are the same, to the same moment.
    ///
    /// # Errors
    /// [`FileFailure`] if the script cannot be played on this scene.
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

    /// Forgets the snapshots of moments after step `from`.
    fn forget_after(&mut self, from: u64) {
        self.snapshots.retain(|&step, _| step <= from);
    }
}
