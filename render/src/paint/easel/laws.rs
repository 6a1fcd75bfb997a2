//! Laws of an easel.
