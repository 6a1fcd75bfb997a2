//! The graphics device of large worlds.

use graphics::compute::Compute;
use graphics::gpu::Device;

use super::state::World;
use crate::motion::DeviceMotion;
use crate::volume::Volume;
use crate::wetting::DeviceSpilling;

/// Number of particles above which a world is moved by a device that it is given. Below, the way to
/// the device and back takes longer than the step.
pub const DEVICE_PARTICLES: usize = 200_000;

/// A graphics device for the steps of large worlds ([`World::step_on`]), with the memory that it
/// keeps from step to step. One serves any number of worlds.
#[derive(Debug)]
pub struct StepDevice {
    above: usize,
    opened: Option<OpenedDevice>,
}

/// The device and its memory.
#[derive(Debug)]
pub(super) struct OpenedDevice {
    pub(super) device: Device,
    pub(super) motion: DeviceMotion,
    pub(super) spilling: DeviceSpilling,
}

impl StepDevice {
    /// The device of `compute`; on the processor all worlds are moved there.
    #[must_use]
    pub fn new(compute: Compute) -> Self {
        let opened = compute.into_device().map(|device| OpenedDevice {
            device,
            motion: DeviceMotion::default(),
            spilling: DeviceSpilling::default(),
        });
        Self { above: DEVICE_PARTICLES, opened }
    }

    /// Serves worlds of more than `particles` particles, instead of [`DEVICE_PARTICLES`].
    #[must_use]
    pub fn above(self, particles: usize) -> Self {
        Self { above: particles, ..self }
    }

    /// The device, if it serves a world of these volumes.
    pub(super) fn serving(&mut self, volumes: &[Volume]) -> Option<&mut OpenedDevice> {
        let above = self.above;
        self.opened.as_mut().filter(|_| particles_of(volumes) > above)
    }

    /// Whether it moves this world.
    #[must_use]
    pub fn serves(&self, world: &World) -> bool {
        self.opened.is_some() && particles_of(&world.volumes) > self.above
    }
}

fn particles_of(volumes: &[Volume]) -> usize {
    volumes.iter().map(|volume| volume.particles.places[0].len()).sum()
}
