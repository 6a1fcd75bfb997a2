//! Faults of stored arrays, without the path, which the caller adds.

/// A fault and the way out of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ZarrFault {
    pub(crate) problem: String,
    pub(crate) way_out: &'static str,
}

/// Advice for arrays of a kind that is not read. Without `drop_encoding` xarray would pack the copy as the original.
const SAVE_AGAIN: &str =
    "copy it in Python: xarray.open_zarr(\"OLD\").drop_encoding().to_zarr(\"NEW\", zarr_format=3)";
/// Advice for arrays that are damaged.
const COPY_AGAIN: &str = "copy or write the array again";

impl ZarrFault {
    /// A kind of array that is not read.
    pub(crate) fn unread(problem: impl Into<String>) -> Self {
        Self { problem: problem.into(), way_out: SAVE_AGAIN }
    }

    /// Damage to stored bytes.
    pub(crate) fn damaged(problem: impl Into<String>) -> Self {
        Self { problem: problem.into(), way_out: COPY_AGAIN }
    }
}
