//! Validity of a mesh: the conditions that rendering relies on.

use documents::counted_as;
use documents::hint::{Explain, Hint};

use super::model::Mesh;

/// A defect of a mesh. All indices count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshFault {
    /// The mesh has no triangles.
    #[error("the mesh has no triangle")]
    NoTriangle,
    /// A per-vertex list has another length than the list of positions.
    #[error("{found} {what} for {}", counted_as(*wanted, "vertex", "vertices"))]
    ListLength {
        /// Name of the list, for example `normals`.
        what: &'static str,
        /// Length of that list.
        found: usize,
        /// Number of positions.
        wanted: usize,
    },
    /// A vertex attribute is infinite or not a number.
    #[error("vertex {vertex} has the {what} `{found:?}`")]
    NotFinite {
        /// Index of the vertex.
        vertex: usize,
        /// Name of the attribute, for example `position`.
        what: &'static str,
        /// Value of the attribute.
        found: Vec<f32>,
    },
    /// A triangle refers to a vertex that does not exist.
    #[error("triangle {triangle} has vertex {found}, of {vertices}")]
    NoSuchVertex {
        /// Index of the triangle.
        triangle: usize,
        /// Vertex index it refers to.
        found: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A triangle refers to a material that does not exist.
    #[error("triangle {triangle} has material {found}, of {materials}")]
    NoSuchMaterial {
        /// Index of the triangle.
        triangle: usize,
        /// Material index it refers to.
        found: u32,
        /// Number of materials.
        materials: usize,
    },
    /// A material's colour is outside 0..1.
    #[error("material {material} has the colour `{found:?}`")]
    Color {
        /// Index of the material.
        material: usize,
        /// The colour, encoded sRGB.
        found: [f32; 3],
    },
    /// A texture is empty, or its texel count is not width times height.
    #[error("the texture of material {material} has {texels} texels for {width} x {height}")]
    Texture {
        /// Index of the material.
        material: usize,
        /// Number of texels.
        texels: usize,
        /// Width in texels.
        width: u32,
        /// Height in texels.
        height: u32,
    },
}

impl Explain for MeshFault {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::NoTriangle => "export the model with its faces; points and lines are not drawn",
            Self::ListLength { .. } | Self::Texture { .. } => {
                "give every vertex and texel its value"
            }
            Self::NotFinite { .. } => {
                "clean the model in the program that made it (Blender: Mesh > Clean Up)"
            }
            Self::NoSuchVertex { .. } | Self::NoSuchMaterial { .. } => {
                "the file is damaged: export it again"
            }
            Self::Color { .. } => "colours are encoded sRGB from 0 to 1",
        }))
    }
}

impl Mesh {
    /// Checks that the mesh can be rendered: consistent list lengths, finite attributes,
    /// valid indices, colours in 0..1.
    ///
    /// # Errors
    /// The first [`MeshFault`] found.
    pub fn check(&self) -> Result<(), MeshFault> {
        let wanted = self.positions.len();
        for (what, found) in [
            ("normals", self.normals.len()),
            ("texture coordinates", self.texture_coordinates.len()),
            ("colours", self.colors.len()),
        ] {
            if found != wanted {
                return Err(MeshFault::ListLength { what, found, wanted });
            }
        }
        check_finite("position", &self.positions)?;
        check_finite("normal", &self.normals)?;
        check_finite("texture coordinate", &self.texture_coordinates)?;
        check_finite("colour", &self.colors)?;
        for (index, material) in self.materials.iter().enumerate() {
            if material.color.iter().any(|value| !(0.0..=1.0).contains(value)) {
                return Err(MeshFault::Color { material: index, found: material.color });
            }
            let Some(texture) = &material.texture else { continue };
            let width = texture.width;
            let height = texture.height;
            let texels = texture.texels.len();
            if texels == 0 || width as usize * height as usize != texels {
                return Err(MeshFault::Texture { material: index, texels, width, height });
            }
        }
        if self.triangles.is_empty() {
            return Err(MeshFault::NoTriangle);
        }
        let materials = self.materials.len();
        for (index, triangle) in self.triangles.iter().enumerate() {
            let corners = triangle.corners;
            if let Some(&found) = corners.iter().find(|&&corner| corner as usize >= wanted) {
                return Err(MeshFault::NoSuchVertex { triangle: index, found, vertices: wanted });
            }
            if triangle.material as usize >= materials {
                let found = triangle.material;
                return Err(MeshFault::NoSuchMaterial { triangle: index, found, materials });
            }
        }
        Ok(())
    }
}

/// Checks that all values of an attribute are finite.
fn check_finite<const N: usize>(what: &'static str, values: &[[f32; N]]) -> Result<(), MeshFault> {
    match values.iter().position(|value| value.iter().any(|number| !number.is_finite())) {
        None => Ok(()),
        Some(vertex) => Err(MeshFault::NotFinite { vertex, what, found: values[vertex].to_vec() }),
    }
}
