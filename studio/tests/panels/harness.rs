//! Of harness.
