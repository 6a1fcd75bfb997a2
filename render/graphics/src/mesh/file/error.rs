//! Errors of reading models.

use documents::hint::{Explain, Fault, Hint};

use crate::mesh::check::MeshFault;
use crate::picture_formats::NAMES;

/// A model could not be read. Every message starts with the file's path.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file cannot be opened or read.
    #[error("{name}: {error}")]
    Unreadable {
        /// Path of the file.
        name: String,
        /// Reason given by the system.
        #[source]
        error: std::io::Error,
    },
    /// The file extension is not one of a supported format.
    #[error("{name}: no file extension of a model: `{extension}`")]
    UnknownFormat {
        /// Path of the file.
        name: String,
        /// The extension, lower case; empty if there is none.
        extension: String,
    },
    /// The content violates the file's format.
    #[error("{name}: {place}: {reason}")]
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
    Texture {
        /// Path of the model.
        name: String,
        /// Path of the image as the model gives it.
        texture: String,
        /// Reason why it cannot be read.
        reason: String,
    },
    /// The file was read, but its mesh fails [`Mesh::check`](crate::mesh::Mesh::check).
    #[error("{name}: {fault}")]
    Faulty {
        /// Path of the file.
        name: String,
        /// The defect found.
        #[source]
        fault: MeshFault,
    },
}

impl Explain for MeshError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Unreadable { .. } => "check the path",
            Self::UnknownFormat { .. } => "models are read from .obj, .gltf, .glb and .ply files",
            Self::Malformed { .. } => "correct that place, or export the model again",
            Self::Texture { .. } => {
                return Some(Hint::new(format!(
                    "put the picture ({NAMES}) where the model names it, or export the model \
                     with its pictures"
                )));
            }
            Self::Faulty { fault, .. } => return fault.hint(),
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Unreadable { .. } => Fault::Environment,
            _ => Fault::Input,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_not_there_is_no_fault_of_the_data() {
        let error = crate::mesh::Mesh::open("no/such/model.obj".as_ref()).unwrap_err();
        assert_eq!(error.fault(), Fault::Environment, "{error}");
        let name = "model.obj".to_owned();
        let place = "line 1".to_owned();
        let torn = MeshError::Malformed { name, place, reason: "torn".to_owned() };
        assert_eq!(torn.fault(), Fault::Input);
    }
}
