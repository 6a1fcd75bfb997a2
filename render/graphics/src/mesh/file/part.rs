//! Parts of a model as files store them, which we put together to one mesh near the origin. Also
//! texture images, and errors of reading models.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use documents::file::{FileError, NamedFileError};
use documents::hint::Explain;
use image::ImageReader;

use crate::mesh::model::{LEAST_SIZE, MOST_SIZE, Material, Mesh, MeshFault, Texture, Triangle};
use crate::picture_formats::{NAMES, small_picture};

/// A part of a model as a file stores it.
#[derive(Debug, Default)]
pub(super) struct Part {
    /// Positions in 64-bit numbers, since we subtract the place of the model before we round them.
    pub(super) positions: Vec<[f64; 3]>,
    /// Greatest distance of two neighbouring numbers near the positions, as the file stores them.
    pub(super) step: f64,
    /// One per position or empty. This also holds for the next two lists.
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) texture_coordinates: Vec<[f32; 2]>,
    pub(super) colors: Vec<[f32; 3]>,
    pub(super) corners: Vec<u32>,
    pub(super) material: u32,
}

/// The parts of a model that were read so far.
#[derive(Debug, Default)]
pub(super) struct Parts {
    /// The mesh, still without its positions.
    pub(super) mesh: Mesh,
    positions: Vec<[f64; 3]>,
    step: f64,
}

/// A model that was read: the mesh, the place of its origin in the file, and the files that the
/// model names.
pub(super) type Read = (Mesh, [f64; 3], Vec<PathBuf>);

/// Greatest numbers of vertices and triangles that we read. These take about 1 GB of memory.
const MOST_VERTICES: usize = 1 << 24;
const MOST_TRIANGLES: usize = 1 << 25;

/// A model is moved along an axis if it is farther away there than this many of its widths. Nearer
/// models lose at most four bits of their positions, and we leave them where they are.
const FAR: f64 = 16.0;

/// Fewer steps than this across a model make its surface visibly uneven.
const LEAST_STEPS: f64 = 256.0;

/// Light grey, for a model without materials and vertex colours.
pub(super) const PLAIN: Material =
    Material { name: String::new(), color: [0.8, 0.8, 0.8], texture: None };

/// White, for a model without materials but with vertex colours. This shows the vertex colours
/// unchanged.
pub(super) const PAINTED: Material =
    Material { name: String::new(), color: [1.0; 3], texture: None };

impl Parts {
    /// Checks that there is room for further vertices and triangles. Call this before you make
    /// lists of them.
    pub(super) fn check_room(&self, vertices: usize, triangles: usize) -> Result<(), MeshFault> {
        for (what, found, more, most) in [
            ("vertices", self.positions.len(), vertices, MOST_VERTICES),
            ("triangles", self.mesh.triangles.len(), triangles, MOST_TRIANGLES),
        ] {
            let found = found.saturating_add(more);
            if found > most {
                return Err(MeshFault::TooMany { what, found, most });
            }
        }
        Ok(())
    }

    /// Adds a part, and fills in its missing attributes. Missing normals become zeros, and we
    /// compute them later.
    pub(super) fn add(&mut self, part: Part) -> Result<(), MeshFault> {
        self.check_room(part.positions.len(), part.corners.len() / 3)?;
        let mesh = &mut self.mesh;
        let first = self.positions.len() as u32;
        let count = first as usize + part.positions.len();
        self.positions.extend(part.positions);
        self.step = self.step.max(part.step);
        mesh.normals.extend(part.normals);
        mesh.normals.resize(count, [0.0; 3]);
        mesh.texture_coordinates.extend(part.texture_coordinates);
        mesh.texture_coordinates.resize(count, [0.0; 2]);
        mesh.colors.extend(part.colors);
        mesh.colors.resize(count, [1.0; 3]);
        let material = part.material;
        mesh.triangles.extend(part.corners.chunks_exact(3).map(|corners| Triangle {
            // An index out of range must stay out of range for the check.
            corners: [0, 1, 2].map(|i| first.saturating_add(corners[i])),
            material,
        }));
        Ok(())
    }

    /// The mesh, and the place in the file of the mesh's origin. This place is 0 unless the model
    /// lies far away: then we move the model, so that its positions keep their digits in 32 bits.
    pub(super) fn finish(self) -> Result<(Mesh, [f64; 3]), MeshFault> {
        let Self { mut mesh, positions, step } = self;
        if mesh.triangles.is_empty() {
            return Err(MeshFault::NoTriangle);
        }
        if let Some(vertex) = positions.iter().position(|at| !at.iter().all(|x| x.is_finite())) {
            let found = positions[vertex].map(|value| value as f32).to_vec();
            return Err(MeshFault::NotFinite { vertex, what: "position", found });
        }
        let origin = origin(&positions, step)?;
        mesh.positions = positions
            .into_iter()
            .map(|at| [0, 1, 2].map(|axis| (at[axis] - origin[axis]) as f32))
            .collect();
        mesh.check()?;
        mesh.check_area()?;
        Ok((mesh, origin))
    }
}

/// The place that becomes the origin. `step` is the distance of two neighbouring numbers of the
/// file there.
fn origin(positions: &[[f64; 3]], step: f64) -> Result<[f64; 3], MeshFault> {
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for at in positions {
        for axis in 0..3 {
            low[axis] = low[axis].min(at[axis]);
            high[axis] = high[axis].max(at[axis]);
        }
    }
    let center = [0, 1, 2].map(|axis| low[axis] / 2.0 + high[axis] / 2.0);
    let size = [0, 1, 2].map(|axis| high[axis] - low[axis]).into_iter().fold(0.0, f64::max);
    let away = center.map(f64::abs).into_iter().fold(0.0, f64::max);
    let step = step.max(away * f64::EPSILON);
    // Also a single point, if it only seems to be one because of rounding.
    if away > 0.0 && size < step * LEAST_STEPS && (size > 0.0 || step > LEAST_SIZE) {
        return Err(MeshFault::TooFar { size, away, step });
    }
    if size == 0.0 {
        return Err(MeshFault::OnePoint { vertices: positions.len() });
    }
    if !(LEAST_SIZE..=MOST_SIZE).contains(&size) {
        return Err(MeshFault::Size { size });
    }
    // With a power of two as unit, the subtraction is exact, and a model that is moved by a whole
    // number of units becomes the same mesh.
    let unit = 2f64.powi(size.log2().ceil() as i32);
    Ok(center.map(|value| match value.abs() > FAR * size {
        true => (value / unit).floor() * unit,
        false => 0.0,
    }))
}

/// Greatest number of texels of all textures of a model. These take 1 GB of memory.
const MOST_TEXELS: u64 = 1 << 28;

/// Decodes the textures of one model, up to a common limit.
#[derive(Debug, Default)]
pub(super) struct Textures {
    texels: u64,
}

impl Textures {
    /// Decodes a texture. If it cannot, the error is the reason.
    pub(super) fn decode(&mut self, bytes: &[u8]) -> Result<Texture, String> {
        let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format();
        let size = reader.map_err(|e| e.to_string())?.into_dimensions();
        let (width, height) = size.map_err(|error| error.to_string())?;
        let texels = self.texels.saturating_add(u64::from(width) * u64::from(height));
        if texels > MOST_TEXELS {
            return Err(format!(
                "{width} x {height} texels are too many: the textures of a model have at most \
                 {MOST_TEXELS} together"
            ));
        }
        self.texels = texels;
        Texture::from_bytes(bytes)
    }
}

impl Texture {
    /// Decodes a PNG, JPEG, TIFF or WebP image. If it cannot, the error is the decoder's reason.
    fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let picture = small_picture(bytes)?.into_rgba8();
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
    /// A file that the model names cannot be read, or must not be named.
    #[error(transparent)]
    Named(#[from] NamedFileError),
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

impl MeshError {
    /// The content of the model at `path` violates its format at `place`.
    pub(super) fn malformed(
        path: &Path,
        place: impl Into<String>,
        reason: impl Into<String>,
    ) -> Self {
        Self::Malformed {
            name: path.display().to_string(),
            place: place.into(),
            reason: reason.into(),
        }
    }

    /// The model at `path` was read, but its mesh has this fault.
    pub(super) fn faulty(path: &Path, fault: MeshFault) -> Self {
        Self::Faulty(path.display().to_string(), fault)
    }
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
