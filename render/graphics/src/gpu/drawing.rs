//! Draws triangles into targets, counts faces in the stencil, and adds the values of faces to
//! buffers.

use super::adapter::DeviceError;
use super::device::{Buffer, Device};
use super::pipelines::{
    RasterPipeline, RasterShader, ScatterPipeline, ScatterShader, StencilPipeline, StencilShader,
    TEXEL_BYTES, bind_group,
};
use super::recording::{Draw, List, ScatterDraw, StencilDraw};
use super::target::StencilTarget;

impl Device {
    /// Compiles `shader` unless this was done before.
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

/// Copies the target into a buffer without gaps between rows. WebGPU copies several rows at once
/// only if each has a multiple of 256 bytes. We copy others one by one.
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

impl Device {
    /// Compiles `shader` unless this was done before.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if the driver rejects the shader.
    pub(super) fn prepare_stencil(
        &mut self,
        shader: &'static StencilShader,
    ) -> Result<(), DeviceError> {
        if self.stencil_pipelines.contains_key(shader.name) {
            return Ok(());
        }
        let pipeline = self.compile(
            || format!("stencil shader `{}`", shader.name),
            |device| StencilPipeline::compile(device, shader),
        )?;
        self.check(shader.name)?;
        self.stencil_pipelines.insert(shader.name, pipeline);
        Ok(())
    }

    /// Compiles `shader` unless this was done before.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if the driver rejects the shader.
    pub(super) fn prepare_scatter(
        &mut self,
        shader: &'static ScatterShader,
    ) -> Result<(), DeviceError> {
        if self.scatter_pipelines.contains_key(shader.name) {
            return Ok(());
        }
        let pipeline = self.compile(
            || format!("shader `{}`", shader.name),
            |device| ScatterPipeline::compile(device, shader),
        )?;
        self.check(shader.name)?;
        self.scatter_pipelines.insert(shader.name, pipeline);
        Ok(())
    }

    /// Encodes three steps: draws the depth of the scene if the draw has one, counts faces behind
    /// it, and copies the stencil into the rows of the target.
    pub(super) fn encode_stencil(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        draw: &StencilDraw,
        parameters: &Buffer,
    ) {
        let StencilDraw { shader, scene, faces, target } = draw;
        let pipeline = &self.stencil_pipelines[shader.name];
        let group = |list: &List| {
            let parameters = (&parameters.inner, shader.parameters.bytes);
            let buffers = list.buffers.iter().map(|buffer| &buffer.inner);
            bind_group(&self.inner, shader.name, &pipeline.layout, parameters, buffers)
        };
        let load = match scene {
            Some(_) => wgpu::LoadOp::Clear(1.0),
            None => wgpu::LoadOp::Load,
        };
        let store = wgpu::StoreOp::Store;
        let depth_ops = Some(wgpu::Operations { load, store });
        let stencil_ops = Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0), store });
        let mut pass = begin_pass(encoder, shader.name, target, (depth_ops, stencil_ops));
        if let Some(scene) = scene {
            pass.set_pipeline(&pipeline.scene);
            draw_list(&mut pass, scene, &group(scene));
        }
        pass.set_pipeline(&pipeline.faces);
        draw_list(&mut pass, faces, &group(faces));
        drop(pass);
        copy_stencil(encoder, target);
    }

    pub(super) fn encode_scatter(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        draw: &ScatterDraw,
        parameters: &Buffer,
    ) {
        let ScatterDraw { shader, faces, target } = draw;
        let pipeline = &self.scatter_pipelines[shader.name];
        let group = bind_group(
            &self.inner,
            shader.name,
            &pipeline.layout,
            (&parameters.inner, shader.parameters.bytes),
            faces.buffers.iter().map(|buffer| &buffer.inner),
        );
        // A pass needs a picture, but this pass neither reads nor writes it.
        let mut pass = begin_pass(encoder, shader.name, target, (None, None));
        pass.set_pipeline(&pipeline.render);
        draw_list(&mut pass, faces, &group);
    }
}

/// How a pass uses the depth and the stencil of the target.
type Uses = (Option<wgpu::Operations<f32>>, Option<wgpu::Operations<u32>>);

fn begin_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    name: &'static str,
    target: &StencilTarget,
    (depth_ops, stencil_ops): Uses,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(name),
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &target.view,
            depth_ops,
            stencil_ops,
        }),
        ..wgpu::RenderPassDescriptor::default()
    })
}

fn draw_list(pass: &mut wgpu::RenderPass<'_>, list: &List, group: &wgpu::BindGroup) {
    pass.set_bind_group(0, group, &[list.parameters]);
    pass.draw(3 * list.triangles.start..3 * list.triangles.end, 0..1);
}

fn copy_stencil(encoder: &mut wgpu::CommandEncoder, target: &StencilTarget) {
    let from = wgpu::TexelCopyTextureInfo {
        aspect: wgpu::TextureAspect::StencilOnly,
        ..target.texture.as_image_copy()
    };
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(target.row_bytes()),
        rows_per_image: None,
    };
    let to = wgpu::TexelCopyBufferInfo { buffer: &target.rows().inner, layout };
    let width = target.width;
    let height = target.height;
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    encoder.copy_texture_to_buffer(from, to, size);
}
