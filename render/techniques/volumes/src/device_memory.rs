//! Memory of a graphics device that lasts from step to step.

use graphics::gpu::{Buffer, Device, DeviceError, Rows};

/// A buffer that grows with its content.
#[derive(Debug, Default)]
pub(crate) struct DeviceMemory {
    buffer: Option<(Buffer, u64)>,
}

impl DeviceMemory {
    /// A buffer of at least `bytes`. You find the content of the last call there, or zeros. `what`
    /// names the buffer in errors.
    ///
    /// # Errors
    /// [`DeviceError`] for more than the device lends or has left.
    pub(crate) fn of_bytes(
        &mut self,
        device: &Device,
        what: &'static str,
        bytes: usize,
    ) -> Result<Buffer, DeviceError> {
        let bytes = bytes as u64;
        if let Some((buffer, size)) = &self.buffer
            && *size >= bytes
        {
            return Ok(buffer.clone());
        }
        // We give back the old one first.
        self.buffer = None;
        let enlarged = (bytes + bytes / 2).min(device.adapter().limits.binding_bytes).max(bytes);
        let buffer = device.buffer(what, enlarged)?;
        self.buffer = Some((buffer.clone(), enlarged));
        Ok(buffer)
    }

    /// A buffer that begins with these values.
    pub(crate) fn holding<T: bytemuck::Pod>(
        &mut self,
        device: &mut Device,
        what: &'static str,
        values: &[T],
    ) -> Result<Buffer, DeviceError> {
        let buffer = self.of_bytes(device, what, size_of_val(values))?;
        device.write(&buffer, Rows::start(values.len()), values)?;
        Ok(buffer)
    }
}
