//! Where pictures live while they are worked on: with the processor, or on a
//! device. What is done to them are traits above this one, a concept each.

use crate::field::Field;
use crate::gpu::DeviceError;

/// Keeps pictures. Both backends take the same steps in the same order.
pub trait Backend {
    /// Encoded sRGB and coverage of every pixel.
    type Color: std::fmt::Debug;
    /// A number for every pixel.
    type Grey: std::fmt::Debug;

    /// For people: `cpu`, or the adapter.
    fn name(&self) -> String;

    /// Takes a picture in.
    ///
    /// # Errors
    /// [`DeviceError`] if the device has no room or is lost; never on the processor.
    fn color_of(&mut self, field: &Field<[f32; 4]>) -> Result<Self::Color, DeviceError>;

    /// Takes numbers in.
    ///
    /// # Errors
    /// As [`Backend::color_of`].
    fn grey_of(&mut self, field: &Field<f32>) -> Result<Self::Grey, DeviceError>;

    /// The picture.
    ///
    /// # Errors
    /// As [`Backend::color_of`].
    fn color_field(&mut self, color: &Self::Color) -> Result<Field<[f32; 4]>, DeviceError>;

    /// The numbers.
    ///
    /// # Errors
    /// As [`Backend::color_of`].
    fn grey_field(&mut self, grey: &Self::Grey) -> Result<Field<f32>, DeviceError>;
}
