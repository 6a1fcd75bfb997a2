//! Colour and optics: properties that hold for any values, and values of colour-science.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod optics;
mod properties;
mod science;
mod sets;
