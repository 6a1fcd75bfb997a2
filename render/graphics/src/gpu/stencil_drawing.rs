//! Faces counted in the stencil, and faces that add to buffers.

use super::binding::bind_group;
use super::device::{Buffer, Device};
use super::error::DeviceError;
use super::recording::{List, ScatterDraw, StencilDraw};
use super::stencil::{ScatterShader, StencilShader};
use super::stencil_pipeline::{ScatterPipeline, StencilPipeline};
use super::stencil_target::StencilTarget;

impl Device {
    /// Compiles `shader` unless that was done before.
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

    /// Compiles `shader` unless that was done before.
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

    /// Encodes the drawing of the scene's depth, if it is drawn anew, the counting of faces
    /// behind it, and the copy of the stencil into the rows of the target.
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

    /// Encodes the drawing of faces that add to a buffer.
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
        // A pass needs a picture; this one is neither read nor written.
        let mut pass = begin_pass(encoder, shader.name, target, (None, None));
        pass.set_pipeline(&pipeline.render);
        draw_list(&mut pass, faces, &group);
    }
}

/// Use of the depth and the stencil of the target by a pass.
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
