//! Samples painted by the engine: swatches of one hue in the strokes of a style.
//!
//! ```
//! use artmap::painted::{PaintedSettings, Style, painted_samples};
//!
//! let mut style = Style::named("dabs")?;
//! style.canvas.side_cells = 32;
//! let settings = PaintedSettings { tones: 2, ..PaintedSettings::default() };
//! let set = painted_samples(&style, &settings)?;
//! assert_eq!(set.samples[0].size(), (32, 32));
//! assert_eq!(set.samples[0].name, "tone 1");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
mod plan;
mod tones;
mod swatch;
mod set;

pub use plan::{
    BrushPlan, CanvasPlan, Layout, PaintPlan, StrokePlan, Style, StyleError, StylePreset,
    ToneSource,
};
pub use set::{PaintedError, PaintedSettings, SwatchPainter, painted_samples};
pub use swatch::{SwatchStroke, strokes};
pub use tones::{TONES, Tone, ToneLadder, TonesError};
