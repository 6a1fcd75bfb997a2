//! Computation of images on the processor or on a graphics device.
//!
//! You choose a [`Compute`] once, when your program starts. An operation on images is a plain
//! function over `&mut Compute` with two forms: one for the processor and one that records a
//! kernel. Both take the same steps in the same order and stand in one file. The WGSL source of
//! the kernel lies beside this file. [`Image`]s lie in the memory of the processor or of the
//! device.
//!
//! ```
//! use graphics::compute::Compute;
//! use graphics::field::Field;
//!
//! let mut compute = Compute::cpu();
//! let image = compute.upload(&Field::filled(4, 3, 0.5f32))?;
//! assert_eq!(image.size(), (4, 3));
//! assert_eq!(compute.download(&image)?.values(), [0.5; 12]);
//! # Ok::<(), graphics::gpu::DeviceError>(())
//! ```

use std::marker::PhantomData;
use std::sync::Arc;

use crate::field::Field;
use crate::gpu::{
    BackendChoice, Buffer, Device, DeviceError, Kernel, Recording, Rows, choose, groups,
};

/// Computes images and holds them in memory: the processor's, or a graphics device's.
#[derive(Debug)]
pub enum Compute {
    /// The processor computes rows of pixels on all cores.
    Cpu,
    /// A graphics device.
    Gpu(Box<GpuCompute>),
}

impl Compute {
    /// Computes on the processor.
    #[must_use]
    pub fn cpu() -> Self {
        Self::Cpu
    }

    /// Computes on a graphics device.
    #[must_use]
    pub fn gpu(device: Device) -> Self {
        Self::Gpu(Box::new(GpuCompute::new(device)))
    }

    /// Uses the processor or the device that `choice` selects. `Auto` selects the processor if no
    /// hardware adapter can be opened.
    ///
    /// # Errors
    /// Only for [`BackendChoice::Gpu`]: [`DeviceError::NoAdapter`] if there is no usable adapter,
    /// or the driver's error if it cannot be opened.
    pub fn choose(choice: BackendChoice) -> Result<Self, DeviceError> {
        Ok(choose(choice)?.map_or(Self::Cpu, Self::gpu))
    }

    /// Name to show to people, for example `cpu` or the name of the graphics adapter.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Cpu => "cpu",
            Self::Gpu(gpu) => &gpu.device().adapter().name,
        }
    }

    /// The graphics device, `None` on the processor.
    #[must_use]
    pub fn device(&self) -> Option<&Device> {
        match self {
            Self::Cpu => None,
            Self::Gpu(gpu) => Some(gpu.device()),
        }
    }

    /// Returns the graphics device, so that you can use it for something else. `None` on the
    /// processor. Images made on it are lost.
    #[must_use]
    pub fn into_device(self) -> Option<Device> {
        match self {
            Self::Cpu => None,
            Self::Gpu(gpu) => Some(gpu.into_device()),
        }
    }

    /// Copies `field` into the memory of the processor or device.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left or was lost, never on the processor.
    pub fn upload<T: bytemuck::Pod>(&mut self, field: &Field<T>) -> Result<Image<T>, DeviceError> {
        match self {
            Self::Cpu => Ok(field.clone().into()),
            Self::Gpu(gpu) => gpu.upload(field).map(Image::from),
        }
    }

    /// Moves `field` into the memory of the processor, or copies it to the device.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left or was lost, never on the processor.
    pub fn give<T: bytemuck::Pod>(&mut self, field: Field<T>) -> Result<Image<T>, DeviceError> {
        match self {
            Self::Cpu => Ok(field.into()),
            Self::Gpu(gpu) => gpu.upload(&field).map(Image::from),
        }
    }

    /// Copies an image back to a field.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost, never on the processor.
    ///
    /// # Panics
    /// If another form of [`Compute`] made the image.
    pub fn download<T: bytemuck::Pod>(
        &mut self,
        image: &Image<T>,
    ) -> Result<Field<T>, DeviceError> {
        match self {
            Self::Cpu => Ok(image.host().clone()),
            Self::Gpu(gpu) => gpu.download(image.plane()),
        }
    }

    /// The values of an image. This copies them only from a device, or if another clone of the
    /// image is alive.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost, never on the processor.
    ///
    /// # Panics
    /// If another form of [`Compute`] made the image.
    pub fn take<T: bytemuck::Pod>(&mut self, image: Image<T>) -> Result<Field<T>, DeviceError> {
        match self {
            Self::Cpu => Ok(image.into_host()),
            Self::Gpu(gpu) => gpu.download(image.plane()),
        }
    }
}

/// A graphics device with the commands recorded for it and a pool of planes.
///
/// Operations only record. We submit recorded commands together when you write values or read them
/// back.
#[derive(Debug)]
pub struct GpuCompute {
    pub(crate) device: Device,
    pub(crate) recording: Recording,
    /// Memory of all planes ever made, each with its bytes. A plane is free if the pool alone holds
    /// it.
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

    /// Returns the device. This drops the pool and the commands that were not submitted yet.
    #[must_use]
    pub fn into_device(self) -> Device {
        self.device
    }

    /// A plane of `width` x `height` pixels. Its values are undefined until written.
    ///
    /// # Errors
    /// [`DeviceError::TooLarge`] beyond the device's buffer limit, [`DeviceError::OutOfMemory`] if
    /// it has no memory left.
    pub fn plane<T>(&mut self, width: usize, height: usize) -> Result<Plane<T>, DeviceError> {
        let bytes = (width * height * size_of::<T>()) as u64;
        if let Some((_, buffer)) = self.pool.iter().find(|(size, buffer): &&(u64, Arc<Buffer>)| {
            *size == bytes && Arc::strong_count(buffer) == 1
        }) {
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

    /// Writes `values` to the start of `plane`. This submits the commands recorded so far first,
    /// since they may still read the plane that had this memory before.
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

/// One value of type `T` per pixel, in the memory of the [`Compute`] that made it.
///
/// You can use an image only with this `Compute`. Operations panic if you pass an image of the
/// other form, and a graphics device refuses the memory of another device. Clones share memory.
#[derive(Debug, Clone)]
pub enum Image<T> {
    /// In the processor's memory.
    Host(Arc<Field<T>>),
    /// In the memory of a graphics device.
    Device(Plane<T>),
}

/// An image of encoded sRGB in 0..1 (not multiplied by coverage) and coverage in 0..1.
pub type ColorImage = Image<[f32; 4]>;

/// An image of one number per pixel.
pub type GreyImage = Image<f32>;

impl<T> Image<T> {
    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        match self {
            Self::Host(field) => (field.width(), field.height()),
            Self::Device(plane) => plane.size(),
        }
    }

    /// Width in pixels.
    #[must_use]
    pub fn width(&self) -> usize {
        self.size().0
    }

    /// Height in pixels.
    #[must_use]
    pub fn height(&self) -> usize {
        self.size().1
    }

    /// The values in the processor's memory. Use this in an operation on the processor.
    ///
    /// # Panics
    /// If the image lives on a graphics device.
    #[must_use]
    pub fn host(&self) -> &Field<T> {
        match self {
            Self::Host(field) => field,
            Self::Device(_) => panic!("{MADE_BY_DEVICE}"),
        }
    }

    /// The plane in device memory. Use this in an operation on a graphics device.
    ///
    /// # Panics
    /// If the image lives in the processor's memory.
    #[must_use]
    pub fn plane(&self) -> &Plane<T> {
        match self {
            Self::Host(_) => panic!("{MADE_BY_HOST}"),
            Self::Device(plane) => plane,
        }
    }
}

impl<T: Clone> Image<T> {
    /// The values in the processor's memory, for you to change in place. This copies them only if
    /// another clone of the image is alive.
    ///
    /// # Panics
    /// If the image lives on a graphics device.
    #[must_use]
    pub fn into_host(self) -> Field<T> {
        match self {
            Self::Host(field) => Arc::unwrap_or_clone(field),
            Self::Device(_) => panic!("{MADE_BY_DEVICE}"),
        }
    }
}

impl<T> From<Field<T>> for Image<T> {
    fn from(field: Field<T>) -> Self {
        Self::Host(Arc::new(field))
    }
}

impl<T> From<Plane<T>> for Image<T> {
    fn from(plane: Plane<T>) -> Self {
        Self::Device(plane)
    }
}

const MADE_BY_DEVICE: &str = "the processor was handed an image of a graphics device";

const MADE_BY_HOST: &str = "a graphics device was handed an image in the processor's memory";

/// Checks that an operation's inputs have the same size as the picture it works on.
///
/// # Panics
/// If `found` is not `wanted`. `what` names the input in the message.
pub fn assert_size(what: &str, found: (usize, usize), wanted: (usize, usize)) {
    assert_eq!(found, wanted, "{what} must have the size of the picture");
}

/// One value of type `T` per pixel in a graphics device's memory, row by row from the top. Clones
/// share the memory. We reuse it for another plane once all of them are dropped.
#[derive(Debug, Clone)]
pub struct Plane<T> {
    buffer: Arc<Buffer>,
    width: usize,
    height: usize,
    pixel: PhantomData<T>,
}

impl<T> Plane<T> {
    fn new(buffer: Arc<Buffer>, width: usize, height: usize) -> Self {
        Self { buffer, width, height, pixel: PhantomData }
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// The device memory that holds the values. Use this to bind it to a kernel.
    #[must_use]
    pub fn buffer(&self) -> &Buffer {
        &self.buffer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_is_copied_only_while_it_is_shared() {
        let image = Image::from(Field::filled(3, 2, 0.5f32));
        let place = image.host().values().as_ptr();
        let other = image.clone();
        let copy = image.into_host();
        assert_ne!(copy.values().as_ptr(), place, "a shared image is copied");
        assert_eq!(other.into_host().values().as_ptr(), place, "the last one is not");
    }

    #[test]
    #[should_panic(expected = "a graphics device was handed an image in the processor's memory")]
    fn a_host_image_has_no_plane() {
        let _ = Image::from(Field::filled(1, 1, 0.0f32)).plane();
    }
}
