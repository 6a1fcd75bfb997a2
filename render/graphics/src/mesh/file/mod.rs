//! Models read from files.
mod part;
mod obj;
mod gltf;
mod ply;

use std::path::{Path, PathBuf};

use documents::file::{Outside, is_standard_input, read};

pub use part::MeshError;

use super::model::Mesh;

/// Reads the bytes of a model. The path is for errors and to find the files that the model names.
type Reader = fn(&Path, &[u8], Outside) -> Result<part::Read, MeshError>;

/// Recognises a model without a name. Most formats have known first bytes. An OBJ file has a line
/// with a vertex.
fn by_content(bytes: &[u8]) -> Option<Reader> {
    let start = bytes.trim_ascii_start();
    let mut lines = bytes.split(|byte| matches!(byte, b'\n' | b'\r'));
    if start.starts_with(b"glTF") || start.starts_with(b"{") {
        Some(gltf::read)
    } else if start.starts_with(b"ply\n") || start.starts_with(b"ply\r") {
        Some(ply::read)
    } else if lines.any(|line| line.trim_ascii_start().starts_with(b"v ")) {
        Some(obj::read)
    } else {
        None
    }
}

/// A model that was read from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelFile {
    /// The mesh. Its normals have length 1.
    pub mesh: Mesh,
    /// The place of the mesh's origin in the coordinates of the file, in the model's own unit. This
    /// is 0 unless the model lies farther from the origin than 16 of its widths, for example in UTM
    /// coordinates. We move such a model to the origin, because the 32-bit numbers of a mesh tell
    /// only places some centimetres apart there. Subtract this from everything that has the
    /// coordinates of the file, e.g. cameras.
    pub origin: [f64; 3],
    /// The files that the model names, e.g. its textures, each once.
    pub files: Vec<PathBuf>,
}

impl ModelFile {
    /// Reads a model from a Wavefront OBJ file with its materials, a glTF 2.0 file (`.gltf` or
    /// `.glb`) or a PLY file. The file extension gives the format. If you pass `-` for standard
    /// input, its first bytes do. This computes missing normals. `outside` says which files the
    /// model may name.
    ///
    /// # Errors
    /// [`MeshError`] with the path, the line or element, and the reason.
    pub fn open(path: &Path, outside: Outside) -> Result<Self, MeshError> {
        let name = path.display().to_string();
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let by_ending: Option<Reader> = match extension.as_str() {
            "obj" => Some(obj::read),
            "gltf" | "glb" => Some(gltf::read),
            "ply" => Some(ply::read),
            _ if is_standard_input(path) => None,
            _ => return Err(MeshError::UnknownFormat { name, extension }),
        };
        let bytes = read(path)?;
        let Some(reader) = by_ending.or_else(|| by_content(&bytes)) else {
            return Err(MeshError::UnknownFormat { name, extension });
        };
        let (mut mesh, origin, files) = reader(path, &bytes, outside)?;
        mesh.complete_normals();
        Ok(Self { mesh, origin, files })
    }
}

impl Mesh {
    /// Reads a model like [`ModelFile::open`]. It may name files only in its own folder and below.
    ///
    /// # Errors
    /// [`MeshError`] with the path, the line or element, and the reason.
    pub fn open(path: &Path) -> Result<Self, MeshError> {
        ModelFile::open(path, Outside::Refused).map(|file| file.mesh)
    }

    /// Normalises the normals, and computes missing ones (stored as zeros).
    fn complete_normals(&mut self) {
        fn unit(normal: &[f32; 3]) -> Option<glam::Vec3> {
            glam::Vec3::from(*normal).try_normalize()
        }
        if self.normals.iter().all(|normal| unit(normal).is_some()) {
            self.normals.iter_mut().for_each(|normal| {
                *normal = glam::Vec3::from(*normal).normalize().into();
            });
            return;
        }
        let computed = self.vertex_normals();
        for (normal, computed) in self.normals.iter_mut().zip(computed) {
            *normal = unit(normal).map_or(computed, Into::into);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn models_without_a_name_are_known_by_their_first_bytes() {
        let ply = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
            property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
            0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
        let obj = b"# a triangle\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        for bytes in [&ply[..], obj] {
            let reader = by_content(bytes).unwrap();
            let (mesh, ..) = reader(Path::new("-"), bytes, Outside::Refused).unwrap();
            assert_eq!(mesh.triangles.len(), 1);
        }
        for gltf in [&b"glTF\x02\0\0\0"[..], b" {\"asset\": {}}"] {
            let reader = by_content(gltf).unwrap();
            let error = reader(Path::new("-"), gltf, Outside::Refused).unwrap_err();
            let wanted = gltf::read(Path::new("-"), gltf, Outside::Refused).unwrap_err();
            assert_eq!(error.to_string(), wanted.to_string());
        }
        for other in [&b"no model\nat all\n"[..], b"", b"plys and planks"] {
            assert!(by_content(other).is_none(), "{other:?}");
        }
    }
}
