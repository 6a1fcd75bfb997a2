//! What the tests of this folder share.

pub mod adapter;
pub mod golden;
pub mod near;
pub mod program;

pub mod oils;
pub mod watercolors;
