//! Values to the device and back: all of a buffer, or some rows of it.

use std::sync::mpsc::channel;

use super::device::{Buffer, Device};
use super::error::DeviceError;
use crate::tile::Rect;

/// The most that is moved between processor and device at a time.
const CHUNK: u64 = 64 << 20;

/// Where in a buffer values lie, counted in values: rows of the same length, each
/// as far from the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rows {
    /// Where the first begins.
    pub first: usize,
    /// From the beginning of one to that of the next.
    pub stride: usize,
    /// Values in each.
    pub length: usize,
    /// How many there are.
    pub count: usize,
}

impl Rows {
    /// The first `count` values.
    #[must_use]
    pub fn start(count: usize) -> Self {
        Self { first: 0, stride: count, length: count, count: 1 }
    }

    /// The cells of `rect` in a field that is `width` cells wide.
    #[must_use]
    pub fn of(rect: Rect, width: usize) -> Self {
        let first = rect.y * width + rect.x;
        match rect.width == width {
            true => Self { first, ..Self::start(width * rect.height) },
            false => Self { first, stride: width, length: rect.width, count: rect.height },
        }
    }

    /// Bytes of the values before, and of those of each piece of a row: none is
    /// larger than a chunk.
    fn pieces(self, bytes: usize) -> impl Iterator<Item = (u64, u64)> {
        let (row, stride) = ((self.length * bytes) as u64, (self.stride * bytes) as u64);
        let first = (self.first * bytes) as u64;
        (0..self.count as u64).flat_map(move |y| {
            let cuts = (0..row.div_ceil(CHUNK)).map(|cut| cut * CHUNK);
            cuts.map(move |cut| (first + y * stride + cut, CHUNK.min(row - cut)))
        })
    }
}

impl Device {
    /// Puts `values` into `rows` of `buffer`, after all that was submitted.
    ///
    /// # Errors
    /// [`DeviceError::Lost`], or what the driver refuses.
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

    /// Reads the values in `rows` of `buffer`, after all that was submitted; only
    /// they are carried.
    ///
    /// # Errors
    /// [`DeviceError::Lost`], or [`DeviceError::OutOfMemory`] for what carries them.
    pub fn read<T: bytemuck::Pod>(
        &mut self,
        buffer: &Buffer,
        rows: Rows,
    ) -> Result<Vec<T>, DeviceError> {
        let mut values = vec![T::zeroed(); rows.length * rows.count];
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut values);
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        let carrier = self.allocate("readback", CHUNK.min(bytes.len() as u64), usage)?.inner;
        let mut pieces = rows.pieces(size_of::<T>()).peekable();
        let mut done = 0;
        while pieces.peek().is_some() {
            let mut encoder = self.inner.create_command_encoder(&Default::default());
            let mut filled = 0;
            while let Some((start, length)) = pieces.next_if(|(_, length)| filled + length <= CHUNK)
            {
                encoder.copy_buffer_to_buffer(&buffer.inner, start, &carrier, filled, length);
                filled += length;
            }
            let index = self.queue.submit([encoder.finish()]);
            let (tell, told) = channel();
            carrier.map_async(wgpu::MapMode::Read, 0..filled, move |mapped| {
                // The receiver is gone only if the wait failed, which is told.
                let _ = tell.send(mapped.is_ok());
            });
            self.wait(index)?;
            let lost = || DeviceError::Lost { reason: "its memory cannot be read".to_owned() };
            if !told.try_recv().unwrap_or(false) {
                return Err(lost());
            }
            let view = carrier.get_mapped_range(0..filled).map_err(|_| lost())?;
            let end = done + filled as usize;
            bytes[done..end].copy_from_slice(&view);
            drop(view);
            carrier.unmap();
            done = end;
        }
        self.check("a readback")?;
        Ok(values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_a_rectangle_are_its_cells_and_no_piece_passes_a_chunk() {
        let rect = Rect { x: 3, y: 2, width: 4, height: 2 };
        let pieces: Vec<_> = Rows::of(rect, 10).pieces(16).collect();
        assert_eq!(pieces, [(23 * 16, 64), (33 * 16, 64)]);
        let whole = Rect { x: 0, y: 1, width: 10, height: 5 };
        assert_eq!(Rows::of(whole, 10).pieces(4).collect::<Vec<_>>(), [(40, 200)]);
        let long = Rows { first: 1, stride: 1 << 25, length: (1 << 24) + 1, count: 1 };
        let pieces: Vec<_> = long.pieces(4).collect();
        assert_eq!(pieces, [(4, CHUNK), (4 + CHUNK, 4)]);
        assert_eq!(Rows::start(0).pieces(4).count(), 0);
    }
}
