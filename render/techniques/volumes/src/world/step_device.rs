//! The graphics device of large worlds.

use graphics::compute::Compute;
use graphics::gpu::{Adapter, Device, DeviceError};

use super::state::World;
use crate::motion::DeviceMotion;
use crate::volume::Volume;
use crate::wetting::DeviceSpilling;

/// Number of particles above which a world is moved by a device that it is given. Smaller worlds
/// stay on the processor, with the same bytes on every machine.
pub const DEVICE_PARTICLES: usize = 200_000;

/// A graphics device for the steps of large worlds ([`World::step_on`]), with the memory that it
/// keeps from step to step. One serves any number of worlds.
#[derive(Debug)]
pub struct StepDevice {
    above: usize,
    opening: Opening,
}

/// A device that may have to be opened first.
#[derive(Debug)]
enum Opening {
    Processor,
    Closed(Adapter),
    Open(Box<OpenedDevice>),
}

/// The device and its memory.
#[derive(Debug)]
pub(super) struct OpenedDevice {
    pub(super) device: Device,
    pub(super) motion: DeviceMotion,
    pub(super) spilling: DeviceSpilling,
}

impl OpenedDevice {
    fn new(device: Device) -> Box<Self> {
        let motion = DeviceMotion::default();
        let spilling = DeviceSpilling::default();
        Box::new(Self { device, motion, spilling })
    }
}

impl StepDevice {
    /// The device of `compute`; with the processor all worlds are moved there.
    #[must_use]
    pub fn new(compute: Compute) -> Self {
        let device = compute.into_device();
        let opening =
            device.map_or(Opening::Processor, |device| Opening::Open(OpenedDevice::new(device)));
        Self { above: DEVICE_PARTICLES, opening }
    }

    /// The adapter of `compute`, which paints meanwhile. It is opened a second time once there is a
    /// world large enough.
    #[must_use]
    pub fn beside(compute: &Compute) -> Self {
        let adapter = compute.device().map(|device| device.adapter().clone());
        let opening = adapter.map_or(Opening::Processor, Opening::Closed);
        Self { above: DEVICE_PARTICLES, opening }
    }

    /// Serves worlds of more than `particles` particles, instead of [`DEVICE_PARTICLES`].
    #[must_use]
    pub fn above(self, particles: usize) -> Self {
        Self { above: particles, ..self }
    }

    /// Whether it moves this world.
    #[must_use]
    pub fn serves(&self, world: &World) -> bool {
        self.serves_volumes(&world.volumes)
    }

    fn serves_volumes(&self, volumes: &[Volume]) -> bool {
        let particles: usize = volumes.iter().map(|v| v.particles.places[0].len()).sum();
        !matches!(self.opening, Opening::Processor) && particles > self.above
    }

    /// The device, if it serves a world of these volumes.
    pub(super) fn serving(
        &mut self,
        volumes: &[Volume],
    ) -> Result<Option<&mut OpenedDevice>, DeviceError> {
        if !self.serves_volumes(volumes) {
            return Ok(None);
        }
        if let Opening::Closed(adapter) = &self.opening {
            self.opening = Opening::Open(OpenedDevice::new(Device::open(adapter)?));
        }
        match &mut self.opening {
            Opening::Open(opened) => Ok(Some(opened)),
            Opening::Processor | Opening::Closed(_) => Ok(None),
        }
    }
}
