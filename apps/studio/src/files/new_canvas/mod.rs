//! The canvas of a new painting as data: its format, its ground, and what is kept of it.

mod unit;
mod format;
mod tone;
mod settings;
mod kept;

pub(crate) use format::{FORMATS, Format};
pub use kept::{CanvasPreset, KeptCanvases};
pub use settings::NewCanvas;
pub(crate) use settings::{MAX_CELLS, SIDE_MM};
pub(crate) use tone::{TONES, Tone};
pub use unit::LengthUnit;
