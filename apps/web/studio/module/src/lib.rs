//! The module of the studio's page. It contains all of the crate beside it.
//!
//! The optimisation level of this last crate decides whether the linker vectorises loops, so we
//! compile it for speed. The page's own code is in the crate beside it, which we compile for size.

pub use page::Page;
