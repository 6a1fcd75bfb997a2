//! Parts of a model as files store them, which we append to one mesh. Also texture images, and
//! errors of reading models.

use std::io::Cursor;

use documents::file::FileError;
use documents::hint::Explain;
use image::{ImageReader, Limits};

use crate::mesh::model::{Material, Mesh, MeshFault, Texture, Triangle};
use crate::picture_formats::{NAMES, fault_of_coding};

#[derive(Debug, Default)]
pub(super) struct Part {
    pub(super) positions: Vec<[f32; 3]>,
    /// One per position or empty. This also holds for the next two lists.
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) texture_coordinates: Vec<[f32; 2]>,
    pub(super) colors: Vec<[f32; 3]>,
    pub(super) corners: Vec<u32>,
    pub(super) material: u32,
}

/// Light grey, for a model without materials and vertex colours.
pub(super) const PLAIN: Material =
    Material { name: String::new(), color: [0.8, 0.8, 0.8], texture: None };

/// White, for a model without materials but with vertex colours. This shows the vertex colours
/// unchanged.
pub(super) const PAINTED: Material =
    Material { name: String::new(), color: [1.0; 3], texture: None };

impl Part {
    /// Appends this part to a mesh. This fills in missing attributes. Missing normals become
    /// zeros, and we compute them later.
    pub(super) fn append_to(self, mesh: &mut Mesh) {
        let first = mesh.positions.len() as u32;
        let count = first as usize + self.positions.len();
        mesh.positions.extend(self.positions);
        mesh.normals.extend(self.normals);
        mesh.normals.resize(count, [0.0; 3]);
        mesh.texture_coordinates.extend(self.texture_coordinates);
        mesh.texture_coordinates.resize(count, [0.0; 2]);
        mesh.colors.extend(self.colors);
        mesh.colors.resize(count, [1.0; 3]);
        let material = self.material;
        mesh.triangles.extend(self.corners.chunks_exact(3).map(|corners| Triangle {
            // An index out of range must stay out of range for the check.
            corners: [0, 1, 2].map(|i| first.saturating_add(corners[i])),
            material,
        }));
    }
}

/// Longest side of an accepted texture, in texels: the usual limit of graphics devices.
const LONGEST: u32 = 16_384;

impl Texture {
    /// Decodes a PNG, JPEG, TIFF or WebP image. If it cannot, the error is the decoder's reason.
    pub(super) fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        if let Some(fault) = fault_of_coding(bytes) {
            return Err(fault);
        }
        let mut reader = ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(|error| error.to_string())?;
        let mut limits = Limits::default();
        limits.max_image_width = Some(LONGEST);
        limits.max_image_height = Some(LONGEST);
        reader.limits(limits);
        let picture = reader.decode().map_err(|error| error.to_string())?.into_rgba8();
        let (width, height) = picture.dimensions();
        let texels = picture.pixels().map(|pixel| u32::from_le_bytes(pixel.0)).collect();
        Ok(Self { width, height, texels })
    }
}

/// A model could not be read. Every message starts with the file's path.
#[derive(Debug, thiserror::Error, Explain)]
pub enum MeshError {
    /// The file cannot be opened or read.
    #[error(transparent)]
    Unreadable(#[from] FileError),
    /// We do not support the format of this file extension.
    #[error("{name}: no file extension of a model: `{extension}`")]
    #[hint("models are read from .obj, .gltf, .glb and .ply files")]
    UnknownFormat {
        /// Path of the file.
        name: String,
        /// The extension, lower case, empty if there is none.
        extension: String,
    },
    /// The content violates the file's format.
    #[error("{name}: {place}: {reason}")]
    #[hint("correct that place, or export the model again")]
    Malformed {
        /// Path of the file.
        name: String,
        /// Line or element, for example `line 12`.
        place: String,
        /// Reason, with the offending text.
        reason: String,
    },
    /// A texture image of the model cannot be read.
    #[error("{name}: the texture `{texture}`: {reason}")]
    #[hint(
        "put the picture ({NAMES}) where the model names it, or export the model with its \
        pictures"
    )]
    Texture {
        /// Path of the model.
        name: String,
        /// Path of the image as the model gives it.
        texture: String,
        /// Reason why it cannot be read.
        reason: String,
    },
    /// The file was read, but its mesh fails [`Mesh::check`](crate::mesh::Mesh::check).
    #[error("{0}: {1}")]
    #[hint(inner = 1)]
    Faulty(String, #[source] MeshFault),
}

#[cfg(test)]
mod tests {
    use documents::hint::Fault;

    use super::*;

    #[test]
    fn a_file_that_is_not_there_is_no_fault_of_the_data() {
        let error = Mesh::open("no/such/model.obj".as_ref()).unwrap_err();
        assert_eq!(error.fault(), Fault::Environment, "{error}");
        let name = "model.obj".to_owned();
        let place = "line 1".to_owned();
        let torn = MeshError::Malformed { name, place, reason: "torn".to_owned() };
        assert_eq!(torn.fault(), Fault::Input);
    }
}
