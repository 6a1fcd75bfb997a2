//! Input from styluses, mice and fingers.
//!
//! [`Pen`] collects the reports of all devices once a frame and returns strokes and hover
//! events as [`PenEvent`]s.

mod report;
mod transform;
mod settings;

#[cfg(not(target_arch = "wasm32"))]
mod clock;
mod speed;
mod stamps;
mod taps;
mod pointer;

#[cfg(target_os = "linux")]
mod valuator;

#[cfg(target_os = "linux")]
mod x11;

#[cfg(target_os = "linux")]
mod wayland;

#[cfg(not(target_arch = "wasm32"))]
mod tablet;
mod handling;
mod heading;
mod stabiliser;
mod aids;
mod pen_stroke;

#[cfg(not(target_arch = "wasm32"))]
mod systems;
mod web;
mod input;
mod test_field;
mod script;

#[cfg(test)]
mod tests;

#[cfg(test)]
mod stabiliser_tests;

#[cfg(test)]
mod guide_tests;

pub use aids::{
    AidHandle, AidLines, DrawingAids, Guide, GuideKind, Perspective, Ruler, RulerShape, Symmetry,
    SymmetryKind, Twin,
};
pub use input::{Pen, PenEvent};
pub use report::{Device, PointerState, Report, ReportKind};
pub use script::Script;
pub use settings::{Grip, PenSettings};
pub use test_field::{TestField, TestPoint};
pub use transform::{PenTargets, SurfaceTransform};
pub use web::{PagePens, PagePhase, PagePointer};
