//! From photographs to pigments, and to strokes.
