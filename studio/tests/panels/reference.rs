//! Of reference.
