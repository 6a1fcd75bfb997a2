//! Submits recorded commands to the driver: runs kernels, draws triangles into targets, counts
//! faces in the stencil, and adds the values of faces to buffers.

use std::collections::BTreeMap;

use super::adapter::DeviceError;
use super::device::{Buffer, Device};
use super::pipelines::{
    Kernel, Pipeline, RasterPipeline, RasterShader, ScatterPipeline, ScatterShader,
    StencilPipeline, StencilShader, Storage, TEXEL_BYTES, bind_group,
};
use super::recording::{Command, Draw, List, Recording, ScatterDraw, StencilDraw};
use super::target::StencilTarget;

/// Name of a kernel and numbers of its buffers. Dispatches with the same key share a bind group.
type BindGroupKey = (&'static str, Vec<u64>);

impl Device {
    /// Compiles `kernel` unless this was done before. [`Self::submit`] does this for each kernel.
    /// If you call it earlier, the first submission does not wait for the compiler.
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

    /// Submits the recorded commands in their order and empties the recording. This does not wait
    /// until they are done.
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

    /// A buffer of at least `bytes` that starts with `content`. This is `found` if it is large
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

impl Device {
    /// Compiles `shader` unless this was done before.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if the driver rejects the shader.
    fn prepare_raster(
        &mut self,
        shader: &'static RasterShader,
        front_only: bool,
    ) -> Result<(), DeviceError> {
        if self.raster_pipelines.contains_key(&(shader.name, front_only)) {
            return Ok(());
        }
        let pipeline = self.compile(
            || format!("raster shader `{}`", shader.name),
            |device: &wgpu::Device| RasterPipeline::compile(device, shader, front_only),
        )?;
        self.check(shader.name)?;
        self.raster_pipelines.insert((shader.name, front_only), pipeline);
        Ok(())
    }

    /// Encodes the drawing of triangles and the copy of the picture into a buffer.
    fn encode_draw(&self, encoder: &mut wgpu::CommandEncoder, draw: &Draw, parameters: &Buffer) {
        let Draw { shader, target, .. } = draw;
        let pipeline = &self.raster_pipelines[&(shader.name, draw.front_only)];
        let group = bind_group(
            &self.inner,
            shader.name,
            &pipeline.layout,
            (&parameters.inner, shader.parameters.bytes),
            draw.buffers.iter().map(|buffer| &buffer.inner),
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

/// Copies the target into a buffer without gaps between rows. WebGPU copies several rows at once
/// only if each has a multiple of 256 bytes. We copy others one by one.
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

impl Device {
    /// Compiles `shader` unless this was done before.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if the driver rejects the shader.
    fn prepare_stencil(&mut self, shader: &'static StencilShader) -> Result<(), DeviceError> {
        if self.stencil_pipelines.contains_key(shader.name) {
            return Ok(());
        }
        let pipeline = self.compile(
            || format!("stencil shader `{}`", shader.name),
            |device| StencilPipeline::compile(device, shader),
        )?;
        self.check(shader.name)?;
        self.stencil_pipelines.insert(shader.name, pipeline);
        Ok(())
    }

    /// Compiles `shader` unless this was done before.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if the driver rejects the shader.
    fn prepare_scatter(&mut self, shader: &'static ScatterShader) -> Result<(), DeviceError> {
        if self.scatter_pipelines.contains_key(shader.name) {
            return Ok(());
        }
        let pipeline = self.compile(
            || format!("shader `{}`", shader.name),
            |device| ScatterPipeline::compile(device, shader),
        )?;
        self.check(shader.name)?;
        self.scatter_pipelines.insert(shader.name, pipeline);
        Ok(())
    }

    /// Encodes three steps: draws the depth of the scene if the draw has one, counts faces behind
    /// it, and copies the stencil into the rows of the target.
    fn encode_stencil(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        draw: &StencilDraw,
        parameters: &Buffer,
    ) {
        let StencilDraw { shader, scene, faces, target } = draw;
        let pipeline = &self.stencil_pipelines[shader.name];
        let group = |list: &List| {
            let parameters = (&parameters.inner, shader.parameters.bytes);
            let buffers = list.buffers.iter().map(|buffer| &buffer.inner);
            bind_group(&self.inner, shader.name, &pipeline.layout, parameters, buffers)
        };
        let load = match scene {
            Some(_) => wgpu::LoadOp::Clear(1.0),
            None => wgpu::LoadOp::Load,
        };
        let store = wgpu::StoreOp::Store;
        let depth_ops = Some(wgpu::Operations { load, store });
        let stencil_ops = Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0), store });
        let mut pass = begin_pass(encoder, shader.name, target, (depth_ops, stencil_ops));
        if let Some(scene) = scene {
            pass.set_pipeline(&pipeline.scene);
            draw_list(&mut pass, scene, &group(scene));
        }
        pass.set_pipeline(&pipeline.faces);
        draw_list(&mut pass, faces, &group(faces));
        drop(pass);
        copy_stencil(encoder, target);
    }

    fn encode_scatter(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        draw: &ScatterDraw,
        parameters: &Buffer,
    ) {
        let ScatterDraw { shader, faces, target } = draw;
        let pipeline = &self.scatter_pipelines[shader.name];
        let group = bind_group(
            &self.inner,
            shader.name,
            &pipeline.layout,
            (&parameters.inner, shader.parameters.bytes),
            faces.buffers.iter().map(|buffer| &buffer.inner),
        );
        // A pass needs a picture, but this pass neither reads nor writes it.
        let mut pass = begin_pass(encoder, shader.name, target, (None, None));
        pass.set_pipeline(&pipeline.render);
        draw_list(&mut pass, faces, &group);
    }
}

/// How a pass uses the depth and the stencil of the target.
type Uses = (Option<wgpu::Operations<f32>>, Option<wgpu::Operations<u32>>);

fn begin_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    name: &'static str,
    target: &StencilTarget,
    (depth_ops, stencil_ops): Uses,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(name),
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &target.view,
            depth_ops,
            stencil_ops,
        }),
        ..wgpu::RenderPassDescriptor::default()
    })
}

fn draw_list(pass: &mut wgpu::RenderPass<'_>, list: &List, group: &wgpu::BindGroup) {
    pass.set_bind_group(0, group, &[list.parameters]);
    pass.draw(3 * list.triangles.start..3 * list.triangles.end, 0..1);
}

fn copy_stencil(encoder: &mut wgpu::CommandEncoder, target: &StencilTarget) {
    let from = wgpu::TexelCopyTextureInfo {
        aspect: wgpu::TextureAspect::StencilOnly,
        ..target.texture.as_image_copy()
    };
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(target.row_bytes()),
        rows_per_image: None,
    };
    let to = wgpu::TexelCopyBufferInfo { buffer: &target.rows().inner, layout };
    let width = target.width;
    let height = target.height;
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    encoder.copy_texture_to_buffer(from, to, size);
}
