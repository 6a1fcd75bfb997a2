//! One step of time.

use super::error::WorldError;
use super::settings::STEPS_PER_SECOND;
use super::state::{BIRTH, NONE, World};
use crate::motion::advance;

impl World {
    /// Goes on by one step, a 120th of a second: paint flows and is taken up, spills, and the
    /// volumes move.
    ///
    /// # Errors
    /// If there are too many volumes, or forces too stiff for a step. All paint that has moved
    /// until then is in the tally.
    pub fn step(&mut self) -> Result<(), WorldError> {
        self.move_paint()?;
        let pushes = self.pushes.iter().map(|timed| timed.what);
        self.surroundings.pushes = pushes.collect();
        let seconds = 1.0 / STEPS_PER_SECOND as f32;
        advance(&mut self.volumes, &self.settings.motion, &self.surroundings, seconds)?;
        self.pushes.iter_mut().for_each(|timed| timed.steps += 1);
        self.pushes.retain(|timed| !timed.has_ended());
        self.remove_vanished();
        self.steps += 1;
        Ok(())
    }

    /// The first half of a step: paint flows, is taken up and spills.
    pub(super) fn move_paint(&mut self) -> Result<(), WorldError> {
        self.flow()?;
        self.take_up();
        if self.settings.cell > 0.0 { self.spill() } else { Ok(()) }
    }

    /// Removes volumes that have lost all their paint and shrunk to dots.
    fn remove_vanished(&mut self) {
        let least = 0.5 * BIRTH * self.scale.cell;
        let count = self.volumes.len();
        self.volumes.retain(|volume| {
            let vanishing = volume.target_radius == 0.0 && !volume.dry;
            !vanishing || volume.radius > least
        });
        if self.volumes.len() < count {
            self.settled = false;
            self.index_cells();
        }
    }

    /// Finds the wet volume in each cell.
    pub(super) fn index_cells(&mut self) {
        self.of_cell.fill(NONE);
        for (index, volume) in (0..).zip(&self.volumes) {
            if let (Some(cell), false) = (volume.cell, volume.dry) {
                self.of_cell[cell as usize] = index;
            }
        }
    }
}
