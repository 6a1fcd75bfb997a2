//! Stands in for the crate `rayon` in a page, which has one thread.
//!
//! Iterators of the standard library handle the items in order. The queues and threads of the real
//! crate would only make every download larger. This crate has what the crates of the pages call.
//! If you call something else, the compiler says that it is missing.

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
