//! Which sets of pigments explain one pixel, and in which shares.

pub(crate) mod nearest;
pub(crate) mod set_fit;
pub(crate) mod scores;
mod quadratic;
mod triples;
pub(crate) mod table;
pub(crate) mod engine;
