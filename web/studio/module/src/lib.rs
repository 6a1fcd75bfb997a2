//! The module of the studio's page: all of the crate beside it.
//!
//! The last crate of a module decides how hard the linker optimises, and this one asks for speed; a crate
//! with code of its own would have all of that code optimised for speed too, at three times its size.

pub use page::Page;
