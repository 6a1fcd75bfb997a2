//! Light on paint: colour from eight wavelengths, shading of relief and gloss, and grounds.

#![expect(clippy::unwrap_used, reason = "a test may panic")]
mod color;
mod made_up;
mod surface;
