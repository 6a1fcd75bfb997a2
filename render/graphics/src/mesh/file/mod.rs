//! Models read from files.
mod part;
mod obj;
mod gltf;
mod ply;

use std::path::Path;

use documents::file::{is_standard_input, read};

pub use part::MeshError;

use super::model::Mesh;

/// Reads the bytes of a model. Pass its name for errors, and the folder of its pictures.
type Reader = fn(&str, &Path, &[u8]) -> Result<Mesh, MeshError>;

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

impl Mesh {
    /// Reads a model from a Wavefront OBJ file with its materials, a glTF 2.0 file (`.gltf` or
    /// `.glb`) or a PLY file. The file extension gives the format. If you pass `-` for standard
    /// input, its first bytes do. This computes missing normals.
    ///
    /// # Errors
    /// [`MeshError`] with the path, the line or element, and the reason.
    pub fn open(path: &Path) -> Result<Self, MeshError> {
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
        let folder = path.parent().unwrap_or(Path::new(""));
        let Some(reader) = by_ending.or_else(|| by_content(&bytes)) else {
            return Err(MeshError::UnknownFormat { name, extension });
        };
        let mut mesh = reader(&name, folder, &bytes)?;
        // Computing normals needs a valid mesh.
        mesh.check().map_err(|fault| MeshError::Faulty(name, fault))?;
        mesh.complete_normals();
        Ok(mesh)
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
            let mesh = by_content(bytes).unwrap()("-", Path::new(""), bytes).unwrap();
            assert_eq!(mesh.triangles.len(), 1);
        }
        for gltf in [&b"glTF\x02\0\0\0"[..], b" {\"asset\": {}}"] {
            let reader = by_content(gltf).unwrap();
            let error = reader("-", Path::new(""), gltf).unwrap_err().to_string();
            let wanted = gltf::read("-", Path::new(""), gltf).unwrap_err().to_string();
            assert_eq!(error, wanted);
        }
        for other in [&b"no model\nat all\n"[..], b"", b"plys and planks"] {
            assert!(by_content(other).is_none(), "{other:?}");
        }
    }
}
