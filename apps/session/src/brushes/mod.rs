//! Brushes as a painter keeps them: how a pen leads each of them, and sets of own brushes in files.
//!
//! Everything here is data and pure functions; only [`folder`] reads and writes files.

mod error;
mod reading;
mod points;
mod curve;
mod stabiliser;
mod options;
mod preset;
mod set;
pub mod folder;
mod myb_file;
mod myb;

#[cfg(test)]
mod myb_tests;

pub use curve::PressureCurve;
pub use error::BrushFileError;
pub use myb::{ImportedBrush, MM_PER_PIXEL, brush_of_myb};
pub use options::{BrushOptions, TiltUse, TwistUse};
pub use points::{CurvePoints, InvalidCurve};
pub use preset::{BrushPreset, PresetLoad};
pub use set::BrushSet;
pub use stabiliser::{LengthUnit, StabiliserMethod, StabiliserSettings};
