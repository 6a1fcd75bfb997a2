//! Draws the meshes of the interface, above all text, with the quads' shader.
//!
//! egui's shader filters textures and dithers. A software driver executes all of this for every
//! pixel, which took three quarters of a frame. Here a pixel is one sample of a texture times a
//! colour.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use eframe::egui::emath::TSTransform;
use eframe::egui::epaint::{ClippedPrimitive, ClippedShape, ImageData, ImageDelta, Primitive};
use eframe::egui::{
    Context, FullOutput, Mesh, PaintCallbackInfo, Plugin, Pos2, Rect, Shape, TextureFilter,
    TextureId,
};
use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait, ScreenDescriptor, wgpu};
use wgpu::util::DeviceExt;
use wgpu::{Buffer, BufferUsages, Device, IndexFormat, Queue, TextureFormat};

use super::canvas::{Drawing, QuadCanvas};
use super::pipeline::{Pipelines, VERTEX_BYTES};
use super::texture::LazyTexture;

/// Whether an adapter is the processor, by a driver in software.
#[must_use]
pub fn is_processor(adapter: &wgpu::Adapter) -> bool {
    adapter.get_info().device_type == wgpu::DeviceType::Cpu
}

/// Draws all meshes of this context with the quads' shader from now on.
pub fn draw_meshes(context: &Context) {
    context.add_plugin(MeshDrawer::default());
}

/// A texture of egui, and whether its texels are interpolated.
type MeshTexture = (LazyTexture, bool);

#[derive(Default)]
struct MeshDrawer {
    textures: BTreeMap<TextureId, MeshTexture>,
    /// Textures that egui freed. We may drop them after the last frame.
    freed: Vec<TextureId>,
}

impl Plugin for MeshDrawer {
    fn debug_name(&self) -> &'static str {
        "meshes by the shader of quads"
    }

    fn output_hook(&mut self, context: &Context, output: &mut FullOutput) {
        for id in self.freed.drain(..) {
            self.textures.remove(&id);
        }
        let delta = &output.textures_delta;
        let changed: BTreeMap<_, _> = delta.set.iter().collect();
        for (id, changes) in changed {
            changes.iter().for_each(|change| self.change(*id, change));
        }
        self.freed.extend(&delta.free);
        let canvas = QuadCanvas::of(context);
        let Drawing::OwnShader(format) = canvas.drawing else { return };
        let shapes = std::mem::take(&mut output.shapes);
        let primitives = context.tessellate(shapes, output.pixels_per_point);
        output.shapes = self.replaced(primitives, format, canvas.visible);
    }
}

impl MeshDrawer {
    fn change(&mut self, id: TextureId, ImageDelta { image, options, pos }: &ImageDelta) {
        let ImageData::Color(image) = image;
        let image = image.as_ref().clone();
        match (pos, self.textures.get(&id)) {
            (Some(at), Some((texture, _))) => texture.write(*at, image),
            (Some(_), None) => {}
            (None, _) => {
                let smooth = options.magnification == TextureFilter::Linear;
                self.textures.insert(id, (LazyTexture::new(image), smooth));
            }
        }
    }

    /// The primitives as shapes. Neighbouring meshes become one shape, and all other primitives
    /// stay as they are.
    fn replaced(
        &self,
        primitives: Vec<ClippedPrimitive>,
        format: TextureFormat,
        visible: Rect,
    ) -> Vec<ClippedShape> {
        let mut shapes = Vec::new();
        let mut meshes = Vec::new();
        for ClippedPrimitive { clip_rect, primitive } in primitives {
            let other = match primitive {
                Primitive::Mesh(mesh) if mesh.indices.is_empty() => continue,
                Primitive::Mesh(mesh) => match self.textures.get(&mesh.texture_id).cloned() {
                    Some(texture) => {
                        meshes.push(ClippedMesh { clip_rect, mesh, texture });
                        continue;
                    }
                    None => Shape::mesh(mesh),
                },
                Primitive::Callback(callback) => Shape::Callback(callback),
            };
            shapes.extend(shape(std::mem::take(&mut meshes), format, visible));
            shapes.push(clipped(clip_rect, other));
        }
        shapes.extend(shape(meshes, format, visible));
        shapes
    }
}

/// Meshes as one shape; `None` if there is none.
fn shape(meshes: Vec<ClippedMesh>, format: TextureFormat, visible: Rect) -> Option<ClippedShape> {
    let job = DrawMeshes { meshes, format, buffers: OnceLock::new() };
    let some = !job.meshes.is_empty();
    some.then(|| clipped(visible, Callback::new_paint_callback(visible, job).into()))
}

fn clipped(clip_rect: Rect, shape: Shape) -> ClippedShape {
    ClippedShape { clip_rect, shape, transform_after_tessellation: TSTransform::IDENTITY }
}

struct ClippedMesh {
    clip_rect: Rect,
    mesh: Mesh,
    texture: MeshTexture,
}

struct DrawMeshes {
    meshes: Vec<ClippedMesh>,
    format: TextureFormat,
    buffers: OnceLock<[Buffer; 2]>,
}

impl DrawMeshes {
    /// The vertices of all meshes, for a screen size in points.
    fn vertices(&self, [width, height]: [f32; 2]) -> Vec<[u8; VERTEX_BYTES]> {
        let vertices = self.meshes.iter().flat_map(|clipped| &clipped.mesh.vertices);
        let laid_out = vertices.map(|vertex| {
            let Pos2 { x, y } = vertex.pos;
            let at = [2.0 * x / width - 1.0, 1.0 - 2.0 * y / height, vertex.uv.x, vertex.uv.y];
            let mut bytes = [0; VERTEX_BYTES];
            let (places, color) = bytes.split_at_mut(16);
            for (place, value) in places.chunks_exact_mut(4).zip(at) {
                place.copy_from_slice(&value.to_ne_bytes());
            }
            color.copy_from_slice(&vertex.color.to_array());
            bytes
        });
        laid_out.collect()
    }

    /// Indices into the vertices of all meshes. WebGL 2 can count only from the first vertex.
    fn indices(&self) -> Vec<[u8; 4]> {
        let mut base = 0_u32;
        let mut all = Vec::new();
        for ClippedMesh { mesh, .. } in &self.meshes {
            all.extend(mesh.indices.iter().map(|index| (base + index).to_ne_bytes()));
            base += mesh.vertices.len() as u32;
        }
        all
    }
}

impl CallbackTrait for DrawMeshes {
    fn prepare(
        &self,
        device: &Device,
        queue: &Queue,
        screen: &ScreenDescriptor,
        _: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        let pipelines = Pipelines::of(device, self.format, resources);
        for ClippedMesh { texture: (texture, _), .. } in &self.meshes {
            texture.upload(device, queue, pipelines);
        }
        self.buffers.get_or_init(|| {
            let points = screen.size_in_pixels.map(|size| size as f32 / screen.pixels_per_point);
            let vertices = self.vertices(points);
            let indices = self.indices();
            let vertices = (vertices.as_flattened(), BufferUsages::VERTEX);
            [vertices, (indices.as_flattened(), BufferUsages::INDEX)].map(|(contents, usage)| {
                let label = Some("meshes of the interface");
                device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                    label,
                    contents,
                    usage,
                })
            })
        });
        Vec::new()
    }

    fn paint(
        &self,
        info: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        let (Some(pipelines), Some([vertices, indices])) =
            (resources.get::<Pipelines>(), self.buffers.get())
        else {
            return;
        };
        let [width, height] = info.screen_size_px;
        pass.set_viewport(0.0, 0.0, width as f32, height as f32, 0.0, 1.0);
        pass.set_pipeline(&pipelines.blended);
        pass.set_vertex_buffer(0, vertices.slice(..));
        pass.set_index_buffer(indices.slice(..), IndexFormat::Uint32);
        let mut first = 0_u32;
        for ClippedMesh { clip_rect, mesh, texture: (texture, smooth) } in &self.meshes {
            let range = first..first + mesh.indices.len() as u32;
            first = range.end;
            let [x, y, right, bottom] = pixels(*clip_rect, info.pixels_per_point, [width, height]);
            let Some(bind_group) = texture.bind_group(*smooth) else { continue };
            if right > x && bottom > y {
                pass.set_scissor_rect(x, y, right - x, bottom - y);
                pass.set_bind_group(0, &bind_group, &[]);
                pass.draw_indexed(range, 0, 0..1);
            }
        }
        let [x, y, right, bottom] = pixels(info.clip_rect, info.pixels_per_point, [width, height]);
        pass.set_scissor_rect(x, y, right - x, bottom - y);
    }
}

/// A clip rectangle in pixels within the window, rounded as egui does: left, top, right and bottom.
fn pixels(clip_rect: Rect, density: f32, [width, height]: [u32; 2]) -> [u32; 4] {
    let at = |points: f32, most: u32| ((points * density).round().max(0.0) as u32).min(most);
    let x = at(clip_rect.min.x, width);
    let y = at(clip_rect.min.y, height);
    [x, y, at(clip_rect.max.x, width).max(x), at(clip_rect.max.y, height).max(y)]
}
