//! Brushes as a painter saves them: how the pen controls each brush, and files with sets of
//! brushes.
//!
//! Only [`folder`] reads and writes files. Everything else here is data and pure functions.
mod reading;
mod points;
mod options;
mod set;
pub mod folder;
mod myb;

#[cfg(test)]
mod myb_tests;

pub use myb::{ImportedBrush, MM_PER_PIXEL, brush_of_myb};
pub use options::{
    BrushOptions, LengthUnit, StabiliserMethod, StabiliserSettings, TiltUse, TwistUse,
};
pub use points::{CurvePoints, InvalidCurve, PressureCurve};
pub use reading::BrushFileError;
pub use set::{BrushPreset, BrushSet, PresetLoad};
