//! Errors in writing and reading maps.

use std::path::PathBuf;

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};

use super::tiles::Shard;

/// Maps that cannot be written or read.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The operating system cannot read or write a file of the description.
    #[error(transparent)]
    File(#[from] FileError),
    /// A shard cannot be written. Shards written before are whole.
    #[error("{}: the shard of {shard} cannot be written", path.display())]
    Shard {
        /// Path of the store.
        path: PathBuf,
        /// The shard that was to be written.
        shard: Shard,
        /// The file and the error of the operating system.
        source: FileError,
    },
    /// The output exists and is not asked to be resumed.
    #[error("{}: exists already and {holds}", path.display())]
    Exists {
        /// Path of the store.
        path: PathBuf,
        /// Content of the folder with its verb, such as `holds maps`.
        holds: String,
        /// Whether it can be resumed.
        is_maps: bool,
    },
    /// The output belongs to a run of other settings.
    #[error("{}: holds maps of another run: `{key}` is {found}, now {expected}", path.display())]
    OtherRun {
        /// Path of the store.
        path: PathBuf,
        /// Name of the first attribute or array that differs.
        key: String,
        /// Value of the store.
        found: String,
        /// Value of this run.
        expected: String,
    },
    /// Maps do not fit into the store.
    #[error("{}: {problem}", path.display())]
    Maps {
        /// Path of the store.
        path: PathBuf,
        /// The numbers that disagree.
        problem: String,
    },
    /// Shards are missing.
    #[error("{}: {missing} of {shards} shards are not written yet", path.display())]
    Unfinished {
        /// Path of the store.
        path: PathBuf,
        /// Number of shards that are missing.
        missing: usize,
        /// Number of all shards.
        shards: usize,
    },
    /// The store is damaged or no store of maps.
    #[error("{}: {problem}", path.display())]
    Damaged {
        /// Path of the file.
        path: PathBuf,
        /// The fault that was found.
        problem: String,
    },
}

impl Explain for StoreError {
    fn hint(&self) -> Option<Hint> {
        match self {
            Self::File(error) => error.hint(),
            Self::Shard { source, .. } => match source.reason.kind() {
                std::io::ErrorKind::StorageFull => {
                    Some(Hint::new("free space on the disk, then go on with [resume]"))
                }
                _ => source.hint().or_else(|| Some(Hint::new("go on with [resume] afterwards"))),
            },
            Self::Unfinished { .. } => Some(Hint::new("go on with [resume]")),
            Self::Exists { is_maps: true, .. } => {
                Some(Hint::new("go on with [resume], or name another folder with [out]"))
            }
            Self::Exists { .. } => Some(Hint::new("name another folder with [out]")),
            Self::OtherRun { .. } => Some(Hint::new(
                "name another folder with [out], or map with the scan, library and settings of that run",
            )),
            Self::Maps { .. } => None,
            Self::Damaged { .. } => Some(Hint::new("map the scan again into another folder")),
        }
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            Self::Shard { .. } => Fault::Environment,
            Self::Exists { .. } | Self::OtherRun { .. } => Fault::Setting,
            Self::Maps { .. } | Self::Unfinished { .. } | Self::Damaged { .. } => Fault::Input,
        }
    }
}
