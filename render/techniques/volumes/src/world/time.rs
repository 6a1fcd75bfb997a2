//! One step of time.

use super::error::WorldError;
use super::settings::STEPS_PER_SECOND;
use super::state::{BIRTH, NONE, World};
use super::step_device::{OpenedDevice, StepDevice};
use crate::motion::advance;

impl World {
    /// Goes on by one step, a 120th of a second: paint flows and is taken up, spills, and the
    /// volumes move.
    ///
    /// # Errors
    /// If there are too many volumes, or forces too stiff for a step. All paint that has moved
    /// until then is in the tally.
    pub fn step(&mut self) -> Result<(), WorldError> {
        self.step_by(None)
    }

    /// Goes on by one step like [`Self::step`], on a graphics device if the world has more
    /// particles than [`super::DEVICE_PARTICLES`]. Paint is the same to the quantum, unless a
    /// volume is split; places of particles agree with those of the processor within 1e-4 radii,
    /// but for single particles that the surface pulls to another of two equally near samples.
    ///
    /// # Errors
    /// Those of [`Self::step`], and if the device fails. All paint that has moved until then is in
    /// the tally.
    pub fn step_on(&mut self, device: &mut StepDevice) -> Result<(), WorldError> {
        let serving = device.serving(&self.volumes)?;
        self.step_by(serving)
    }

    fn step_by(&mut self, mut device: Option<&mut OpenedDevice>) -> Result<(), WorldError> {
        self.move_paint(device.as_deref_mut())?;
        let pushes = self.pushes.iter().map(|timed| timed.what);
        self.surroundings.pushes = pushes.collect();
        let seconds = 1.0 / STEPS_PER_SECOND as f32;
        let Self { volumes, settings, surroundings, .. } = self;
        match device {
            None => advance(volumes, &settings.motion, surroundings, seconds)?,
            Some(OpenedDevice { device, motion, .. }) => {
                motion.advance(device, volumes, &settings.motion, surroundings, seconds)?
            }
        };
        self.pushes.iter_mut().for_each(|timed| timed.steps += 1);
        self.pushes.retain(|timed| !timed.has_ended());
        self.remove_vanished();
        self.steps += 1;
        Ok(())
    }

    /// The first half of a step: paint flows, is taken up and spills.
    pub(super) fn move_paint(
        &mut self,
        device: Option<&mut OpenedDevice>,
    ) -> Result<(), WorldError> {
        self.flow()?;
        self.take_up();
        if self.settings.cell > 0.0 { self.spill(device) } else { Ok(()) }
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
