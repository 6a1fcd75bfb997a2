//! Watercolor from photographs and meshes.
//!
//! This follows Bousseau, Kaplan, Thollot and Sillion, "Interactive watercolor rendering with
//! temporal coherence and abstraction" (NPAR 2006). A photograph is abstracted to flat regions
//! ([`PhotographPainter`]), a mesh is shaded in a few steps of light ([`ModelPainter`]). You then
//! pass the resulting [`Wash`] through the effects ([`paint()`]), or turn it into a painting of
//! calibrated pigments ([`GlazePainter`]). The style is a value, [`Settings`]. You can start from a
//! [`Preset`], for example `Preset::Landscape`.
//!
//! Colours are encoded sRGB in 0..1, as in the paper, so that equal changes of density look
//! about equal.

mod settings;
mod shadow_map;
mod toon;
mod textures;
mod effects;
mod photograph;
mod pipeline;
mod photograph_painter;
mod model_painter;
mod glaze;
mod subject;

pub use effects::{
    ColorRange, DensityLayer, DryBrushReach, PaperShading, apply_density, apply_dry_brush,
    color_mask, edges, shade_paper, wobble,
};
pub use glaze::{GlazeError, GlazePainter, Glazes};
pub use model_painter::{ModelPainter, ModelPainterError};
pub use photograph_painter::{
    AbstractedPhotograph, AbstractionError, PhotographPainter, PhotographPainterError,
    PreparedPhotograph, RegionSettings, abstract_photograph,
};
pub use pipeline::{
    Controls, FrameTextures, Masks, Stage, StageObserver, Wash, WashImages, kernels, paint,
};
pub use settings::{
    AbstractionSettings, BackRunSettings, CoherenceMethod, CoherenceSettings, DispersionSettings,
    DryBrushSettings, EdgeSettings, FlowSettings, MarginSettings, PaperSettings, Preset, Settings,
    SettingsError, ToneSettings, ToonSettings, WashSettings, WetSettings, WobbleSettings,
};
pub use shadow_map::ShadowMap;
pub use subject::{Form, Subject, WatercolorError, WatercolorPainter};
pub use textures::{
    BrushTouch, FineHeights, PaperImage, PaperTexture, PaperTextureError, Quantiles, TextureImages,
    Textures, back_runs, dispersion, turbulent_flow,
};
pub use toon::{Toon, shade_toon};
