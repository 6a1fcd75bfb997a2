//! Models from files.

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
    /// Reads a model: Wavefront OBJ with its materials, glTF 2.0 (`.gltf` or `.glb`),
    /// PLY. Told apart by the ending of the name. What has no normals gets smooth
    /// ones.
    ///
    /// # Errors
    /// [`MeshError`] with the path, the line or element, and what is wrong there.
    pub fn open(path: &Path) -> Result<Self, MeshError> {
        let name = path.display().to_string();
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let read = match ending.as_str() {
            "obj" => obj::read,
            "gltf" | "glb" => gltf::read,
            "ply" => ply::read,
            _ => return Err(MeshError::Unknown { name, ending }),
        };
        let bytes = std::fs::read(path)
            .map_err(|error| MeshError::Unreadable { name: name.clone(), error })?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut mesh = read(&name, folder, &bytes)?;
        // Normals are made where the file has none, for which the rest must be whole.
        let faulty = |fault| MeshError::Faulty { name: name.clone(), fault };
        mesh.check().map_err(faulty)?;
        mesh.complete_normals();
        Ok(mesh)
    }

    /// Brings normals to length 1, and makes those that are missing (zeros).
    fn complete_normals(&mut self) {
        let unit = |normal: &[f32; 3]| glam::Vec3::from(*normal).try_normalize();
        if self.normals.iter().all(|normal| unit(normal).is_some()) {
            self.normals.iter_mut().for_each(|normal| {
                *normal = glam::Vec3::from(*normal).normalize().into();
            });
            return;
        }
        let made = self.vertex_normals();
        for (normal, made) in self.normals.iter_mut().zip(made) {
            *normal = unit(normal).map_or(made, Into::into);
        }
    }
}
