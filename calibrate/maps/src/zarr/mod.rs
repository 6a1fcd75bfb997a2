//! Arrays of Zarr, format 3: the part of it that scans and maps need.

mod fault;
mod chain;
mod shard;
mod metadata;
mod array;
mod document;

pub(crate) use array::{ChunkError, ZarrArray};
pub(crate) use chain::packed;
pub(crate) use document::{ArrayDocument, group_document};
pub(crate) use fault::ZarrFault;
pub(crate) use shard::ShardBuilder;
