//! Quads drawn without egui's shader.
//!
//! egui's shader contains code that filters textures itself, and a software driver executes
//! it for every pixel even when it is not needed. This shader only samples or fills.

use std::sync::OnceLock;

use eframe::egui::{PaintCallbackInfo, Rect, Shape};
use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait, ScreenDescriptor, wgpu};
use wgpu::{Buffer, Device, Queue, TextureFormat};

use super::pipeline::{Pipelines, VERTEX_BYTES, vertex_buffer};
use super::quad::{Quad, TRIANGLES, Vertex};

/// Opaque quads as a shape that draws them in order, into pixels of this format in the part `visible` of the
/// window, in points.
pub(super) fn shape(quads: Vec<Quad>, format: TextureFormat, visible: Rect) -> Shape {
    let job = DrawQuads { quads, format, vertices: OnceLock::new() };
    Callback::new_paint_callback(visible, job).into()
}

struct DrawQuads {
    quads: Vec<Quad>,
    format: TextureFormat,
    vertices: OnceLock<Buffer>,
}

impl DrawQuads {
    /// The vertex data, two triangles per quad, for a screen size in points.
    fn vertices(&self, [width, height]: [f32; 2]) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.quads.len() * 6 * VERTEX_BYTES);
        for corner in self.quads.iter().flat_map(|quad| TRIANGLES.map(|at| quad.corners[at])) {
            let Vertex { point, uv, color } = corner;
            let position = [2.0 * point.x / width - 1.0, 1.0 - 2.0 * point.y / height];
            for value in [position[0], position[1], uv.x, uv.y] {
                bytes.extend(value.to_ne_bytes());
            }
            bytes.extend(color.to_array());
        }
        bytes
    }
}

impl CallbackTrait for DrawQuads {
    fn prepare(
        &self,
        device: &Device,
        queue: &Queue,
        screen: &ScreenDescriptor,
        _: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        let pipelines = Pipelines::of(device, self.format, resources);
        for (texture, _) in self.quads.iter().filter_map(|quad| quad.texture.as_ref()) {
            texture.upload(device, queue, pipelines);
        }
        self.vertices.get_or_init(|| {
            let points = screen.size_in_pixels.map(|size| size as f32 / screen.pixels_per_point);
            vertex_buffer(device, &self.vertices(points))
        });
        Vec::new()
    }

    fn paint(
        &self,
        info: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        let (Some(pipelines), Some(vertices)) = (resources.get::<Pipelines>(), self.vertices.get())
        else {
            return;
        };
        let [width, height] = info.screen_size_px.map(|size| size as f32);
        pass.set_viewport(0.0, 0.0, width, height, 0.0, 1.0);
        pass.set_vertex_buffer(0, vertices.slice(..));
        let mut first = 0_u32;
        // Neighbours without a texture are drawn at once.
        for run in self.quads.chunk_by(|a, b| a.texture.is_none() && b.texture.is_none()) {
            let end = first + 6 * run.len() as u32;
            let vertices = first..end;
            first = end;
            match &run[0].texture {
                Some((texture, smooth)) => {
                    let Some(bind_group) = texture.bind_group(*smooth) else { continue };
                    pass.set_pipeline(&pipelines.textured);
                    pass.set_bind_group(0, &bind_group, &[]);
                }
                None => pass.set_pipeline(&pipelines.flat_color),
            }
            pass.draw(vertices, 0..1);
        }
    }
}
