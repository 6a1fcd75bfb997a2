//! Kernels and shaders as data (WGSL source and bindings), and their pipelines, which the driver
//! compiles.
//!
//! A kernel or shader has its parameters at binding 0 and its storage buffers from 1 on. If Rust
//! and WGSL share a struct, a [`Layout`] describes it.

use std::num::NonZero;

/// Name, size and field offsets of a struct in Rust. A test compares this with the WGSL struct of
/// the same name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layout {
    /// Name of the struct, equal in both languages.
    pub name: &'static str,
    /// Size of the struct in bytes.
    pub bytes: usize,
    /// Name of each field and its offset in bytes.
    pub fields: &'static [(&'static str, usize)],
}

/// The [`Layout`] of a `repr(C)` struct. You must list all its fields, in any order. Otherwise
/// this does not compile.
#[macro_export]
macro_rules! layout {
    ($type:ident { $($field:ident),* $(,)? }) => {{
        const _: fn($type) = |value| { let $type { $($field: _),* } = value; };
        $crate::gpu::Layout {
            name: stringify!($type),
            bytes: size_of::<$type>(),
            fields: &[$((stringify!($field), std::mem::offset_of!($type, $field))),*],
        }
    }};
}

pub use layout;

/// Width and height of a workgroup, in invocations.
pub const GROUP: u32 = 8;

/// How a kernel uses a storage buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Storage {
    /// The kernel only reads it.
    Read,
    /// The kernel reads and writes it.
    Write,
    /// The kernel reads the data that you recorded by [`super::Recording::batch`].
    Batch,
}

/// An entry point of a compute shader. Group 0 binds its parameters (a uniform struct) at 0
/// and its storage buffers from 1 on, in order.
#[derive(Debug)]
pub struct Kernel {
    /// Name of the entry point, unique among all shaders. Errors show this name.
    pub name: &'static str,
    /// The complete WGSL source. You concatenate its parts.
    pub source: &'static str,
    /// Layout of the uniform struct at binding 0.
    pub parameters: Layout,
    /// Layouts of other structs that Rust writes or reads.
    pub structs: &'static [Layout],
    /// Uses of the storage buffers, in the order of their bindings.
    pub storage: &'static [Storage],
}

/// Number of workgroups along a row of `cells` invocations.
#[must_use]
pub fn groups(cells: usize) -> u32 {
    (cells as u32).div_ceil(GROUP)
}

/// A shader that draws triangles.
///
/// Its vertex entry point `corner` takes only the index of a corner (three per triangle). Its
/// fragment entry point `pixel` returns the four numbers of a pixel. Group 0 binds its parameters
/// at 0 and the buffers that it reads from 1 on, in order.
#[derive(Debug)]
pub struct RasterShader {
    /// Name, unique among all shaders and kernels. Errors show this name.
    pub name: &'static str,
    /// The complete WGSL source.
    pub source: &'static str,
    /// Layout of the uniform struct at binding 0.
    pub parameters: Layout,
    /// Layouts of other structs that Rust writes or reads.
    pub structs: &'static [Layout],
    /// Number of storage buffers that it reads.
    pub buffers: usize,
}

/// A shader that draws triangles for their depth and stencil only. Use this to count faces.
///
/// Its vertex entry point `corner` takes only the index of a corner (three per triangle). Group 0
/// binds its parameters at 0 and the buffers that it reads from 1 on, in order.
#[derive(Debug)]
pub struct StencilShader {
    /// Name, unique among all shaders and kernels. Errors show this name.
    pub name: &'static str,
    /// The complete WGSL source.
    pub source: &'static str,
    /// Layout of the uniform struct at binding 0.
    pub parameters: Layout,
    /// Number of storage buffers that it reads.
    pub buffers: usize,
}

/// A shader that draws both sides of triangles. Use this to add to a storage buffer: its fragment
/// entry point `pixel` returns nothing. Otherwise it is like [`StencilShader`]. The buffer that it
/// writes comes last, and only the fragment stage may use it.
#[derive(Debug)]
pub struct ScatterShader {
    /// Name, unique among all shaders and kernels. Errors show this name.
    pub name: &'static str,
    /// The complete WGSL source.
    pub source: &'static str,
    /// Layout of the uniform struct at binding 0.
    pub parameters: Layout,
    /// Layouts of other structs that Rust writes or reads.
    pub structs: &'static [Layout],
    /// Number of storage buffers, including the one that it writes.
    pub buffers: usize,
}

/// The layout of group 0 for parameters of `parameter_bytes`, with one storage buffer per
/// item of `read_only`.
pub(super) fn bind_group_layout(
    device: &wgpu::Device,
    label: &'static str,
    visibility: wgpu::ShaderStages,
    parameter_bytes: usize,
    read_only: impl Iterator<Item = bool>,
) -> wgpu::BindGroupLayout {
    let parameters = (wgpu::BufferBindingType::Uniform, true, parameter_bytes as u64);
    let storage =
        read_only.map(|read_only| (wgpu::BufferBindingType::Storage { read_only }, false, 0));
    let bindings = std::iter::once(parameters).chain(storage).zip(0..);
    let entries = bindings.map(|((ty, has_dynamic_offset, bytes), binding)| {
        wgpu::BindGroupLayoutEntry {
            binding,
            visibility: match ty {
                // Vertex shaders of the base profile do not write buffers.
                wgpu::BufferBindingType::Storage { read_only: false } => {
                    visibility - wgpu::ShaderStages::VERTEX
                }
                _ => visibility,
            },
            ty: wgpu::BindingType::Buffer {
                ty,
                has_dynamic_offset,
                min_binding_size: NonZero::new(bytes),
            },
            count: None,
        }
    });
    let entries: Vec<_> = entries.collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &entries,
    })
}

/// Binds `bytes` of `parameters` and then `storage`. Each dispatch sets the offset of the
/// parameters.
pub(super) fn bind_group<'a>(
    device: &wgpu::Device,
    label: &'static str,
    layout: &wgpu::BindGroupLayout,
    (parameters, bytes): (&'a wgpu::Buffer, usize),
    storage: impl Iterator<Item = &'a wgpu::Buffer>,
) -> wgpu::BindGroup {
    let parameters =
        wgpu::BufferBinding { buffer: parameters, offset: 0, size: NonZero::new(bytes as u64) };
    let first =
        wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(parameters) };
    let rest = storage.zip(1..).map(|(buffer, binding)| wgpu::BindGroupEntry {
        binding,
        resource: buffer.as_entire_binding(),
    });
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(label),
        layout,
        entries: &std::iter::once(first).chain(rest).collect::<Vec<_>>(),
    })
}

#[derive(Debug, Clone)]
pub(super) struct Pipeline {
    pub(super) compute: wgpu::ComputePipeline,
    pub(super) layout: wgpu::BindGroupLayout,
}

impl Pipeline {
    /// Compiles `kernel`. The driver reports errors through the error scopes of `device`.
    pub(super) fn compile(device: &wgpu::Device, kernel: &'static Kernel) -> Self {
        let label = Some(kernel.name);
        let layout = bind_group_layout(
            device,
            kernel.name,
            wgpu::ShaderStages::COMPUTE,
            kernel.parameters.bytes,
            kernel.storage.iter().map(|&storage| storage != Storage::Write),
        );
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label,
            source: wgpu::ShaderSource::Wgsl(kernel.source.into()),
        });
        let whole = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label,
            bind_group_layouts: &[Some(&layout)],
            ..wgpu::PipelineLayoutDescriptor::default()
        });
        let compute = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label,
            layout: Some(&whole),
            module: &module,
            entry_point: Some(kernel.name),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self { compute, layout }
    }
}

/// Format of a drawn pixel: four 32-bit numbers.
pub(super) const TEXEL: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

/// Format of the depth buffer: 0 (near) to 1 (far).
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Size of a drawn pixel in bytes.
pub(super) const TEXEL_BYTES: u32 = 16;

#[derive(Debug, Clone)]
pub(super) struct RasterPipeline {
    pub(super) render: wgpu::RenderPipeline,
    pub(super) layout: wgpu::BindGroupLayout,
}

impl RasterPipeline {
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

/// Format of the depth and stencil in which we count faces. Every WebGPU device has it.
pub(super) const DEPTH_STENCIL: wgpu::TextureFormat = wgpu::TextureFormat::Depth24PlusStencil8;

#[derive(Debug, Clone)]
pub(super) struct StencilPipeline {
    /// Draws the scene: writes depth, leaves the stencil.
    pub(super) scene: wgpu::RenderPipeline,
    /// Counts faces: +1 for back faces and -1 for front faces that fail the depth test.
    pub(super) faces: wgpu::RenderPipeline,
    pub(super) layout: wgpu::BindGroupLayout,
}

#[derive(Debug, Clone)]
pub(super) struct ScatterPipeline {
    pub(super) render: wgpu::RenderPipeline,
    pub(super) layout: wgpu::BindGroupLayout,
}

impl StencilPipeline {
    pub(super) fn compile(device: &wgpu::Device, shader: &'static StencilShader) -> Self {
        let layout = bind_group_layout(
            device,
            shader.name,
            wgpu::ShaderStages::VERTEX,
            shader.parameters.bytes,
            std::iter::repeat_n(true, shader.buffers),
        );
        let module = shader_module(device, shader.name, shader.source);
        fn on_depth_fail(operation: wgpu::StencilOperation) -> wgpu::StencilFaceState {
            wgpu::StencilFaceState {
                compare: wgpu::CompareFunction::Always,
                fail_op: wgpu::StencilOperation::Keep,
                depth_fail_op: operation,
                pass_op: wgpu::StencilOperation::Keep,
            }
        }
        let counting = wgpu::StencilState {
            front: on_depth_fail(wgpu::StencilOperation::DecrementWrap),
            back: on_depth_fail(wgpu::StencilOperation::IncrementWrap),
            read_mask: 0xff,
            write_mask: 0xff,
        };
        let less = wgpu::CompareFunction::Less;
        let scene = depth_state(true, less, wgpu::StencilState::default());
        let faces = depth_state(false, less, counting);
        let [scene, faces] = [scene, faces]
            .map(|state| pipeline(device, shader.name, &layout, &module, state, None));
        Self { scene, faces, layout }
    }
}

impl ScatterPipeline {
    pub(super) fn compile(device: &wgpu::Device, shader: &'static ScatterShader) -> Self {
        let layout = bind_group_layout(
            device,
            shader.name,
            wgpu::ShaderStages::VERTEX_FRAGMENT,
            shader.parameters.bytes,
            (1..=shader.buffers).map(|buffer| buffer < shader.buffers),
        );
        let module = shader_module(device, shader.name, shader.source);
        let always = wgpu::CompareFunction::Always;
        let state = depth_state(false, always, wgpu::StencilState::default());
        let render = pipeline(device, shader.name, &layout, &module, state, Some("pixel"));
        Self { render, layout }
    }
}

fn shader_module(
    device: &wgpu::Device,
    name: &'static str,
    source: &'static str,
) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(name),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

fn depth_state(
    writes: bool,
    compare: wgpu::CompareFunction,
    stencil: wgpu::StencilState,
) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_STENCIL,
        depth_write_enabled: Some(writes),
        depth_compare: Some(compare),
        stencil,
        bias: wgpu::DepthBiasState::default(),
    }
}

fn pipeline(
    device: &wgpu::Device,
    name: &'static str,
    layout: &wgpu::BindGroupLayout,
    module: &wgpu::ShaderModule,
    state: wgpu::DepthStencilState,
    fragment: Option<&'static str>,
) -> wgpu::RenderPipeline {
    let whole = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(name),
        bind_group_layouts: &[Some(layout)],
        ..wgpu::PipelineLayoutDescriptor::default()
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(name),
        layout: Some(&whole),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("corner"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(state),
        multisample: wgpu::MultisampleState::default(),
        fragment: fragment.map(|entry| wgpu::FragmentState {
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    })
}
