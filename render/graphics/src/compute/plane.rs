//! Pixel values in the memory of a graphics device.

use std::marker::PhantomData;
use std::sync::Arc;

use crate::gpu::Buffer;

/// One value of type `T` per pixel in a graphics device's memory, row by row from the
/// top. Clones share the memory; it is reused for another plane once all are dropped.
#[derive(Debug, Clone)]
pub struct Plane<T> {
    buffer: Arc<Buffer>,
    width: usize,
    height: usize,
    pixel: PhantomData<T>,
}

impl<T> Plane<T> {
    /// A plane over `buffer`, which has at least `width` x `height` values.
    pub(super) fn new(buffer: Arc<Buffer>, width: usize, height: usize) -> Self {
        Self { buffer, width, height, pixel: PhantomData }
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// The device memory that holds the values, for binding it to a kernel.
    #[must_use]
    pub fn buffer(&self) -> &Buffer {
        &self.buffer
    }
}
