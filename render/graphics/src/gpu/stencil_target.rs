//! Depth and stencil of pictures in which faces are counted.

use super::device::{Buffer, Device, one_line};
use super::error::DeviceError;
use super::stencil_pipeline::DEPTH_STENCIL;

/// Depth and stencil of each pixel, and a buffer for the stencil. Clones share its memory.
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

    /// The buffer that the stencil is copied to: one byte per pixel, in rows of
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

/// The least length of a row that WebGPU copies.
fn row_bytes(width: u32) -> u32 {
    width.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}

impl Device {
    /// Whether shaders of this device can add to buffers at the pixels of triangles, which a
    /// [`super::ScatterShader`] does.
    #[must_use]
    pub fn scatters(&self) -> bool {
        let flags = self.adapter().inner.get_downlevel_capabilities().flags;
        flags.contains(wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE)
    }

    /// Allocates depth and stencil of `width` x `height` pixels.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if a side is 0 or beyond the limit of the adapter, or the
    /// adapter has no stencil that can be read back; [`DeviceError::OutOfMemory`] if the
    /// device has no memory left.
    pub fn stencil_target(
        &self,
        width: usize,
        height: usize,
    ) -> Result<StencilTarget, DeviceError> {
        let what = || format!("a stencil of {width} x {height} pixels");
        let most = self.inner.limits().max_texture_dimension_2d as usize;
        if width.max(height) > most || width.min(height) == 0 {
            let reason = format!("its sides may be of 1 to {most}");
            return Err(DeviceError::Refused { what: what(), reason });
        }
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
        let features = self.adapter().inner.get_texture_format_features(DEPTH_STENCIL);
        if !features.allowed_usages.contains(usage) {
            let reason = "this adapter has no stencil that can be read back".to_owned();
            return Err(DeviceError::Refused { what: what(), reason });
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
                    let reason = one_line(&error);
                    return Err(DeviceError::Refused { what: what(), reason });
                }
            }
        }
        self.check("a stencil")?;
        Ok(StencilTarget { texture, view, width, height, rows })
    }
}
