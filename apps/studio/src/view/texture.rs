//! Textures of cells, which we upload when they are next drawn, and the large quads that show them.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use eframe::egui::epaint::{Vertex as MeshVertex, WHITE_UV};
use eframe::egui::{
    Color32, ColorImage, Context, Mesh, Pos2, Shape, TextureHandle, TextureId, TextureOptions,
};
#[cfg(feature = "wgpu")]
use eframe::egui_wgpu::wgpu::{self, BindGroup, Device, Extent3d, Origin3d, Queue};

#[cfg(feature = "wgpu")]
use super::pipeline::Pipelines;

/// A texture. Its cells are uploaded when it is next drawn.
#[derive(Clone)]
pub(super) struct LazyTexture(Arc<Mutex<TextureState>>);

struct TextureState {
    size: [usize; 2],
    /// Cells to upload, each with its column and row. Until the texture is made, the first entry
    /// has all cells.
    pending: Vec<([usize; 2], ColorImage)>,
    /// The texture, with bind groups for nearest and linear filtering.
    #[cfg(feature = "wgpu")]
    texture: Option<(wgpu::Texture, [BindGroup; 2])>,
    /// The texture if egui draws it, and whether its cells are interpolated.
    of_egui: Option<(TextureHandle, bool)>,
    first: Color32,
}

impl LazyTexture {
    pub(super) fn new(image: ColorImage) -> Self {
        Self(Arc::new(Mutex::new(TextureState {
            size: image.size,
            first: image.pixels.first().copied().unwrap_or_default(),
            pending: vec![([0, 0], image)],
            #[cfg(feature = "wgpu")]
            texture: None,
            of_egui: None,
        })))
    }

    fn state(&self) -> MutexGuard<'_, TextureState> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Replaces a rectangle of cells with the upper left corner `at` (column, row).
    pub(super) fn write(&self, at: [usize; 2], image: ColorImage) {
        let mut state = self.state();
        if image.size == state.size {
            state.pending.clear();
        }
        if at == [0, 0] {
            state.first = image.pixels.first().copied().unwrap_or(state.first);
        }
        state.pending.push((at, image));
    }

    /// Number of cells written but not drawn since.
    pub(super) fn pending_cells(&self) -> usize {
        self.state().pending.iter().map(|(_, image)| image.pixels.len()).sum()
    }

    /// The texture in egui. It uploads new cells with this frame.
    pub(super) fn for_egui(&self, context: &Context, smooth: bool) -> TextureId {
        let mut state = self.state();
        let TextureState { pending, of_egui, first, .. } = &mut *state;
        let options = if smooth { TextureOptions::LINEAR } else { TextureOptions::NEAREST };
        let mut pending = pending.drain(..);
        if of_egui.is_none() {
            let all = pending.next().map(|(_, image)| image);
            let all = all.unwrap_or_else(|| ColorImage::filled([1, 1], *first));
            *of_egui = Some((context.load_texture("cells", all, options), smooth));
        }
        let Some((texture, is_smooth)) = of_egui else { return TextureId::default() };
        for (at, image) in pending {
            texture.set_partial(at, image, options);
        }
        if *is_smooth != smooth {
            // The options change only with an upload.
            texture.set_partial([0, 0], ColorImage::filled([1, 1], *first), options);
            *is_smooth = smooth;
        }
        texture.id()
    }

    /// Uploads new cells. This creates the texture the first time.
    #[cfg(feature = "wgpu")]
    pub(super) fn upload(&self, device: &Device, queue: &Queue, pipelines: &Pipelines) {
        let mut state = self.state();
        let TextureState { size, pending, texture, .. } = &mut *state;
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
    #[cfg(feature = "wgpu")]
    pub(super) fn bind_group(&self, smooth: bool) -> Option<BindGroup> {
        self.state().texture.as_ref().map(|(_, bound)| bound[usize::from(smooth)].clone())
    }
}

#[derive(Clone, Copy)]
pub(super) struct Vertex {
    /// Position in the window, in points.
    pub(super) point: Pos2,
    /// Texture coordinates, 0 to 1.
    pub(super) uv: Pos2,
    /// Colour, used if there is no texture.
    pub(super) color: Color32,
}

pub(super) struct Quad {
    /// The four corners, in order around the quad.
    pub(super) corners: [Vertex; 4],
    /// The texture, and whether its cells are interpolated. Without a texture, we draw the vertex
    /// colours.
    pub(super) texture: Option<(LazyTexture, bool)>,
}

/// Corners of the two triangles of a quad.
pub(super) const TRIANGLES: [usize; 6] = [0, 1, 2, 0, 2, 3];

impl Quad {
    /// A quad without texture. It interpolates the corner colours.
    pub(super) fn colored(corners: [(Pos2, Color32); 4]) -> Self {
        let corners = corners.map(|(point, color)| Vertex { point, uv: Pos2::ZERO, color });
        Self { corners, texture: None }
    }
}

/// Opaque quads in order as meshes that egui draws by its own shader. Neighbours with the same
/// texture become one mesh.
pub(super) fn meshes(quads: &[Quad], context: &Context) -> Shape {
    let mut meshes: Vec<Mesh> = Vec::new();
    for quad in quads {
        let texture = quad.texture.as_ref();
        let id = texture
            .map_or(TextureId::default(), |(texture, smooth)| texture.for_egui(context, *smooth));
        if meshes.last().is_none_or(|last| last.texture_id != id) {
            meshes.push(Mesh::with_texture(id));
        }
        let Some(mesh) = meshes.last_mut() else { continue };
        let first = mesh.vertices.len() as u32;
        mesh.vertices.extend(quad.corners.iter().map(|corner| match texture {
            Some(_) => MeshVertex { pos: corner.point, uv: corner.uv, color: Color32::WHITE },
            None => MeshVertex { pos: corner.point, uv: WHITE_UV, color: corner.color },
        }));
        mesh.indices.extend(TRIANGLES.iter().map(|corner| first + *corner as u32));
    }
    Shape::Vec(meshes.into_iter().map(Shape::mesh).collect())
}
