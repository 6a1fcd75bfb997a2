//! Size, kind and time of files and folders.

use std::io;
use std::path::Path;

use web_time::SystemTime;

use super::tree::{Node, tree};

/// Size, kind and time of what lies at a path.
#[derive(Debug, Clone)]
pub struct Metadata {
    /// Number of bytes; none of a folder.
    bytes: Option<u64>,
    modified: SystemTime,
}

#[allow(clippy::len_without_is_empty, reason = "the calls of std::fs::Metadata")]
impl Metadata {
    /// Whether it is a file.
    #[must_use]
    pub fn is_file(&self) -> bool {
        self.bytes.is_some()
    }

    /// Whether it is a folder.
    #[must_use]
    pub fn is_dir(&self) -> bool {
        self.bytes.is_none()
    }

    /// Number of bytes; 0 of a folder.
    #[must_use]
    pub fn len(&self) -> u64 {
        self.bytes.unwrap_or(0)
    }

    /// Time of the last change.
    ///
    /// # Errors
    /// None.
    pub fn modified(&self) -> io::Result<SystemTime> {
        Ok(self.modified)
    }
}

/// Size, kind and time of the file or folder at `path`.
///
/// # Errors
/// If nothing lies there.
pub fn metadata(path: impl AsRef<Path>) -> io::Result<Metadata> {
    let tree = tree();
    let (node, modified) = tree.find(path.as_ref())?;
    let bytes = match node {
        Node::File(bytes) => Some(bytes.len() as u64),
        Node::Folder => None,
    };
    Ok(Metadata { bytes, modified })
}
