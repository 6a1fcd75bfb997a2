//! What the tests of this folder share.

pub mod golden;
pub mod near;
pub mod oils;
pub mod program;
pub mod watercolors;
