//! Of pen.
