//! Kernels made ready, and recordings played.

use std::collections::BTreeMap;

use super::device::{Buffer, Device, one_line};
use super::error::DeviceError;
use super::kernel::{Kernel, Storage};
use super::recording::{Command, Recording};

/// A kernel as the driver compiled it.
#[derive(Debug, Clone)]
pub(super) struct Pipeline {
    compute: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
}

/// A kernel and the numbers of its buffers: dispatches of equal ones share a
/// bind group.
type Bound = (&'static str, Vec<u64>);

impl Device {
    /// Compiles `kernel` unless it is; by itself when first dispatched.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if the driver does not take it.
    pub fn prepare(&mut self, kernel: &'static Kernel) -> Result<(), DeviceError> {
        if self.pipelines.contains_key(kernel.name) {
            return Ok(());
        }
        let scopes = [wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::Internal]
            .map(|filter| self.inner.push_error_scope(filter));
        let pipeline = self.compile(kernel);
        for scope in scopes.into_iter().rev() {
            if let Some(error) = pollster::block_on(scope.pop()) {
                let what = format!("kernel `{}`", kernel.name);
                return Err(DeviceError::Refused { what, reason: one_line(&error) });
            }
        }
        self.check(kernel.name)?;
        self.pipelines.insert(kernel.name, pipeline);
        Ok(())
    }

    fn compile(&self, kernel: &'static Kernel) -> Pipeline {
        let label = Some(kernel.name);
        let entry = |binding: u32, ty, has_dynamic_offset, bytes| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty,
                has_dynamic_offset,
                min_binding_size: std::num::NonZero::new(bytes),
            },
            count: None,
        };
        let bytes = kernel.parameters.bytes as u64;
        let mut entries = vec![entry(0, wgpu::BufferBindingType::Uniform, true, bytes)];
        entries.extend(kernel.storage.iter().zip(1..).map(|(&storage, binding)| {
            let read_only = storage != Storage::Write;
            entry(binding, wgpu::BufferBindingType::Storage { read_only }, false, 0)
        }));
        let layout = self.inner.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label,
            entries: &entries,
        });
        let module = self.inner.create_shader_module(wgpu::ShaderModuleDescriptor {
            label,
            source: wgpu::ShaderSource::Wgsl(kernel.source.into()),
        });
        let whole = self.inner.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label,
            bind_group_layouts: &[Some(&layout)],
            ..wgpu::PipelineLayoutDescriptor::default()
        });
        let compute = self.inner.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label,
            layout: Some(&whole),
            module: &module,
            entry_point: Some(kernel.name),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Pipeline { compute, layout }
    }

    /// Plays what was recorded, in order, in one submission, and empties the
    /// recording. Does not wait.
    ///
    /// # Errors
    /// [`DeviceError::Lost`]; what the driver refuses of this or an earlier one.
    ///
    /// # Panics
    /// If a kernel was recorded with fewer or more buffers than it has.
    pub fn submit(&mut self, recording: &mut Recording) -> Result<(), DeviceError> {
        let recording = std::mem::take(recording);
        self.check("a submission")?;
        if recording.is_empty() {
            return Ok(());
        }
        let mut longest = 0;
        for command in &recording.commands {
            let parameters = match command {
                Command::Dispatch { kernel, .. } => {
                    self.prepare(kernel)?;
                    kernel.parameters
                }
                Command::Draw(draw) => {
                    self.prepare_raster(draw.shader, draw.front_only)?;
                    draw.shader.parameters
                }
                Command::Copy { .. } => continue,
            };
            longest = longest.max(parameters.bytes);
        }
        let parameters = self.parameters.take();
        let bytes = recording.parameters.len() + longest;
        let parameters = self.filled("parameters", parameters, &recording.parameters, bytes)?;
        let batch = self.batch.take();
        let batch = self.filled("a batch", batch, &recording.batch, recording.batch.len())?;
        let commands = self.encode(&recording, &parameters, &batch);
        (self.parameters, self.batch) = (Some(parameters), Some(batch));
        let index = self.queue.submit([commands]);
        self.follow(index)
    }

    /// A buffer of at least `bytes`, `found` if it suffices, that starts with
    /// `content`.
    fn filled(
        &mut self,
        what: &'static str,
        found: Option<Buffer>,
        content: &[u8],
        bytes: usize,
    ) -> Result<Buffer, DeviceError> {
        let bytes = bytes as u64;
        let buffer = match found {
            Some(buffer) if buffer.inner.size() >= bytes => buffer,
            _ => {
                let roomy = (bytes + bytes / 2).min(self.adapter().limits.binding_bytes);
                self.buffer(what, roomy.max(bytes))?
            }
        };
        if !content.is_empty() {
            self.queue.write_buffer(&buffer.inner, 0, content);
        }
        Ok(buffer)
    }

    fn encode(
        &self,
        recording: &Recording,
        parameters: &Buffer,
        batch: &Buffer,
    ) -> wgpu::CommandBuffer {
        let mut encoder = self.inner.create_command_encoder(&Default::default());
        let mut bound: BTreeMap<Bound, wgpu::BindGroup> = BTreeMap::new();
        let mut pass: Option<wgpu::ComputePass<'static>> = None;
        for command in &recording.commands {
            match command {
                Command::Copy { from, to, bytes } => {
                    pass = None;
                    encoder.copy_buffer_to_buffer(&from.inner, 0, &to.inner, 0, *bytes);
                }
                Command::Draw(draw) => {
                    pass = None;
                    self.encode_draw(&mut encoder, draw, parameters);
                }
                Command::Dispatch { kernel, buffers, parameters: start, groups } => {
                    let pipeline = &self.pipelines[kernel.name];
                    let all = all_buffers(kernel, buffers, batch);
                    let numbers = all.iter().map(|buffer| buffer.number).collect();
                    let group = bound.entry((kernel.name, numbers)).or_insert_with(|| {
                        let parameters = (parameters, kernel.parameters.bytes);
                        self.bind(kernel.name, &pipeline.layout, parameters, &all)
                    });
                    let pass = pass.get_or_insert_with(|| {
                        encoder.begin_compute_pass(&Default::default()).forget_lifetime()
                    });
                    pass.set_pipeline(&pipeline.compute);
                    pass.set_bind_group(0, &*group, &[*start]);
                    pass.dispatch_workgroups(groups[0], groups[1], groups[2]);
                }
            }
        }
        drop(pass);
        encoder.finish()
    }

    /// `parameters` with the bytes of one struct, then `storage`.
    pub(super) fn bind(
        &self,
        name: &'static str,
        layout: &wgpu::BindGroupLayout,
        (parameters, bytes): (&Buffer, usize),
        storage: &[&Buffer],
    ) -> wgpu::BindGroup {
        let parameters = wgpu::BufferBinding {
            buffer: &parameters.inner,
            offset: 0,
            size: std::num::NonZero::new(bytes as u64),
        };
        let first = wgpu::BindGroupEntry {
            binding: 0,
            resource: wgpu::BindingResource::Buffer(parameters),
        };
        let rest = storage.iter().zip(1..).map(|(buffer, binding)| wgpu::BindGroupEntry {
            binding,
            resource: buffer.inner.as_entire_binding(),
        });
        self.inner.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(name),
            layout,
            entries: &std::iter::once(first).chain(rest).collect::<Vec<_>>(),
        })
    }
}

/// The buffers that `kernel` is bound to, the batch in its place.
fn all_buffers<'a>(kernel: &Kernel, buffers: &'a [Buffer], batch: &'a Buffer) -> Vec<&'a Buffer> {
    let wanted = kernel.storage.iter().filter(|&&storage| storage != Storage::Batch).count();
    assert_eq!(buffers.len(), wanted, "buffers of {}", kernel.name);
    let mut own = buffers.iter();
    let all = kernel.storage.iter().filter_map(|storage| match storage {
        Storage::Batch => Some(batch),
        _ => own.next(),
    });
    all.collect()
}
