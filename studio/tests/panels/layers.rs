//! Of layers.
