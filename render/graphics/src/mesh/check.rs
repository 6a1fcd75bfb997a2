//! What a mesh must be before it is drawn.

use super::model::Mesh;

/// What is wrong with a mesh; all indices count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshFault {
    /// Nothing to be drawn.
    #[error("it has no triangle")]
    NoTriangle,
    /// A list of vertices that is too short or too long.
    #[error("{found} {what} for {wanted} vertices")]
    Lengths {
        /// Of what.
        what: &'static str,
        /// So many.
        found: usize,
        /// As there are positions.
        wanted: usize,
    },
    /// Infinite or not a number.
    #[error("vertex {vertex} has the {what} `{found:?}`")]
    NotFinite {
        /// Which one.
        vertex: usize,
        /// Which of its values.
        what: &'static str,
        /// As found.
        found: Vec<f32>,
    },
    /// A corner beyond the last vertex.
    #[error("triangle {triangle} has vertex {found}, of {vertices}")]
    NoSuchVertex {
        /// Which one.
        triangle: usize,
        /// The index.
        found: u32,
        /// How many there are.
        vertices: usize,
    },
    /// A material beyond the last.
    #[error("triangle {triangle} has material {found}, of {materials}")]
    NoSuchMaterial {
        /// Which one.
        triangle: usize,
        /// The index.
        found: u32,
        /// How many there are.
        materials: usize,
    },
    /// A colour out of 0..1.
    #[error("material {material} has the colour `{found:?}`")]
    Color {
        /// Which one.
        material: usize,
        /// As found.
        found: [f32; 3],
    },
    /// A texture without a texel, or with too few or too many.
    #[error("the texture of material {material} has {texels} texels for {width} x {height}")]
    Texture {
        /// Of which.
        material: usize,
        /// How many there are.
        texels: usize,
        /// Texels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
}

impl MeshFault {
    /// What can be done.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::NoTriangle => "export the model with its faces; points and lines are not drawn",
            Self::Lengths { .. } | Self::Texture { .. } => "give every vertex and texel its value",
            Self::NotFinite { .. } => {
                "clean the model in the program that made it (Blender: Mesh > Clean Up)"
            }
            Self::NoSuchVertex { .. } | Self::NoSuchMaterial { .. } => {
                "the file is damaged: export it again"
            }
            Self::Color { .. } => "colours are encoded sRGB from 0 to 1",
        }
    }
}

impl Mesh {
    /// Whether it can be drawn.
    ///
    /// # Errors
    /// The first [`MeshFault`].
    pub fn check(&self) -> Result<(), MeshFault> {
        let wanted = self.positions.len();
        for (what, found) in [
            ("normals", self.normals.len()),
            ("texture coordinates", self.texture_coordinates.len()),
            ("colours", self.colors.len()),
        ] {
            if found != wanted {
                return Err(MeshFault::Lengths { what, found, wanted });
            }
        }
        finite("position", &self.positions)?;
        finite("normal", &self.normals)?;
        finite("texture coordinate", &self.texture_coordinates)?;
        finite("colour", &self.colors)?;
        for (material, it) in self.materials.iter().enumerate() {
            if it.color.iter().any(|value| !(0.0..=1.0).contains(value)) {
                return Err(MeshFault::Color { material, found: it.color });
            }
            let Some(texture) = &it.texture else { continue };
            let (width, height, texels) = (texture.width, texture.height, texture.texels.len());
            if texels == 0 || width as usize * height as usize != texels {
                return Err(MeshFault::Texture { material, texels, width, height });
            }
        }
        if self.triangles.is_empty() {
            return Err(MeshFault::NoTriangle);
        }
        let materials = self.materials.len();
        for (triangle, it) in self.triangles.iter().enumerate() {
            if let Some(&found) = it.corners.iter().find(|&&corner| corner as usize >= wanted) {
                return Err(MeshFault::NoSuchVertex { triangle, found, vertices: wanted });
            }
            if it.material as usize >= materials {
                let found = it.material;
                return Err(MeshFault::NoSuchMaterial { triangle, found, materials });
            }
        }
        Ok(())
    }
}

fn finite<const N: usize>(what: &'static str, values: &[[f32; N]]) -> Result<(), MeshFault> {
    match values.iter().position(|value| value.iter().any(|number| !number.is_finite())) {
        None => Ok(()),
        Some(vertex) => Err(MeshFault::NotFinite { vertex, what, found: values[vertex].to_vec() }),
    }
}
