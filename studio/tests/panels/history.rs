//! Of history.
