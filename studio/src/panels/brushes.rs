//! Brushes: shape, size, what is on them.
