//! Compiled shaders that count faces in the stencil, or add to buffers.

use super::binding::bind_group_layout;
use super::stencil::{ScatterShader, StencilShader};

/// Format of the depth and stencil that faces are counted in. Every WebGPU device has it.
pub(super) const DEPTH_STENCIL: wgpu::TextureFormat = wgpu::TextureFormat::Depth24PlusStencil8;

/// A stencil shader compiled by the driver.
#[derive(Debug, Clone)]
pub(super) struct StencilPipeline {
    /// Draws the scene: writes depth, leaves the stencil.
    pub(super) scene: wgpu::RenderPipeline,
    /// Counts faces: +1 for back faces and -1 for front faces that fail the depth test.
    pub(super) faces: wgpu::RenderPipeline,
    pub(super) layout: wgpu::BindGroupLayout,
}

/// A shader that adds to a buffer, compiled by the driver.
#[derive(Debug, Clone)]
pub(super) struct ScatterPipeline {
    pub(super) render: wgpu::RenderPipeline,
    pub(super) layout: wgpu::BindGroupLayout,
}

impl StencilPipeline {
    /// Compiles `shader`. The driver reports errors through the error scopes of `device`.
    pub(super) fn compile(device: &wgpu::Device, shader: &'static StencilShader) -> Self {
        let layout = bind_group_layout(
            device,
            shader.name,
            wgpu::ShaderStages::VERTEX,
            shader.parameters.bytes,
            std::iter::repeat_n(true, shader.buffers),
        );
        let module = shader_module(device, shader.name, shader.source);
        let on_depth_fail = |operation| wgpu::StencilFaceState {
            compare: wgpu::CompareFunction::Always,
            fail_op: wgpu::StencilOperation::Keep,
            depth_fail_op: operation,
            pass_op: wgpu::StencilOperation::Keep,
        };
        let counting = wgpu::StencilState {
            front: on_depth_fail(wgpu::StencilOperation::DecrementWrap),
            back: on_depth_fail(wgpu::StencilOperation::IncrementWrap),
            read_mask: 0xff,
            write_mask: 0xff,
        };
        let less = wgpu::CompareFunction::Less;
        let scene = depth_state(true, less, wgpu::StencilState::default());
        let faces = depth_state(false, less, counting);
        let pipeline = |state| pipeline(device, shader.name, &layout, &module, state, None);
        Self { scene: pipeline(scene), faces: pipeline(faces), layout }
    }
}

impl ScatterPipeline {
    /// Compiles `shader`. The driver reports errors through the error scopes of `device`.
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

/// A pipeline that draws both sides of triangles into a target without colours.
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
