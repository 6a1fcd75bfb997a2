//! Values copied between the processor and buffers of the device.

use std::sync::mpsc::channel;

use super::device::{Buffer, Device};
use super::error::DeviceError;
use super::rows::{CHUNK, Rows};

impl Device {
    /// Allocates a buffer that holds `values`; `what` names them in errors.
    ///
    /// # Errors
    /// [`DeviceError::TooLarge`] beyond the limit of the adapter,
    /// [`DeviceError::OutOfMemory`] if the device has no memory left, [`DeviceError::Lost`]
    /// if it was lost.
    pub fn buffer_of<T: bytemuck::Pod>(
        &mut self,
        what: &'static str,
        values: &[T],
    ) -> Result<Buffer, DeviceError> {
        let buffer = self.buffer(what, size_of_val(values) as u64)?;
        self.write(&buffer, Rows::start(values.len()), values)?;
        Ok(buffer)
    }

    /// Writes `values` to `rows` of `buffer`, after all earlier submissions.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] if the device was lost, [`DeviceError::Refused`] if the driver
    /// rejects the write.
    pub fn write<T: bytemuck::Pod>(
        &mut self,
        buffer: &Buffer,
        rows: Rows,
        values: &[T],
    ) -> Result<(), DeviceError> {
        let mut rest: &[u8] = bytemuck::cast_slice(values);
        let mut waiting = 0;
        for (start, length) in rows.pieces(size_of::<T>()) {
            let (piece, after) = rest.split_at(length as usize);
            self.queue.write_buffer(&buffer.inner, start, piece);
            rest = after;
            waiting += length;
            if waiting >= CHUNK {
                let index = self.queue.submit([]);
                self.wait(index)?;
                waiting = 0;
            }
        }
        self.check("a write")
    }

    /// Reads the values in `rows` of `buffer`, after all earlier submissions. Only these rows
    /// are transferred.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] if the device was lost, [`DeviceError::OutOfMemory`] if there is
    /// no memory for the staging buffer.
    pub fn read<T: bytemuck::Pod>(
        &mut self,
        buffer: &Buffer,
        rows: Rows,
    ) -> Result<Vec<T>, DeviceError> {
        let mut values = vec![T::zeroed(); rows.length * rows.count];
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut values);
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        let staging = self.allocate("readback", CHUNK.min(bytes.len() as u64), usage)?.inner;
        let mut pieces = rows.pieces(size_of::<T>()).peekable();
        let mut done = 0;
        while pieces.peek().is_some() {
            let mut encoder = self.inner.create_command_encoder(&Default::default());
            let mut filled = 0;
            while let Some((start, length)) = pieces.next_if(|(_, length)| filled + length <= CHUNK)
            {
                encoder.copy_buffer_to_buffer(&buffer.inner, start, &staging, filled, length);
                filled += length;
            }
            let index = self.queue.submit([encoder.finish()]);
            let (sender, receiver) = channel();
            staging.map_async(wgpu::MapMode::Read, 0..filled, move |mapped| {
                // The receiver is gone only if the wait failed, which returns an error.
                let _ = sender.send(mapped.is_ok());
            });
            self.wait(index)?;
            let lost = || DeviceError::Lost { reason: "its memory cannot be read".to_owned() };
            if !receiver.try_recv().unwrap_or(false) {
                return Err(lost());
            }
            let view = staging.get_mapped_range(0..filled).map_err(|_| lost())?;
            let end = done + filled as usize;
            bytes[done..end].copy_from_slice(&view);
            drop(view);
            staging.unmap();
            done = end;
        }
        self.check("a readback")?;
        Ok(values)
    }
}
