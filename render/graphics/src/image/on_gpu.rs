//! Pictures on a graphics device.

use std::sync::Arc;

use super::backend::Backend;
use crate::field::Field;
use crate::gpu::{Buffer, Device, DeviceError, Recording, Rows};

/// A device, with what is to be done next and memory to be used again.
#[derive(Debug)]
pub struct OnGpu {
    /// The device that computes.
    pub device: Device,
    /// Steps not sent yet.
    pub recording: Recording,
    /// All planes made, each with its bytes; those that nobody holds are free.
    planes: Vec<(u64, Arc<Buffer>)>,
}

/// Values over pixels, on the device. Its memory is used again once all clones
/// are gone.
#[derive(Debug, Clone)]
pub struct Plane {
    buffer: Arc<Buffer>,
    width: usize,
    height: usize,
}

impl Plane {
    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// Its memory.
    pub fn buffer(&self) -> &Buffer {
        &self.buffer
    }
}

impl OnGpu {
    /// Works on `device`.
    #[must_use]
    pub fn new(device: Device) -> Self {
        Self { device, recording: Recording::default(), planes: Vec::new() }
    }

    /// A plane whose values are anything yet, `bytes` a pixel.
    pub fn plane(
        &mut self,
        width: usize,
        height: usize,
        bytes: usize,
    ) -> Result<Plane, DeviceError> {
        let bytes = (width * height * bytes) as u64;
        let free =
            |(size, buffer): &&(u64, Arc<Buffer>)| *size == bytes && Arc::strong_count(buffer) == 1;
        if let Some((_, buffer)) = self.planes.iter().find(free) {
            return Ok(Plane { buffer: Arc::clone(buffer), width, height });
        }
        let buffer = Arc::new(self.device.buffer("a plane of watercolor", bytes)?);
        self.planes.push((bytes, Arc::clone(&buffer)));
        Ok(Plane { buffer, width, height })
    }

    /// Sends what was recorded.
    pub fn send(&mut self) -> Result<(), DeviceError> {
        self.device.submit(&mut self.recording)
    }

    /// Puts `values` at the beginning of a plane, before all that is recorded next.
    pub fn fill<T: bytemuck::Pod>(
        &mut self,
        plane: &Plane,
        values: &[T],
    ) -> Result<(), DeviceError> {
        // A free plane may still be read by steps not sent yet.
        self.send()?;
        self.device.write(&plane.buffer, Rows::start(values.len()), values)
    }

    fn taken<T: bytemuck::Pod>(&mut self, field: &Field<T>) -> Result<Plane, DeviceError> {
        let plane = self.plane(field.width(), field.height(), size_of::<T>())?;
        self.fill(&plane, field.values())?;
        Ok(plane)
    }

    /// Downloads the values of a plane.
    ///
    /// # Errors
    /// [`DeviceError`] if the device is lost.
    pub fn given<T: bytemuck::Pod>(&mut self, plane: &Plane) -> Result<Field<T>, DeviceError> {
        self.send()?;
        let count = plane.width * plane.height;
        let values = self.device.read(&plane.buffer, Rows::start(count))?;
        Ok(Field::from_values(plane.width, plane.height, values))
    }
}

impl Backend for OnGpu {
    type Color = Plane;
    type Grey = Plane;

    fn name(&self) -> String {
        self.device.adapter().name.clone()
    }

    fn color_of(&mut self, field: &Field<[f32; 4]>) -> Result<Plane, DeviceError> {
        self.taken(field)
    }

    fn grey_of(&mut self, field: &Field<f32>) -> Result<Plane, DeviceError> {
        self.taken(field)
    }

    fn color_field(&mut self, color: &Plane) -> Result<Field<[f32; 4]>, DeviceError> {
        self.given(color)
    }

    fn grey_field(&mut self, grey: &Plane) -> Result<Field<f32>, DeviceError> {
        self.given(grey)
    }
}
