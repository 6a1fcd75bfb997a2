//! Triangles drawn into targets.

use super::binding::bind_group;
use super::device::{Buffer, Device};
use super::error::DeviceError;
use super::raster::RasterShader;
use super::raster_pipeline::{RasterPipeline, TEXEL_BYTES};
use super::recording::Draw;

impl Device {
    /// Compiles `shader` unless that was done before.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if the driver rejects the shader.
    pub(super) fn prepare_raster(
        &mut self,
        shader: &'static RasterShader,
        front_only: bool,
    ) -> Result<(), DeviceError> {
        if self.raster_pipelines.contains_key(&(shader.name, front_only)) {
            return Ok(());
        }
        let pipeline = self.compile(
            || format!("raster shader `{}`", shader.name),
            |device: &wgpu::Device| RasterPipeline::compile(device, shader, front_only),
        )?;
        self.check(shader.name)?;
        self.raster_pipelines.insert((shader.name, front_only), pipeline);
        Ok(())
    }

    /// Encodes the drawing of triangles and the copy of the picture into a buffer.
    pub(super) fn encode_draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        draw: &Draw,
        parameters: &Buffer,
    ) {
        let Draw { shader, target, .. } = draw;
        let pipeline = &self.raster_pipelines[&(shader.name, draw.front_only)];
        let group = bind_group(
            &self.inner,
            shader.name,
            &pipeline.layout,
            (&parameters.inner, shader.parameters.bytes),
            draw.buffers.iter().map(|buffer| &buffer.inner),
        );
        let [r, g, b, a] = draw.background.map(f64::from);
        let clear = wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(shader.name),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: clear, store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &target.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_pipeline(&pipeline.render);
        pass.set_bind_group(0, &group, &[draw.parameters]);
        pass.draw(0..3 * draw.triangles, 0..1);
        drop(pass);
        copy_texels(encoder, draw);
    }
}

/// Copies the target into a buffer without gaps between rows. WebGPU copies several rows at
/// once only if each has a multiple of 256 bytes; others are copied one by one.
fn copy_texels(encoder: &mut wgpu::CommandEncoder, Draw { target, into, .. }: &Draw) {
    let row_bytes = target.width * TEXEL_BYTES;
    let at_once = match row_bytes % wgpu::COPY_BYTES_PER_ROW_ALIGNMENT {
        0 => target.height,
        _ => 1,
    };
    for y in (0..target.height).step_by(at_once as usize) {
        let mut from = target.texels.as_image_copy();
        from.origin.y = y;
        let layout = wgpu::TexelCopyBufferLayout {
            offset: u64::from(y) * u64::from(row_bytes),
            bytes_per_row: (at_once > 1).then_some(row_bytes),
            rows_per_image: None,
        };
        let to = wgpu::TexelCopyBufferInfo { buffer: &into.inner, layout };
        let size =
            wgpu::Extent3d { width: target.width, height: at_once, depth_or_array_layers: 1 };
        encoder.copy_texture_to_buffer(from, to, size);
    }
}
