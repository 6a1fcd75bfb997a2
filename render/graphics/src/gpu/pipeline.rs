//! Compute pipelines: kernels compiled by the driver.

use super::binding::bind_group_layout;
use super::kernel::{Kernel, Storage};

/// A kernel compiled by the driver.
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
