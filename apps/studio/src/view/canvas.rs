//! Draws quads in the window, by our own shader or by egui's.
//!
//! egui's shader contains code that filters textures itself. A software driver executes this for
//! every pixel even if it is not needed, so it takes some twenty times as long. Our shader only
//! samples or fills. [`quicken`] also gives it the large opaque areas of egui's widgets, e.g. the
//! trays and cards that took more than half of a frame.

#[cfg(feature = "wgpu")]
use std::sync::OnceLock;

#[cfg(feature = "wgpu")]
use eframe::egui::PaintCallbackInfo;
use eframe::egui::epaint::{ClippedShape, RectShape, WHITE_UV};
use eframe::egui::layers::ShapeIdx;
use eframe::egui::{
    Color32, Context, CornerRadius, Id, LayerId, Mesh, Painter, Rect, Shape, StrokeKind, TextureId,
    Vec2, pos2, vec2,
};
#[cfg(feature = "wgpu")]
use eframe::egui_wgpu::wgpu::TextureFormat;
#[cfg(feature = "wgpu")]
use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait, ScreenDescriptor, wgpu};

#[cfg(feature = "wgpu")]
use super::pipeline::{Pipelines, VERTEX_BYTES, vertex_buffer};
use super::texture::{Quad, meshes};
#[cfg(feature = "wgpu")]
use super::texture::{TRIANGLES, Vertex};
#[cfg(feature = "wgpu")]
use wgpu::{Buffer, Device, Queue};

/// The way in which the quads of a window are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drawing {
    /// By our own shader, into pixels of this format.
    #[cfg(feature = "wgpu")]
    OwnShader(TextureFormat),
    /// By egui. Use this for windows without wgpu.
    Egui,
}

impl Default for Drawing {
    /// Used as long as you set none, as in tests.
    #[cfg(feature = "wgpu")]
    fn default() -> Self {
        Self::OwnShader(TextureFormat::Rgba8Unorm)
    }

    #[cfg(not(feature = "wgpu"))]
    fn default() -> Self {
        Self::Egui
    }
}

fn drawing_id() -> Id {
    Id::unique("how quads are drawn")
}

/// Sets whether our own shader or egui draws the quads. Call this before the first frame.
pub fn set_drawing(context: &Context, drawing: Drawing) {
    context.data_mut(|data| data.insert_temp(drawing_id(), drawing));
}

/// The window in which quads are drawn.
pub(super) struct QuadCanvas {
    /// The part of the window with contents, in points.
    pub(super) visible: Rect,
    pub(super) density: f32,
    pub(super) drawing: Drawing,
    context: Context,
}

impl QuadCanvas {
    pub(super) fn of(context: &Context) -> Self {
        Self {
            visible: context.content_rect(),
            density: context.pixels_per_point(),
            drawing: context.data(|data| data.get_temp(drawing_id())).unwrap_or_default(),
            context: context.clone(),
        }
    }

    /// A rectangle rounded to pixels, as egui does for rectangles.
    pub(super) fn rounded(&self, rect: Rect) -> Rect {
        let [min, max] = [rect.min, rect.max]
            .map(|at| ((at.to_vec2() * self.density).round() / self.density).to_pos2());
        Rect::from_min_max(min, max)
    }

    /// A length rounded up to pixels.
    pub(super) fn rounded_up(&self, length: f32) -> f32 {
        (length * self.density).ceil() / self.density
    }

    /// A shape that draws opaque quads in order.
    pub(super) fn shape(&self, quads: Vec<Quad>) -> Shape {
        match self.drawing {
            #[cfg(feature = "wgpu")]
            Drawing::OwnShader(format) => shape(quads, format, self.visible),
            Drawing::Egui => meshes(&quads, &self.context),
        }
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

/// Smallest area of a fill that we draw with our own shader, in pixels. For a smaller one, the
/// switch between shaders costs more than it saves.
const LEAST_AREA: f32 = 2500.0;

/// Draws the large opaque fills of this frame with our own shader, which is faster. Call this after
/// you have drawn the whole frame.
pub fn quicken(context: &Context) {
    let canvas = QuadCanvas::of(context);
    if canvas.drawing == Drawing::Egui {
        return;
    }
    let mut layers: Vec<LayerId> = context.memory(|memory| memory.layer_ids().collect());
    if !layers.contains(&LayerId::background()) {
        layers.push(LayerId::background());
    }
    layers.retain(|layer| context.layer_transform_to_global(*layer).is_none());
    context.graphics_mut(|graphics| {
        for layer in layers {
            let Some(list) = graphics.get_mut(layer) else { continue };
            for index in 0..list.next_idx().0 {
                list.mutate_shape(ShapeIdx(index), |clipped| quicken_shape(clipped, &canvas));
            }
        }
    });
}

fn quicken_shape(clipped: &mut ClippedShape, canvas: &QuadCanvas) {
    let area = |rect: Rect| {
        let seen = rect.intersect(clipped.clip_rect).intersect(canvas.visible);
        if seen.is_positive() { seen.area() * canvas.density * canvas.density } else { 0.0 }
    };
    let quick = match &clipped.shape {
        Shape::Rect(rect) if is_plain(rect) && area(rect.rect) >= LEAST_AREA => {
            Some(Shape::Vec(rectangle(rect, canvas)))
        }
        Shape::Mesh(mesh) if area(mesh.calc_bounds()) >= LEAST_AREA && is_opaque(mesh) => {
            Some(canvas.shape(triangles(mesh)))
        }
        _ => None,
    };
    if let Some(quick) = quick {
        clipped.shape = quick;
    }
}

/// Whether a rectangle is opaque, upright and sharp.
fn is_plain(shape: &RectShape) -> bool {
    shape.fill.is_opaque()
        && shape.brush.is_none()
        && shape.blur_width == 0.0
        && shape.angle == 0.0
        && shape.round_to_pixels != Some(false)
        && (shape.stroke.is_empty() || shape.stroke_kind != StrokeKind::Middle)
}

/// The shapes of a filled rectangle: its fill as quads without the corners, and the rounded corners
/// and the outline for egui.
fn rectangle(shape: &RectShape, canvas: &QuadCanvas) -> Vec<Shape> {
    let rect = canvas.rounded(shape.rect);
    let CornerRadius { nw, ne, sw, se } = shape.corner_radius;
    let radius = f32::from(nw.max(ne).max(sw).max(se));
    let line = if shape.stroke.is_empty() { Vec::new() } else { outline(shape) };
    // Beyond half of the side, egui makes the radius smaller.
    let corner = canvas.rounded_up(radius);
    if 2.0 * corner >= rect.size().min_elem() {
        return vec![shape.clone().into()];
    }
    let inner = rect.shrink2(vec2(corner, 0.0));
    let mut parts = vec![inner];
    if corner > 0.0 {
        let [left, right] = [(rect.left(), inner.left()), (inner.right(), rect.right())];
        let top = rect.top() + corner;
        let bottom = rect.bottom() - corner;
        parts.extend(
            [left, right].map(|(from, to)| Rect::from_min_max(pos2(from, top), pos2(to, bottom))),
        );
    }
    let quads = parts.into_iter().map(|part| filled(part, shape.fill)).collect();
    let mut all = vec![canvas.shape(quads)];
    if corner > 0.0 {
        all.extend(corners(rect, corner, shape));
    }
    all.extend(line);
    all
}

/// Small rectangles with the four corners. They overlap the quads.
fn corners(rect: Rect, corner: f32, shape: &RectShape) -> impl Iterator<Item = Shape> {
    let size = Vec2::splat(2.0 * corner);
    let fill = shape.fill;
    let radius = shape.corner_radius;
    let at = [
        rect.min,
        pos2(rect.right() - size.x, rect.top()),
        pos2(rect.left(), rect.bottom() - size.y),
        rect.max - size,
    ];
    // Each has one of the four radii. The others would leave gaps.
    let only = [
        CornerRadius { nw: radius.nw, ..CornerRadius::ZERO },
        CornerRadius { ne: radius.ne, ..CornerRadius::ZERO },
        CornerRadius { sw: radius.sw, ..CornerRadius::ZERO },
        CornerRadius { se: radius.se, ..CornerRadius::ZERO },
    ];
    at.into_iter().zip(only).map(move |(min, radius)| {
        RectShape::filled(Rect::from_min_size(min, size), radius, fill).into()
    })
}

fn outline(shape: &RectShape) -> Vec<Shape> {
    vec![RectShape { fill: Color32::TRANSPARENT, ..shape.clone() }.into()]
}

fn filled(rect: Rect, color: Color32) -> Quad {
    let corners = [rect.left_top(), rect.right_top(), rect.right_bottom(), rect.left_bottom()];
    Quad::colored(corners.map(|corner| (corner, color)))
}

/// Whether a mesh has no texture and covers everything below.
fn is_opaque(mesh: &Mesh) -> bool {
    mesh.texture_id == TextureId::default()
        && mesh.vertices.iter().all(|vertex: &eframe::egui::epaint::Vertex| {
            vertex.color.is_opaque() && vertex.uv == WHITE_UV
        })
}

/// The triangles of a mesh. Each is a quad with a last side of no length.
fn triangles(mesh: &Mesh) -> Vec<Quad> {
    let three = mesh.indices.chunks_exact(3);
    three
        .map(|at| {
            Quad::colored([at[0], at[1], at[2], at[2]].map(|index: u32| {
                let vertex = &mesh.vertices[index as usize];
                (vertex.pos, vertex.color)
            }))
        })
        .collect()
}

/// A shape that draws opaque quads in order, into pixels of this format. `visible` is the part of
/// the window with contents, in points.
#[cfg(feature = "wgpu")]
pub(super) fn shape(quads: Vec<Quad>, format: TextureFormat, visible: Rect) -> Shape {
    let job = DrawQuads { quads, format, vertices: OnceLock::new() };
    Callback::new_paint_callback(visible, job).into()
}

#[cfg(feature = "wgpu")]
struct DrawQuads {
    quads: Vec<Quad>,
    format: TextureFormat,
    vertices: OnceLock<Buffer>,
}

#[cfg(feature = "wgpu")]
impl DrawQuads {
    /// The vertex data for a screen size in points, two triangles per quad.
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

#[cfg(feature = "wgpu")]
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
        // We draw neighbours without a texture at once.
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
