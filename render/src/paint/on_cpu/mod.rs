//! Painting on the processor.
