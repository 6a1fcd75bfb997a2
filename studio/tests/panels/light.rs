//! Of light.
