//! Which sets of pigments explain one pixel, and in which shares.

pub(crate) mod nearest;

pub(crate) mod set_fit;

mod quadratic;

pub(crate) mod table;

pub(crate) mod engine;
