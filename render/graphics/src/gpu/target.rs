//! Memory that you draw into: pictures of four numbers and a depth per pixel, and stencils in
//! which faces are counted. Also rows of values in a buffer, and copies to and from the processor.

use std::sync::mpsc::channel;

use super::adapter::DeviceError;
use super::device::{Buffer, Device, one_line};
use super::pipelines::{DEPTH, DEPTH_STENCIL, TEXEL, TEXEL_BYTES};
use crate::tile::Rect;

/// A picture to draw into. Clones share this memory.
#[derive(Debug, Clone)]
pub struct Target {
    pub(super) texels: wgpu::Texture,
    pub(super) view: wgpu::TextureView,
    pub(super) depth: wgpu::TextureView,
    pub(super) width: u32,
    pub(super) height: u32,
}

impl Target {
    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.width as usize, self.height as usize)
    }
}

impl Device {
    /// Allocates a target of `width` x `height` pixels.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if a side is 0 or beyond the limit of the adapter,
    /// [`DeviceError::OutOfMemory`] if the device has no memory left.
    pub fn target(&self, width: usize, height: usize) -> Result<Target, DeviceError> {
        let most = self.inner.limits().max_texture_dimension_2d as usize;
        if width.max(height) > most || width.min(height) == 0 {
            return Err(DeviceError::Refused {
                what: format!("a target of {width} x {height} pixels"),
                reason: format!("its sides may be of 1 to {most}"),
            });
        }
        let filters = [wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::OutOfMemory];
        let scopes = filters.map(|filter| self.inner.push_error_scope(filter));
        let width = width as u32;
        let height = height as u32;
        let all = [
            ("texels of a target", TEXEL, wgpu::TextureUsages::COPY_SRC),
            ("depth of a target", DEPTH, wgpu::TextureUsages::empty()),
        ];
        let [texels, depth] = all.map(|(label, format, usage)| {
            self.inner.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        });
        let [view, depth] = [&texels, &depth].map(|it| it.create_view(&Default::default()));
        for scope in scopes.into_iter().rev() {
            match pollster::block_on(scope.pop()) {
                None => {}
                Some(wgpu::Error::OutOfMemory { .. }) => {
                    let bytes = u64::from(width) * u64::from(height) * u64::from(TEXEL_BYTES + 4);
                    return Err(DeviceError::OutOfMemory { what: "a target", bytes });
                }
                Some(error) => {
                    let what = format!("a target of {width} x {height} pixels");
                    return Err(DeviceError::Refused { what, reason: one_line(&error) });
                }
            }
        }
        self.check("a target")?;
        Ok(Target { texels, view, depth, width, height })
    }
}

/// Depth and stencil of each pixel, and a buffer for the stencil. Clones share this memory.
#[derive(Debug, Clone)]
pub struct StencilTarget {
    pub(super) texture: wgpu::Texture,
    pub(super) view: wgpu::TextureView,
    pub(super) width: u32,
    pub(super) height: u32,
    rows: Buffer,
}

impl StencilTarget {
    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.width as usize, self.height as usize)
    }

    /// The buffer that receives the stencil. It has one byte per pixel, in rows of
    /// [`Self::row_bytes`].
    #[must_use]
    pub fn rows(&self) -> &Buffer {
        &self.rows
    }

    /// Bytes from one row of the buffer to the next, a multiple of 256.
    #[must_use]
    pub fn row_bytes(&self) -> u32 {
        row_bytes(self.width)
    }
}

/// WebGPU copies rows of a multiple of this many bytes.
fn row_bytes(width: u32) -> u32 {
    width.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}

impl Device {
    /// Whether you can use a [`super::ScatterShader`] on this device. It adds to buffers at the
    /// pixels of triangles.
    #[must_use]
    pub fn scatters(&self) -> bool {
        let flags = self.adapter().inner.get_downlevel_capabilities().flags;
        flags.contains(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE)
    }

    /// Allocates depth and stencil of `width` x `height` pixels.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if a side is 0 or beyond the limit of the adapter, or the adapter
    /// has no stencil that can be read back, [`DeviceError::OutOfMemory`] if the device has no
    /// memory left.
    pub fn stencil_target(
        &self,
        width: usize,
        height: usize,
    ) -> Result<StencilTarget, DeviceError> {
        let what = format!("a stencil of {width} x {height} pixels");
        let most = self.inner.limits().max_texture_dimension_2d as usize;
        if width.max(height) > most || width.min(height) == 0 {
            let reason = format!("its sides may be of 1 to {most}");
            return Err(DeviceError::Refused { what, reason });
        }
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
        let features = self.adapter().inner.get_texture_format_features(DEPTH_STENCIL);
        if !features.allowed_usages.contains(usage) {
            let reason = "this adapter has no stencil that can be read back".to_owned();
            return Err(DeviceError::Refused { what, reason });
        }
        let width = width as u32;
        let height = height as u32;
        let bytes = u64::from(row_bytes(width)) * u64::from(height);
        let rows = self.buffer("rows of a stencil", bytes)?;
        let filters = [wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::OutOfMemory];
        let scopes = filters.map(|filter| self.inner.push_error_scope(filter));
        let texture = self.inner.create_texture(&wgpu::TextureDescriptor {
            label: Some("depth and stencil"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: DEPTH_STENCIL,
            usage,
            view_formats: &[],
        });
        let view = texture.create_view(&Default::default());
        for scope in scopes.into_iter().rev() {
            match pollster::block_on(scope.pop()) {
                None => {}
                Some(wgpu::Error::OutOfMemory { .. }) => {
                    let bytes = u64::from(width) * u64::from(height) * 8;
                    return Err(DeviceError::OutOfMemory { what: "a stencil", bytes });
                }
                Some(error) => {
                    return Err(DeviceError::Refused { what, reason: one_line(&error) });
                }
            }
        }
        self.check("a stencil")?;
        Ok(StencilTarget { texture, view, width, height, rows })
    }
}

/// Largest transfer between processor and device at a time, in bytes.
pub(super) const CHUNK: u64 = 64 << 20;

/// A set of values in a buffer: rows of equal length at equal distances. All members count values,
/// not bytes. For example, [`Self::of`] describes a rectangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rows {
    /// Offset of the first row.
    pub first: usize,
    /// Distance between the starts of two neighbouring rows.
    pub stride: usize,
    /// Number of values per row.
    pub length: usize,
    /// Number of rows.
    pub count: usize,
}

impl Rows {
    /// The first `count` values of a buffer.
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

    /// Offset and length in bytes of each piece to transfer, for values of `bytes` each. This cuts
    /// rows longer than [`CHUNK`] into several pieces.
    pub(super) fn pieces(self, bytes: usize) -> impl Iterator<Item = (u64, u64)> {
        let row = (self.length * bytes) as u64;
        let stride = (self.stride * bytes) as u64;
        let first = (self.first * bytes) as u64;
        (0..self.count as u64).flat_map(move |y| {
            let cuts = (0..row.div_ceil(CHUNK)).map(|cut| cut * CHUNK);
            cuts.map(move |cut| (first + y * stride + cut, CHUNK.min(row - cut)))
        })
    }
}

impl Device {
    /// Allocates a buffer and writes `values` to it. `what` names them in errors.
    ///
    /// # Errors
    /// [`DeviceError::TooLarge`] beyond the limit of the adapter, [`DeviceError::OutOfMemory`] if
    /// the device has no memory left, [`DeviceError::Lost`] if it was lost.
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

    /// Reads the values in `rows` of `buffer`, after all earlier submissions. This transfers only
    /// these rows.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] if the device was lost, [`DeviceError::OutOfMemory`] if there is no
    /// memory for the staging buffer.
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
            fn lost() -> DeviceError {
                DeviceError::Lost("its memory cannot be read".to_owned())
            }
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
