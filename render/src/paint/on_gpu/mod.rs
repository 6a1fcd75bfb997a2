//! Painting on a graphics device.
