//! Render pipelines for textured and coloured quads, and for the meshes of the interface.

use eframe::egui_wgpu::{CallbackResources, wgpu};
use wgpu::util::DeviceExt;
use wgpu::{
    AddressMode, BindGroup, BindGroupLayout, Buffer, Device, FilterMode, RenderPipeline, Sampler,
    ShaderStages, Texture, TextureFormat, TextureSampleType,
};

/// Size of a vertex in bytes: position and texture coordinates as four `f32`, and the
/// colour.
pub(super) const VERTEX_BYTES: usize = 20;

pub(super) struct Pipelines {
    pub(super) format: TextureFormat,
    /// Draws a texture.
    pub(super) textured: RenderPipeline,
    /// Draws the interpolated colours of the vertices.
    pub(super) flat_color: RenderPipeline,
    /// Draws a texture times the colours of the vertices, premultiplied, over the picture so far.
    pub(super) blended: RenderPipeline,
    layout: BindGroupLayout,
    /// Nearest-neighbour and linear filtering.
    samplers: [Sampler; 2],
}

impl Pipelines {
    /// Builds the pipelines for targets of this format.
    pub(super) fn new(device: &Device, format: TextureFormat) -> Self {
        let module = device.create_shader_module(wgpu::include_wgsl!("quad.wgsl"));
        let visibility = ShaderStages::FRAGMENT;
        let texture = wgpu::BindingType::Texture {
            sample_type: TextureSampleType::Float { filterable: true },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("textured quads"),
            entries: &[(0, texture), (1, sampler)].map(|(binding, ty)| {
                wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
            }),
        });
        let attributes = wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Unorm8x4];
        // egui works in encoded values. A target with an sRGB format encodes values that we write,
        // so the shader must decode them first.
        let constants = [("output_is_linear", f64::from(u8::from(format.is_srgb())))];
        let pipeline = |fragment: &str, groups: &[Option<&BindGroupLayout>], blend| {
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
                    entry_point: Some("vertex_main"),
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
                    targets: &[Some(wgpu::ColorTargetState { blend, ..format.into() })],
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        let samplers = [FilterMode::Nearest, FilterMode::Linear].map(|filter| {
            device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("textured quads"),
                address_mode_u: AddressMode::ClampToEdge,
                address_mode_v: AddressMode::ClampToEdge,
                mag_filter: filter,
                min_filter: filter,
                ..wgpu::SamplerDescriptor::default()
            })
        });
        let textured = pipeline("textured", &[Some(&layout)], None);
        let flat_color = pipeline("flat_color", &[], None);
        let over = Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING);
        let blended = pipeline("blended", &[Some(&layout)], over);
        Self { format, textured, flat_color, blended, layout, samplers }
    }

    /// The pipelines for targets of this format, kept in `resources`. We build them when you first
    /// ask for them.
    pub(super) fn of<'a>(
        device: &Device,
        format: TextureFormat,
        resources: &'a mut CallbackResources,
    ) -> &'a Self {
        if resources.get().is_none_or(|kept: &Self| kept.format != format) {
            resources.insert(Self::new(device, format));
        }
        resources.entry::<Self>().or_insert_with(|| Self::new(device, format))
    }

    /// Creates a texture of `size` cells, with a bind group for each sampler.
    pub(super) fn texture(&self, device: &Device, size: [usize; 2]) -> (Texture, [BindGroup; 2]) {
        let [width, height] = size.map(|cells| cells as u32);
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("textured quads"),
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
                label: Some("textured quads"),
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

pub(super) fn vertex_buffer(device: &Device, bytes: &[u8]) -> Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("vertices of textured quads"),
        contents: bytes,
        usage: wgpu::BufferUsages::VERTEX,
    })
}
