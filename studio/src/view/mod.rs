//! The surfaces on the screen.
