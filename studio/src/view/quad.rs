//! Large quads in the window, pictures and flat areas, drawn without egui's shader.
//!
//! egui's shader contains code that filters textures itself, and a software driver executes
//! it for every pixel even when it is not needed. This shader only samples or fills.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use eframe::egui::{
    Color32, ColorImage, Context, Id, PaintCallbackInfo, Painter, Pos2, Rect, Shape, pos2,
};
use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait, ScreenDescriptor, wgpu};
use wgpu::{BindGroup, Buffer, Device, Extent3d, Origin3d, Queue, TextureFormat};

use super::pipeline::{Pipelines, VERTEX_BYTES};

/// Target format when none was set, as in tests.
const FORMAT: TextureFormat = TextureFormat::Rgba8Unorm;

fn format_id() -> Id {
    Id::unique("format of the window's pixels")
}

/// Sets the format of the window's pixels. To be called before the first frame.
pub fn set_format(context: &Context, format: TextureFormat) {
    context.data_mut(|data| data.insert_temp(format_id(), format));
}

/// A texture whose cells are uploaded when it is next drawn.
#[derive(Clone)]
pub(super) struct LazyTexture(Arc<Mutex<TextureState>>);

struct TextureState {
    size: [usize; 2],
    /// Cells to upload, each with its column and row.
    pending: Vec<([usize; 2], ColorImage)>,
    /// The texture, with bind groups for nearest and linear filtering.
    texture: Option<(wgpu::Texture, [BindGroup; 2])>,
}

impl LazyTexture {
    /// A texture with these cells.
    pub(super) fn new(image: ColorImage) -> Self {
        let size = image.size;
        let pending = vec![([0, 0], image)];
        Self(Arc::new(Mutex::new(TextureState { size, pending, texture: None })))
    }

    /// Replaces a rectangle of cells whose upper left corner is `at` (column, row).
    pub(super) fn write(&self, at: [usize; 2], image: ColorImage) {
        let mut cells = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if image.size == cells.size {
            cells.pending.clear();
        }
        cells.pending.push((at, image));
    }

    /// Number of cells that were written but not drawn since.
    pub(super) fn pending_cells(&self) -> usize {
        let cells = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        cells.pending.iter().map(|(_, image)| image.pixels.len()).sum()
    }

    /// Uploads what was written, into a texture that is created the first time.
    pub(super) fn upload(&self, device: &Device, queue: &Queue, pipelines: &Pipelines) {
        let mut cells = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let TextureState { size, pending, texture } = &mut *cells;
        let (texture, _) = texture.get_or_insert_with(|| pipelines.texture(device, *size));
        for (at, image) in pending.drain(..) {
            let [width, height] = image.size.map(|cells| cells as u32);
            let mut to = texture.as_image_copy();
            to.origin = Origin3d { x: at[0] as u32, y: at[1] as u32, z: 0 };
            let layout = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * width),
                rows_per_image: None,
            };
            let size = Extent3d { width, height, depth_or_array_layers: 1 };
            queue.write_texture(to, image.as_raw(), layout, size);
        }
    }

    /// The texture as a shader reads it, once it was uploaded.
    pub(super) fn bind_group(&self, smooth: bool) -> Option<BindGroup> {
        let cells = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        cells.texture.as_ref().map(|(_, bind_group)| bind_group[usize::from(smooth)].clone())
    }
}

/// A vertex of a quad.
#[derive(Clone, Copy)]
pub(super) struct Vertex {
    /// Position in the window, in points.
    pub(super) point: Pos2,
    /// Texture coordinates, 0 to 1.
    pub(super) uv: Pos2,
    /// Colour, used where there is no texture.
    pub(super) color: Color32,
}

/// A quad to draw.
pub(super) struct Quad {
    /// The four corners, in order around the quad.
    pub(super) corners: [Vertex; 4],
    /// The texture, and whether its cells are interpolated; without a texture the vertex
    /// colours are drawn.
    pub(super) texture: Option<(LazyTexture, bool)>,
}

impl Quad {
    /// A quad without texture whose corner colours are interpolated.
    pub(super) fn colored(corners: [(Pos2, Color32); 4]) -> Self {
        let corners = corners.map(|(point, color)| Vertex { point, uv: Pos2::ZERO, color });
        Self { corners, texture: None }
    }
}

/// The window that quads are drawn in.
pub(super) struct QuadCanvas {
    /// The part of the window that has contents, in points.
    pub(super) visible: Rect,
    /// Pixels per point.
    pub(super) density: f32,
    /// Format of the window's pixels.
    pub(super) format: TextureFormat,
}

impl QuadCanvas {
    /// The window of a context.
    pub(super) fn of(context: &Context) -> Self {
        Self {
            visible: context.content_rect(),
            density: context.pixels_per_point(),
            format: context.data(|data| data.get_temp(format_id())).unwrap_or(FORMAT),
        }
    }

    /// A rectangle rounded to pixels, as egui does for rectangles.
    pub(super) fn rounded(&self, rect: Rect) -> Rect {
        let round = |at: f32| (at * self.density).round() / self.density;
        let corner = |at: Pos2| pos2(round(at.x), round(at.y));
        Rect::from_min_max(corner(rect.min), corner(rect.max))
    }

    /// A length rounded up to pixels.
    pub(super) fn rounded_up(&self, length: f32) -> f32 {
        (length * self.density).ceil() / self.density
    }

    /// Opaque quads as a shape, which draws them in order.
    pub(super) fn shape(&self, quads: Vec<Quad>) -> Shape {
        let job = DrawQuads { quads, format: self.format, vertices: OnceLock::new() };
        Callback::new_paint_callback(self.visible, job).into()
    }
}

/// Fills a rectangle with one colour.
pub fn fill_rect(painter: &Painter, rect: Rect, color: Color32) {
    let rect = QuadCanvas::of(painter.ctx()).rounded(rect.intersect(painter.clip_rect()));
    let points = [rect.left_top(), rect.right_top(), rect.right_bottom(), rect.left_bottom()];
    draw_quads(painter, vec![Quad::colored(points.map(|point| (point, color)))]);
}

/// Draws opaque quads in order, within the painter's clip rectangle.
pub(super) fn draw_quads(painter: &Painter, quads: Vec<Quad>) {
    let canvas = QuadCanvas::of(painter.ctx());
    if !quads.is_empty() && painter.clip_rect().intersect(canvas.visible).is_positive() {
        painter.add(canvas.shape(quads));
    }
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
        for corner in
            self.quads.iter().flat_map(|quad| [0, 1, 2, 0, 2, 3].map(|at| quad.corners[at]))
        {
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
            super::pipeline::vertex_buffer(device, &self.vertices(points))
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
