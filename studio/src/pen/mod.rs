//! From pens, mice and fingers to samples.
