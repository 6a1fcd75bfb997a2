//! The window in which quads are drawn: by a shader of their own, or by egui's.

use eframe::egui::{Color32, Context, Id, Painter, Pos2, Rect, Shape, pos2};
#[cfg(feature = "wgpu")]
use eframe::egui_wgpu::wgpu::TextureFormat;

use super::quad::{Quad, meshes};
#[cfg(feature = "wgpu")]
use super::shader;

/// How the quads of a window are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drawing {
    /// By a shader of their own, into pixels of this format.
    #[cfg(feature = "wgpu")]
    OwnShader(TextureFormat),
    /// By egui, for windows without wgpu.
    Egui,
}

impl Default for Drawing {
    /// The format where none was set, as in tests.
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

/// Sets how quads are drawn. To be called before the first frame.
pub fn set_drawing(context: &Context, drawing: Drawing) {
    context.data_mut(|data| data.insert_temp(drawing_id(), drawing));
}

/// The window that quads are drawn in.
pub(super) struct QuadCanvas {
    /// The part of the window that has contents, in points.
    pub(super) visible: Rect,
    /// Pixels per point.
    pub(super) density: f32,
    /// How quads are drawn.
    pub(super) drawing: Drawing,
    context: Context,
}

impl QuadCanvas {
    /// The window of a context.
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
        match self.drawing {
            #[cfg(feature = "wgpu")]
            Drawing::OwnShader(format) => shader::shape(quads, format, self.visible),
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
