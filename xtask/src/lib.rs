//! The files of this repository and what we count in them. The program `xtask` prints the figures,
//! the house test (`tests/house`) holds them to their limits.

pub mod files;
pub mod figures;
pub mod versions;
pub mod rules;
