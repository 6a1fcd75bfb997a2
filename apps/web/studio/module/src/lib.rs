//! The module of the studio's page: all of the crate beside it.
//!
//! The optimisation level of this last crate decides whether the linker makes vectors of loops, so it is
//! compiled for speed. The page's own code is in the crate beside it, which is compiled for size.

pub use page::Page;
