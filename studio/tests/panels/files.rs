//! Of files.
