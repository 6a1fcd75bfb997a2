//! Tubes and the palette's pigments.
