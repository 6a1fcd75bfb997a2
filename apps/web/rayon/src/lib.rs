//! Stands in for the crate `rayon` in a page, which has one thread.
//!
//! Items are handled one after the other, in order, by the iterators of the standard library: the
//! crate's own splits, queues and threads would be a part of every download and do nothing. In scope is
//! what the crates of the pages call; the compiler tells what else they come to need.

mod iterator;
mod sources;
mod threads;

/// The traits that a user imports together.
pub mod prelude {
    pub use crate::iterator::{IndexedParallelIterator, ParallelIterator};
    pub use crate::sources::{
        IntoParallelIterator, IntoParallelRefIterator, IntoParallelRefMutIterator, ParallelExtend,
        ParallelSlice, ParallelSliceMut,
    };
}

pub use threads::{Scope, current_num_threads, in_place_scope, join, scope};
