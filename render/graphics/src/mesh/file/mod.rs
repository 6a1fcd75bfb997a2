//! Models read from files.

mod error;

mod part;

mod picture;

mod obj_lines;

mod obj;

mod gltf_values;

mod gltf;

mod ply;

use std::path::Path;

pub use error::MeshError;

use super::model::Mesh;

impl Mesh {
    /// Reads a model from a Wavefront OBJ file with its materials, a glTF 2.0 file (`.gltf`
    /// or `.glb`) or a PLY file. The format follows from the file extension. Missing normals
    /// are computed.
    ///
    /// # Errors
    /// [`MeshError`] with the path, the line or element, and the reason.
    pub fn open(path: &Path) -> Result<Self, MeshError> {
        let name = path.display().to_string();
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let read = match extension.as_str() {
            "obj" => obj::read,
            "gltf" | "glb" => gltf::read,
            "ply" => ply::read,
            _ => return Err(MeshError::UnknownFormat { name, extension }),
        };
        let bytes = std::fs::read(path)
            .map_err(|error| MeshError::Unreadable { name: name.clone(), error })?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut mesh = read(&name, folder, &bytes)?;
        // Computing normals needs a valid mesh.
        mesh.check().map_err(|fault| MeshError::Faulty { name, fault })?;
        mesh.complete_normals();
        Ok(mesh)
    }

    /// Normalises the normals, and computes those that are missing (stored as zeros).
    fn complete_normals(&mut self) {
        let unit = |normal: &[f32; 3]| glam::Vec3::from(*normal).try_normalize();
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
