//! Large quads in the window: pictures and flat areas.

use eframe::egui::epaint::{Vertex as MeshVertex, WHITE_UV};
use eframe::egui::{Color32, Context, Mesh, Pos2, Shape, TextureId};

use super::texture::LazyTexture;

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

/// Corners of the two triangles of a quad.
pub(super) const TRIANGLES: [usize; 6] = [0, 1, 2, 0, 2, 3];

impl Quad {
    /// A quad without texture whose corner colours are interpolated.
    pub(super) fn colored(corners: [(Pos2, Color32); 4]) -> Self {
        let corners = corners.map(|(point, color)| Vertex { point, uv: Pos2::ZERO, color });
        Self { corners, texture: None }
    }
}

/// Opaque quads in order as meshes that egui draws by its own shader; neighbours of one texture as one mesh.
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
