//! Recorded strokes: the format strokes/1.
