//! Pictures that triangles are drawn into: four numbers and a depth per pixel.

use super::device::{Device, one_line};
use super::error::DeviceError;
use super::raster_pipeline::{DEPTH, TEXEL, TEXEL_BYTES};

/// A picture to draw into. Clones share its memory.
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
        let texture = |label, format, usage| {
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
        };
        let texels = texture("texels of a target", TEXEL, wgpu::TextureUsages::COPY_SRC);
        let depth = texture("depth of a target", DEPTH, wgpu::TextureUsages::empty());
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
