//! Bind groups: the parameters of a kernel or raster shader at binding 0, its storage
//! buffers from 1 on.

use std::num::NonZero;

/// The layout of group 0 for parameters of `parameter_bytes`, with one storage buffer per
/// item of `read_only`.
pub(super) fn bind_group_layout(
    device: &wgpu::Device,
    label: &'static str,
    visibility: wgpu::ShaderStages,
    parameter_bytes: usize,
    read_only: impl Iterator<Item = bool>,
) -> wgpu::BindGroupLayout {
    let entry = |binding: u32, ty, has_dynamic_offset, bytes| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: match ty {
            // Vertex shaders of the base profile write no buffers.
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
    };
    let parameters = entry(0, wgpu::BufferBindingType::Uniform, true, parameter_bytes as u64);
    let storage = read_only.zip(1..).map(|(read_only, binding)| {
        entry(binding, wgpu::BufferBindingType::Storage { read_only }, false, 0)
    });
    let entries: Vec<_> = std::iter::once(parameters).chain(storage).collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &entries,
    })
}

/// Binds `bytes` of `parameters`, from an offset set at each dispatch, and then `storage`.
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
