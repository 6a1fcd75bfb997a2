//! Tests of strokes.
