//! Why a file is no model.

use crate::mesh::check::MeshFault;

/// Why a model could not be read; the file is named in each.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The system does not let us.
    #[error("{name}: {error}")]
    Unreadable {
        /// The path.
        name: String,
        /// Why not.
        #[source]
        error: std::io::Error,
    },
    /// A name that does not end in one of ours.
    #[error("{name}: not the name of a model: it ends in `{ending}`")]
    Unknown {
        /// The path.
        name: String,
        /// What follows the last dot; may be empty.
        ending: String,
    },
    /// What is in the file is not what its format wants.
    #[error("{name}: {place}: {reason}")]
    Malformed {
        /// The path.
        name: String,
        /// The line or element.
        place: String,
        /// What is wrong, with the offending text.
        reason: String,
    },
    /// A picture that the model wants.
    #[error("{name}: the texture `{texture}`: {reason}")]
    Texture {
        /// The path of the model.
        name: String,
        /// The picture, as the model names it.
        texture: String,
        /// Why it cannot be read.
        reason: String,
    },
    /// Read, but it cannot be drawn.
    #[error("{name}: {fault}")]
    Faulty {
        /// The path.
        name: String,
        /// Why not.
        #[source]
        fault: MeshFault,
    },
}

impl MeshError {
    /// What can be done.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Unreadable { .. } => "check the path",
            Self::Unknown { .. } => "models are read from .obj, .gltf, .glb and .ply files",
            Self::Malformed { .. } => "mend that place, or export the model again",
            Self::Texture { .. } => {
                "put the picture (PNG or JPEG) where the model names it, or export the model \
                 with its pictures"
            }
            Self::Faulty { fault, .. } => fault.hint(),
        }
    }
}
