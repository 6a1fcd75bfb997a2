//! Watercolor from photographs and meshes.
//!
//! After Bousseau, Kaplan, Thollot and Sillion, "Interactive watercolor rendering
//! with temporal coherence and abstraction" (NPAR 2006). Two doors, photograph and
//! mesh, lead to one room, the [`Wash`]; effects then do the same to both.
//!
//! Colours are encoded sRGB in 0..1, as the paper has them: a change of density is
//! then about even to the eye.

mod settings;

mod wash;

mod segmentation;

mod octagon;

mod morphology;

mod photograph_door;

mod toon;

mod textures;

mod density;

mod edges;

mod wobble;

mod color_mask;

mod dry_brush;

mod sheet;

mod pipeline;

mod model_painter;

mod glaze;

mod kernels;

pub use color_mask::{ColorMask, ColorRange};
pub use density::{Density, DensityLayer};
pub use dry_brush::{DryBrush, DryBrushReach};
pub use edges::Edges;
pub use glaze::{GlazeError, Glazes, thickness};
pub use graphics::coherence;
pub use graphics::image::{Backend, CpuModel, GpuModel, Models, OnCpu, OnGpu, Plane};
pub use graphics::tones::{ToneRamp, ToneRampError};
pub use kernels::kernels;
pub use model_painter::{ModelPainter, ModelPainterError, Moment, MovingBackend};
pub use morphology::Morphology;
pub use octagon::{Brush, Extreme};
pub use photograph_door::{
    AbstractedPhotograph, PhotographDoorError, PhotographSettings, from_photograph,
};
pub use pipeline::{Stage, WashOn, Watcher, Watercolor, paint};
pub use segmentation::{Segmentation, SegmentationError, SegmentationSettings, segment};
pub use settings::{
    AbstractionSettings, CoherenceMethod, CoherenceSettings, DispersionSettings, DryBrushSettings,
    EdgeSettings, FlowSettings, PaperSettings, Preset, Settings, SettingsError, ToonSettings,
    WashSettings, WobbleSettings,
};
pub use sheet::{OnSheet, Sheet};
pub use textures::{
    PaperOn, PaperTexture, PaperTextureError, Textures, TexturesOn, dispersion, turbulent_flow,
};
pub use toon::{Light, Shading, Toon};
pub use wash::{Controls, Wash};
pub use wobble::Wobble;
