//! What is large in the window: pictures and even areas, drawn without egui's shader.
//!
//! That one can filter by hand, and a driver in software does so for every pixel,
//! wanted or not. This one does nothing but draw.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use eframe::egui::{
    Color32, ColorImage, Context, Id, PaintCallbackInfo, Painter, Pos2, Rect, pos2,
};
use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait, ScreenDescriptor, wgpu};
use wgpu::{BindGroup, Buffer, Device, Extent3d, Origin3d, Queue, TextureFormat};

use super::pipeline::{Pipelines, VERTEX_BYTES};

/// What the pixels of a window are where nobody tells: those of tests.
const FORMAT: TextureFormat = TextureFormat::Rgba8Unorm;

fn format_id() -> Id {
    Id::unique("format of the window's pixels")
}

/// Tells what the window's pixels are, before the first frame.
pub(crate) fn set_format(context: &Context, format: TextureFormat) {
    context.data_mut(|data| data.insert_temp(format_id(), format));
}

/// Cells on the graphics device. They are taken there when they are next drawn.
#[derive(Clone)]
pub(super) struct Sheet(Arc<Mutex<Cells>>);

struct Cells {
    size: [usize; 2],
    waiting: Vec<([usize; 2], ColorImage)>,
    /// Bound to be shown as squares, and blended.
    texture: Option<(wgpu::Texture, [BindGroup; 2])>,
}

impl Sheet {
    /// A sheet of these cells.
    pub(super) fn new(image: ColorImage) -> Self {
        let size = image.size;
        let waiting = vec![([0, 0], image)];
        Self(Arc::new(Mutex::new(Cells { size, waiting, texture: None })))
    }

    /// Replaces cells, from `at` across and down.
    pub(super) fn write(&self, at: [usize; 2], image: ColorImage) {
        let mut cells = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if image.size == cells.size {
            cells.waiting.clear();
        }
        cells.waiting.push((at, image));
    }

    /// Cells that wait: they were written, but not drawn since.
    pub(super) fn waiting(&self) -> usize {
        let cells = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        cells.waiting.iter().map(|(_, image)| image.pixels.len()).sum()
    }

    fn bring(&self, device: &Device, queue: &Queue, pipelines: &Pipelines) {
        let mut cells = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let Cells { size, waiting, texture } = &mut *cells;
        let (texture, _) = texture.get_or_insert_with(|| pipelines.texture(device, *size));
        for (at, image) in waiting.drain(..) {
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

    fn bound(&self, blended: bool) -> Option<BindGroup> {
        let cells = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        cells.texture.as_ref().map(|(_, bound)| bound[usize::from(blended)].clone())
    }
}

/// A corner of what is drawn: where in the window, in points, and of what.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    /// Where in the window.
    pub(super) point: Pos2,
    /// Where in the sheet, 0..1.
    pub(super) place: Pos2,
    /// Which colour, where there is no sheet.
    pub(super) color: Color32,
}

/// Four corners, one after the other around it.
pub(super) struct Quad {
    /// The corners.
    pub(super) corners: [Corner; 4],
    /// The sheet, and whether its cells blend; without one the colours are drawn.
    pub(super) sheet: Option<(Sheet, bool)>,
}

impl Quad {
    /// Four points, each in its colour; between them they blend.
    pub(super) fn colored(corners: [(Pos2, Color32); 4]) -> Self {
        let corners = corners.map(|(point, color)| Corner { point, place: Pos2::ZERO, color });
        Self { corners, sheet: None }
    }
}

/// Fills a rectangle, whatever its size, at little cost.
pub fn fill(painter: &Painter, rect: Rect, color: Color32) {
    let rect = rect.intersect(painter.clip_rect());
    // On whole pixels, as egui draws rectangles.
    let density = painter.pixels_per_point();
    let even = |at: Pos2| pos2((at.x * density).round(), (at.y * density).round()) / density;
    let (min, max) = (even(rect.min), even(rect.max));
    let points = [min, pos2(max.x, min.y), max, pos2(min.x, max.y)];
    draw(painter, vec![Quad::colored(points.map(|point| (point, color)))]);
}

/// Draws opaque quads, in order, within the painter's clip.
pub(super) fn draw(painter: &Painter, quads: Vec<Quad>) {
    let context = painter.ctx();
    let visible = painter.clip_rect().intersect(context.content_rect());
    if quads.is_empty() || !visible.is_positive() {
        return;
    }
    let format = context.data(|data| data.get_temp(format_id())).unwrap_or(FORMAT);
    let job = Job { quads, format, vertices: OnceLock::new() };
    painter.add(Callback::new_paint_callback(visible, job));
}

struct Job {
    quads: Vec<Quad>,
    format: TextureFormat,
    vertices: OnceLock<Buffer>,
}

impl Job {
    /// Two triangles a quad, on a screen of so many points.
    fn vertices(&self, [width, height]: [f32; 2]) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.quads.len() * 6 * VERTEX_BYTES);
        for corner in
            self.quads.iter().flat_map(|quad| [0, 1, 2, 0, 2, 3].map(|at| quad.corners[at]))
        {
            let Corner { point, place, color } = corner;
            let position = [2.0 * point.x / width - 1.0, 1.0 - 2.0 * point.y / height];
            for value in [position[0], position[1], place.x, place.y] {
                bytes.extend(value.to_ne_bytes());
            }
            bytes.extend(color.to_array());
        }
        bytes
    }
}

impl CallbackTrait for Job {
    fn prepare(
        &self,
        device: &Device,
        queue: &Queue,
        screen: &ScreenDescriptor,
        _: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if resources.get().is_none_or(|kept: &Pipelines| kept.format != self.format) {
            resources.insert(Pipelines::new(device, self.format));
        }
        let Some(pipelines) = resources.get::<Pipelines>() else { return Vec::new() };
        for (sheet, _) in self.quads.iter().filter_map(|quad| quad.sheet.as_ref()) {
            sheet.bring(device, queue, pipelines);
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
        for (index, quad) in (0_u32..).zip(&self.quads) {
            match &quad.sheet {
                Some((sheet, blended)) => {
                    let Some(bound) = sheet.bound(*blended) else { continue };
                    pass.set_pipeline(&pipelines.picture);
                    pass.set_bind_group(0, &bound, &[]);
                }
                None => pass.set_pipeline(&pipelines.even),
            }
            pass.draw(6 * index..6 * index + 6, 0..1);
        }
    }
}
