//! All that can be set of watercolor, as a file tells it.

mod effects;

mod figures;

mod subject;

mod whole;

mod file;

mod preset;

mod change;

pub use effects::{
    DispersionSettings, DryBrushSettings, EdgeSettings, FlowSettings, PaperSettings, WashSettings,
    WobbleSettings,
};
pub use file::SettingsError;
pub use preset::Preset;
pub use subject::{AbstractionSettings, CoherenceMethod, CoherenceSettings, ToonSettings};
pub use whole::Settings;
