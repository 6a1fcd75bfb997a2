//! The settings of painterly rendering, and their TOML files.

mod figures;
mod strokes;
mod layers;
mod look;
mod picture;
mod whole;
mod preset;
mod file;
mod change;

pub use file::SettingsError;
pub use layers::LayerSettings;
pub use look::{
    ColorSettings, ColorSource, ColorSpace, FlowSettings, LightSettings, LightWith,
    SilhouetteSettings, ToneSource,
};
pub use picture::PictureSettings;
pub use preset::Preset;
pub use strokes::{Offsets, OverlapSettings, StrokeDirection, StrokeSettings, Zoom};
pub use whole::Settings;
