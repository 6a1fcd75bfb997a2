//! From pens, mice and fingers to samples.
//!
//! [`Pen`] hears every source, once a frame, and tells strokes: [`PenEvent`].

mod report;

mod sight;

mod settings;

mod clock;

mod speed;

mod pointer;

#[cfg(target_os = "linux")]
mod valuator;

#[cfg(target_os = "linux")]
mod x11;

#[cfg(target_os = "linux")]
mod wayland;

mod tablet;

mod stroke;

mod systems;

mod hand;

mod script;

#[cfg(test)]
mod trials;

pub use hand::{Pen, PenEvent};
pub use report::{Device, Hold, Report, What};
pub use script::Script;
pub use settings::{Grip, PenSettings};
pub use sight::{Sight, View};
