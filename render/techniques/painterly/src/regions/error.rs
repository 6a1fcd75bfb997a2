//! Faults of regions.

use documents::hint::Explain;
use documents::text::TextError;
use graphics::picture::PhotographError;

/// Regions cannot be read, or do not fit the subject.
#[derive(Debug, thiserror::Error, Explain)]
pub enum RegionsError {
    /// The text cannot be read.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The picture of labels cannot be read.
    #[error(transparent)]
    Labels(#[from] PhotographError),
    /// A region has a fault.
    #[hint("{hint}")]
    #[error("{file}, region `{region}`: {fault}")]
    Region {
        /// Name of the file.
        file: String,
        /// Name of the region.
        region: String,
        /// The fault.
        fault: String,
        /// The way out.
        hint: String,
    },
}

impl RegionsError {
    pub(super) fn region(file: &str, region: &str, fault: String, hint: &str) -> Self {
        let file = file.to_owned();
        let region = region.to_owned();
        Self::Region { file, region, fault, hint: hint.to_owned() }
    }
}
