//! The light: illuminant, direction, gloss, split view.
