//! Images in the memory of whatever computes on them.

use std::sync::Arc;

use super::plane::Plane;
use crate::field::Field;

/// One value of type `T` per pixel, in the memory of the [`super::Compute`] that made it.
///
/// An image is only of use to that `Compute`: operations panic if they are handed an image
/// of the other form, and a graphics device refuses the memory of another device. Clones
/// share memory.
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

    /// The values in the processor's memory, for an operation on the processor.
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

    /// The plane in device memory, for an operation on a graphics device.
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
    /// The values in the processor's memory, to be changed in place. They are copied only
    /// if another clone of the image is alive.
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
    /// An image in the processor's memory.
    fn from(field: Field<T>) -> Self {
        Self::Host(Arc::new(field))
    }
}

impl<T> From<Plane<T>> for Image<T> {
    /// An image in device memory.
    fn from(plane: Plane<T>) -> Self {
        Self::Device(plane)
    }
}

const MADE_BY_DEVICE: &str = "the processor was handed an image of a graphics device";

const MADE_BY_HOST: &str = "a graphics device was handed an image in the processor's memory";

/// Checks that an operation's inputs have the same size as the picture it works on.
///
/// # Panics
/// If `found` is not `wanted`; `what` names the input in the message.
pub fn assert_size(what: &str, found: (usize, usize), wanted: (usize, usize)) {
    assert_eq!(found, wanted, "{what} must have the size of the picture");
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
