//! Light on paint: colour laws, and eight wavelengths against the full spectrum.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod color;

mod grounds;

mod made_up;

mod surface;
