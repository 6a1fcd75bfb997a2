//! Of tubes.
