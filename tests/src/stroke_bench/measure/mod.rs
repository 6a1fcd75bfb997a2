//! Pure measures of heights in mm.

pub mod series;
pub mod waves;
pub mod mark;
pub mod outline;
pub mod surface;
