//! Of brushes.
