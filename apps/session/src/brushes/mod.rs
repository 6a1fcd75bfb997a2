//! Brushes as a painter keeps them: how a pen leads each of them, and sets of own brushes in files.
//!
//! Everything here is data and pure functions; only [`folder`] reads and writes files.
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
