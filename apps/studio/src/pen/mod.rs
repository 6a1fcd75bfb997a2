//! Input from styluses, mice and fingers.
//!
//! [`Pen`] collects the reports of all devices once a frame and returns strokes and hover
//! events as [`PenEvent`]s.

mod report;
mod transform;
mod settings;
mod pointer;

#[cfg(target_os = "linux")]
mod x11;

mod stabiliser;
mod aids;
mod pen_stroke;

#[cfg(any(target_os = "linux", windows))]
mod systems;
mod web;
mod input;

#[cfg(test)]
mod tests;

pub use aids::{
    AidHandle, AidLines, DrawingAids, Guide, GuideKind, Perspective, Ruler, RulerShape, Symmetry,
    SymmetryKind, Twin,
};
pub use input::{Pen, PenEvent, TestField, TestPoint};
pub use report::{Device, PointerState, Report, ReportKind, Script};
pub use settings::{Grip, PenSettings};
pub use transform::{PenTargets, SurfaceTransform};
pub use web::{PagePens, PagePhase, PagePointer};
