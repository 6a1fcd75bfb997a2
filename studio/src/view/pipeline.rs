//! What the graphics device needs to draw sheets.

use eframe::egui_wgpu::wgpu;
use wgpu::util::DeviceExt;
use wgpu::{
    AddressMode, BindGroup, BindGroupLayout, Buffer, Device, FilterMode, RenderPipeline, Sampler,
    ShaderStages, Texture, TextureFormat, TextureSampleType,
};

/// Bytes of a vertex: position and place as four numbers, and the colour.
pub(super) const VERTEX_BYTES: usize = 20;

/// The pipelines, for one kind of pixels.
pub(super) struct Pipelines {
    /// Of which pixels.
    pub(super) format: TextureFormat,
    /// Draws a sheet.
    pub(super) picture: RenderPipeline,
    /// Draws the vertices' colours.
    pub(super) even: RenderPipeline,
    layout: BindGroupLayout,
    /// For squares, and for cells that blend.
    samplers: [Sampler; 2],
}

impl Pipelines {
    /// Pipelines that draw on such pixels.
    pub(super) fn new(device: &Device, format: TextureFormat) -> Self {
        let module = device.create_shader_module(wgpu::include_wgsl!("sheet.wgsl"));
        let visibility = ShaderStages::FRAGMENT;
        let entry =
            |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
        let texture = wgpu::BindingType::Texture {
            sample_type: TextureSampleType::Float { filterable: true },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("sheet"),
            entries: &[entry(0, texture), entry(1, sampler)],
        });
        let attributes = wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Unorm8x4];
        // egui's pixels are encoded; those of some windows are encoded when written.
        let constants = [("decodes", f64::from(u8::from(format.is_srgb())))];
        let pipeline = |fragment: &str, groups: &[Option<&BindGroupLayout>]| {
            let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(fragment),
                bind_group_layouts: groups,
                immediate_size: 0,
            });
            let options = wgpu::PipelineCompilationOptions {
                constants: &constants,
                ..wgpu::PipelineCompilationOptions::default()
            };
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(fragment),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("corner"),
                    compilation_options: options.clone(),
                    buffers: &[Some(wgpu::VertexBufferLayout {
                        array_stride: VERTEX_BYTES as u64,
                        step_mode: wgpu::VertexStepMode::Vertex,
                        attributes: &attributes,
                    })],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(fragment),
                    compilation_options: options,
                    targets: &[Some(format.into())],
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        let samplers = [FilterMode::Nearest, FilterMode::Linear].map(|filter| {
            device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("sheet"),
                address_mode_u: AddressMode::ClampToEdge,
                address_mode_v: AddressMode::ClampToEdge,
                mag_filter: filter,
                min_filter: filter,
                ..wgpu::SamplerDescriptor::default()
            })
        });
        let picture = pipeline("picture", &[Some(&layout)]);
        let even = pipeline("even", &[]);
        Self { format, picture, even, layout, samplers }
    }

    /// A texture of so many cells, and it bound with each of the samplers.
    pub(super) fn texture(&self, device: &Device, size: [usize; 2]) -> (Texture, [BindGroup; 2]) {
        let [width, height] = size.map(|cells| cells as u32);
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("sheet"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let bound = self.samplers.each_ref().map(|sampler| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("sheet"),
                layout: &self.layout,
                entries: &[
                    wgpu::BindGroupEntry {
                        binding: 0,
                        resource: wgpu::BindingResource::TextureView(&view),
                    },
                    wgpu::BindGroupEntry {
                        binding: 1,
                        resource: wgpu::BindingResource::Sampler(sampler),
                    },
                ],
            })
        });
        (texture, bound)
    }
}

/// A buffer of vertices.
pub(super) fn vertex_buffer(device: &Device, bytes: &[u8]) -> Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("sheets' corners"),
        contents: bytes,
        usage: wgpu::BufferUsages::VERTEX,
    })
}
