//! Maps on the disk: a Zarr group that xarray opens, written shard by shard.
//!
//! A shard is written whole. One whose mask exists is finished, because the mask is written last; so
//! a run that was ended at any moment can be resumed, and several processes can write one store.

mod tiles;
mod error;
mod arrays;
mod create;
mod shard_writer;
mod stored;

pub use crate::maps_about::MapsAbout;
pub(crate) use create::{GROUP, entries, names, text, write};
pub use create::{MapStore, StoreMode};
pub use error::StoreError;
pub use shard_writer::ShardWriter;
pub use stored::StoredMaps;
pub use tiles::Shard;
