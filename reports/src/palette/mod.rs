//! Sections on the palette of a library: mixtures, gamut, hiding power, tinting strength and
//! other lights. Their numbers come from `calibrate::palette`.

mod context;
mod cells;
mod patch;
mod bars;
mod card;
mod graded;
mod lights;
mod mixing;
mod gamut;
mod strength;

pub(crate) use gamut::section as gamut;
pub(crate) use graded::section as graded;
pub(crate) use lights::section as lights;
pub(crate) use mixing::section as mixing;
pub(crate) use strength::section as strength;
