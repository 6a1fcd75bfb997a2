//! Regions of a subject that are painted in another way than the rest.

mod region;
mod error;
mod file;
mod area;

pub(super) use area::{RegionMap, Style};
pub use error::RegionsError;
pub use region::{Region, RegionArea, Regions};
