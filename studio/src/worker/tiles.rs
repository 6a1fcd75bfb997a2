//! Changed tiles, ready for the screen.
