//! The settings of watercolor, and their TOML files.

mod figures;
mod effects;
mod photograph;
mod subject;
mod whole;
mod preset;
mod file;
mod change;

pub use effects::{
    DispersionSettings, DryBrushSettings, EdgeSettings, FlowSettings, PaperSettings, WashSettings,
    WobbleSettings,
};
pub use file::SettingsError;
pub use photograph::{BackRunSettings, MarginSettings, ToneSettings, WetSettings};
pub use preset::Preset;
pub use subject::{AbstractionSettings, CoherenceMethod, CoherenceSettings, ToonSettings};
pub use whole::Settings;
