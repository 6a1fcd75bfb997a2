//! Submissions: recorded commands encoded and handed to the driver.

use std::collections::BTreeMap;

use super::binding::bind_group;
use super::device::{Buffer, Device};
use super::error::DeviceError;
use super::kernel::{Kernel, Storage};
use super::pipeline::Pipeline;
use super::recording::{Command, Recording};

/// Name of a kernel and numbers of its buffers: dispatches that agree in both share a bind
/// group.
type BindGroupKey = (&'static str, Vec<u64>);

impl Device {
    /// Compiles `kernel` unless that was done before. [`Self::submit`] calls this for each
    /// kernel; an earlier call keeps the compilation out of the first submission.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if the driver rejects the kernel.
    pub fn prepare(&mut self, kernel: &'static Kernel) -> Result<(), DeviceError> {
        if self.pipelines.contains_key(kernel.name) {
            return Ok(());
        }
        let pipeline = self.compile(
            || format!("kernel `{}`", kernel.name),
            |device| Pipeline::compile(device, kernel),
        )?;
        self.check(kernel.name)?;
        self.pipelines.insert(kernel.name, pipeline);
        Ok(())
    }

    /// Submits the recorded commands in their order and empties the recording. Does not wait
    /// for their completion.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] if the device was lost, [`DeviceError::Refused`] if the driver
    /// rejects a command of this or an earlier submission.
    ///
    /// # Panics
    /// If a kernel was recorded with fewer or more buffers than it declares.
    pub fn submit(&mut self, recording: &mut Recording) -> Result<(), DeviceError> {
        let submitted = self.submit_all(recording);
        recording.clear();
        submitted
    }

    fn submit_all(&mut self, recording: &Recording) -> Result<(), DeviceError> {
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
                Command::Stencil(draw) => {
                    self.prepare_stencil(draw.shader)?;
                    draw.shader.parameters
                }
                Command::Scatter(draw) => {
                    self.prepare_scatter(draw.shader)?;
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
        let commands = self.encode(recording, &parameters, &batch);
        (self.parameters, self.batch) = (Some(parameters), Some(batch));
        let index = self.queue.submit([commands]);
        self.follow(index)
    }

    /// A buffer of at least `bytes` that starts with `content`: `found` if it is large
    /// enough, else a new one.
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
                let enlarged = (bytes + bytes / 2).min(self.adapter().limits.binding_bytes);
                self.buffer(what, enlarged.max(bytes))?
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
        let mut bind_groups: BTreeMap<BindGroupKey, wgpu::BindGroup> = BTreeMap::new();
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
                Command::Stencil(draw) => {
                    pass = None;
                    self.encode_stencil(&mut encoder, draw, parameters);
                }
                Command::Scatter(draw) => {
                    pass = None;
                    self.encode_scatter(&mut encoder, draw, parameters);
                }
                Command::Dispatch { kernel, buffers, parameters: start, groups } => {
                    let pipeline = &self.pipelines[kernel.name];
                    let all = storage_buffers(kernel, buffers, batch);
                    let numbers = all.iter().map(|buffer| buffer.number).collect();
                    let group = bind_groups.entry((kernel.name, numbers)).or_insert_with(|| {
                        bind_group(
                            &self.inner,
                            kernel.name,
                            &pipeline.layout,
                            (&parameters.inner, kernel.parameters.bytes),
                            all.iter().map(|buffer| &buffer.inner),
                        )
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
}

/// The storage buffers of `kernel` in the order of their bindings, `batch` included.
fn storage_buffers<'a>(
    kernel: &Kernel,
    buffers: &'a [Buffer],
    batch: &'a Buffer,
) -> Vec<&'a Buffer> {
    let expected = kernel.storage.iter().filter(|&&storage| storage != Storage::Batch).count();
    assert_eq!(buffers.len(), expected, "buffers of {}", kernel.name);
    let mut own = buffers.iter();
    let all = kernel.storage.iter().filter_map(|storage| match storage {
        Storage::Batch => Some(batch),
        _ => own.next(),
    });
    all.collect()
}
