//! Colour and optics: laws that hold for any values, and values of colour-science.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod laws;
mod optics;
mod science;
