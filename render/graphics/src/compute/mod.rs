//! Computation of images on the processor or on a graphics device.
//!
//! [`Compute`] is a value, chosen once when a program starts. An operation on images is a
//! plain function over `&mut Compute`; it has two forms, one for the processor and one
//! that records a kernel. Both take the same steps in the same order and stand in one
//! file, with the WGSL source of the kernel beside it.
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

mod plane;
mod image;
mod gpu_compute;

pub use gpu_compute::GpuCompute;
pub use image::{ColorImage, GreyImage, Image, assert_size};
pub use plane::Plane;

use crate::field::Field;
use crate::gpu::{BackendChoice, Device, DeviceError, choose};

/// The processor or a graphics device, which computes images and holds them in its memory.
#[derive(Debug)]
pub enum Compute {
    /// The processor: rows of pixels on all cores.
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

    /// Computes on the processor or the device that `choice` selects: `Auto` selects the
    /// processor if no hardware adapter can be opened.
    ///
    /// # Errors
    /// Only for [`BackendChoice::Gpu`]: [`DeviceError::NoAdapter`] if there is no usable
    /// adapter, or the driver's error if it cannot be opened.
    pub fn choose(choice: BackendChoice) -> Result<Self, DeviceError> {
        Ok(choose(choice)?.map_or(Self::Cpu, Self::gpu))
    }

    /// Name to show to people: `cpu`, or that of the graphics adapter.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Cpu => "cpu",
            Self::Gpu(gpu) => &gpu.device().adapter().name,
        }
    }

    /// The graphics device; `None` on the processor.
    #[must_use]
    pub fn device(&self) -> Option<&Device> {
        match self {
            Self::Cpu => None,
            Self::Gpu(gpu) => Some(gpu.device()),
        }
    }

    /// Returns the graphics device for another use; `None` on the processor. Images made on
    /// it are lost.
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
    /// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
    pub fn upload<T: bytemuck::Pod>(&mut self, field: &Field<T>) -> Result<Image<T>, DeviceError> {
        match self {
            Self::Cpu => Ok(field.clone().into()),
            Self::Gpu(gpu) => gpu.upload(field).map(Image::from),
        }
    }

    /// Moves `field` into the memory of the processor, or copies it to that of the device.
    ///
    /// # Errors
    /// [`DeviceError`] if a device has no memory left or was lost; never on the processor.
    pub fn give<T: bytemuck::Pod>(&mut self, field: Field<T>) -> Result<Image<T>, DeviceError> {
        match self {
            Self::Cpu => Ok(field.into()),
            Self::Gpu(gpu) => gpu.upload(&field).map(Image::from),
        }
    }

    /// Copies an image back to a field.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost; never on the processor.
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

    /// The values of an image. They are copied only from a device, or if another clone of the
    /// image is alive.
    ///
    /// # Errors
    /// [`DeviceError`] if the device was lost; never on the processor.
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
