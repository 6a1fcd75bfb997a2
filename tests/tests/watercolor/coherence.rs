//! Noise that stays on its object.
