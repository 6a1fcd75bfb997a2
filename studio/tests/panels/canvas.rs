//! Of canvas.
