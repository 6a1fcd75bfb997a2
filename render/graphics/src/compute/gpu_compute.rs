//! A graphics device that computes images.

use std::sync::Arc;

use super::plane::Plane;
use crate::field::Field;
use crate::gpu::{Buffer, Device, DeviceError, Kernel, Recording, Rows, groups};

/// A graphics device with the commands recorded for it and a pool of planes.
///
/// Operations only record; recorded commands are submitted together when values are
/// written or read back.
#[derive(Debug)]
pub struct GpuCompute {
    pub(crate) device: Device,
    pub(crate) recording: Recording,
    /// Memory of all planes ever made, each with its bytes; a plane is free if the pool
    /// alone holds it.
    pool: Vec<(u64, Arc<Buffer>)>,
}

impl GpuCompute {
    /// Computes on `device`, with an empty pool.
    #[must_use]
    pub fn new(device: Device) -> Self {
        Self { device, recording: Recording::default(), pool: Vec::new() }
    }

    /// The device that computes.
    #[must_use]
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Gives up the pool and the commands not submitted yet, and returns the device.
    #[must_use]
    pub fn into_device(self) -> Device {
        self.device
    }

    /// A plane of `width` x `height` pixels whose values are undefined until written.
    ///
    /// # Errors
    /// [`DeviceError::TooLarge`] beyond the device's buffer limit,
    /// [`DeviceError::OutOfMemory`] if it has no memory left.
    pub fn plane<T>(&mut self, width: usize, height: usize) -> Result<Plane<T>, DeviceError> {
        let bytes = (width * height * size_of::<T>()) as u64;
        let free =
            |(size, buffer): &&(u64, Arc<Buffer>)| *size == bytes && Arc::strong_count(buffer) == 1;
        if let Some((_, buffer)) = self.pool.iter().find(free) {
            return Ok(Plane::new(Arc::clone(buffer), width, height));
        }
        let buffer = Arc::new(self.device.buffer("an image", bytes)?);
        self.pool.push((bytes, Arc::clone(&buffer)));
        Ok(Plane::new(buffer, width, height))
    }

    /// Records `items` for the batch buffer that [`crate::gpu::Storage::Batch`] binds.
    /// Returns the index of the first, counted in items.
    pub fn batch<T: bytemuck::Pod>(&mut self, items: &[T]) -> u32 {
        self.recording.batch(items)
    }

    /// Records `kernel` with one invocation per pixel of `size`, which is (width, height).
    ///
    /// # Panics
    /// If `params` is not of the size of the kernel's parameters.
    pub fn dispatch<P: bytemuck::Pod>(
        &mut self,
        kernel: &'static Kernel,
        params: &P,
        buffers: &[&Buffer],
        size: (usize, usize),
    ) {
        self.recording.dispatch(kernel, params, buffers, [groups(size.0), groups(size.1), 1]);
    }

    /// Submits the recorded commands without waiting for them.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost or refuses a command.
    pub fn submit(&mut self) -> Result<(), DeviceError> {
        self.device.submit(&mut self.recording)
    }

    /// Writes `values` to the start of `plane`. Commands recorded so far are submitted
    /// first, since the plane's memory may be that of a plane they still read.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost or refuses a command.
    pub fn write<T: bytemuck::Pod>(
        &mut self,
        plane: &Plane<T>,
        values: &[T],
    ) -> Result<(), DeviceError> {
        self.submit()?;
        self.device.write(plane.buffer(), Rows::start(values.len()), values)
    }

    /// Copies `field` into device memory.
    ///
    /// # Errors
    /// [`DeviceError`] if the device has no memory left or was lost.
    pub fn upload<T: bytemuck::Pod>(&mut self, field: &Field<T>) -> Result<Plane<T>, DeviceError> {
        let plane = self.plane(field.width(), field.height())?;
        self.write(&plane, field.values())?;
        Ok(plane)
    }

    /// Copies a plane back, after all commands recorded so far.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost.
    pub fn download<T: bytemuck::Pod>(
        &mut self,
        plane: &Plane<T>,
    ) -> Result<Field<T>, DeviceError> {
        self.submit()?;
        let (width, height) = plane.size();
        let values = self.device.read(plane.buffer(), Rows::start(width * height))?;
        Ok(Field::from_values(width, height, values))
    }
}
