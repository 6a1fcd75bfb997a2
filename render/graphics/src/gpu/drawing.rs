//! Raster shaders made ready, and triangles drawn.

use super::device::{Buffer, Device, one_line};
use super::error::DeviceError;
use super::raster::RasterShader;
use super::recording::Draw;
use super::target::{DEPTH, TEXEL, TEXEL_BYTES};

/// A raster shader as the driver compiled it, for one choice of sides.
#[derive(Debug, Clone)]
pub(super) struct RasterPipeline {
    render: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl Device {
    /// Compiles `shader` unless it is; by itself when first drawn with.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if the driver does not take it.
    pub(super) fn prepare_raster(
        &mut self,
        shader: &'static RasterShader,
        front_only: bool,
    ) -> Result<(), DeviceError> {
        if self.raster_pipelines.contains_key(&(shader.name, front_only)) {
            return Ok(());
        }
        let scopes = [wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::Internal]
            .map(|filter| self.inner.push_error_scope(filter));
        let pipeline = self.compile_raster(shader, front_only);
        for scope in scopes.into_iter().rev() {
            if let Some(error) = pollster::block_on(scope.pop()) {
                let what = format!("raster shader `{}`", shader.name);
                return Err(DeviceError::Refused { what, reason: one_line(&error) });
            }
        }
        self.check(shader.name)?;
        self.raster_pipelines.insert((shader.name, front_only), pipeline);
        Ok(())
    }

    fn compile_raster(&self, shader: &'static RasterShader, front_only: bool) -> RasterPipeline {
        let label = Some(shader.name);
        let entry = |binding: u32, ty, has_dynamic_offset, bytes| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty,
                has_dynamic_offset,
                min_binding_size: std::num::NonZero::new(bytes),
            },
            count: None,
        };
        let bytes = shader.parameters.bytes as u64;
        let mut entries = vec![entry(0, wgpu::BufferBindingType::Uniform, true, bytes)];
        let read = wgpu::BufferBindingType::Storage { read_only: true };
        entries.extend((1..=shader.buffers as u32).map(|binding| entry(binding, read, false, 0)));
        let layout = self.inner.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label,
            entries: &entries,
        });
        let module = self.inner.create_shader_module(wgpu::ShaderModuleDescriptor {
            label,
            source: wgpu::ShaderSource::Wgsl(shader.source.into()),
        });
        let whole = self.inner.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label,
            bind_group_layouts: &[Some(&layout)],
            ..wgpu::PipelineLayoutDescriptor::default()
        });
        let render = self.inner.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label,
            layout: Some(&whole),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("corner"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState {
                cull_mode: front_only.then_some(wgpu::Face::Back),
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("pixel"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(TEXEL.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        RasterPipeline { render, layout }
    }

    /// Draws, then copies what was drawn into a buffer.
    pub(super) fn encode_draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        draw: &Draw,
        parameters: &Buffer,
    ) {
        let Draw { shader, target, .. } = draw;
        let pipeline = &self.raster_pipelines[&(shader.name, draw.front_only)];
        let group = self.bind(
            shader.name,
            &pipeline.layout,
            (parameters, shader.parameters.bytes),
            &draw.buffers.iter().collect::<Vec<_>>(),
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

/// Copies the target into a buffer without gaps between rows. The device copies
/// only rows of a multiple of 256 bytes at once; others go one by one.
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
