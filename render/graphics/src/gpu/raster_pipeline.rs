//! Compiled raster shaders, and the formats of the pictures they draw into.

use super::binding::bind_group_layout;
use super::raster::RasterShader;

/// Format of a drawn pixel: four 32-bit numbers.
pub(super) const TEXEL: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

/// Format of the depth buffer: 0 (near) to 1 (far).
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Size of a drawn pixel in bytes.
pub(super) const TEXEL_BYTES: u32 = 16;

/// A raster shader compiled by the driver, with or without culling of back faces.
#[derive(Debug, Clone)]
pub(super) struct RasterPipeline {
    pub(super) render: wgpu::RenderPipeline,
    pub(super) layout: wgpu::BindGroupLayout,
}

impl RasterPipeline {
    /// Compiles `shader`. The driver reports errors through the error scopes of `device`.
    pub(super) fn compile(
        device: &wgpu::Device,
        shader: &'static RasterShader,
        front_only: bool,
    ) -> Self {
        let label = Some(shader.name);
        let layout = bind_group_layout(
            device,
            shader.name,
            wgpu::ShaderStages::VERTEX_FRAGMENT,
            shader.parameters.bytes,
            std::iter::repeat_n(true, shader.buffers),
        );
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label,
            source: wgpu::ShaderSource::Wgsl(shader.source.into()),
        });
        let whole = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label,
            bind_group_layouts: &[Some(&layout)],
            ..wgpu::PipelineLayoutDescriptor::default()
        });
        let render = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
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
        Self { render, layout }
    }
}
