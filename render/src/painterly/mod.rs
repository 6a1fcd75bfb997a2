//! Models painted in the brushwork of an art map.
//!
//! After Yan, Chi, Lee and Lin, "Stylized rendering using samples of a painted image" (IEEE TVCG
//! 2008). A model is covered with splats that run along its curvature; each shows a part of the
//! map ([`artmap::map::ArtMap`]), in the tone that the light asks for.
//!
//! ```text
//! map -> tones -----------------------------------+
//! mesh -> places, directions -> roots (offsets) --+-> strokes of a sight -> three passes -> picture
//! camera, light, time ----------------------------+
//! ```
//!
//! The passes of surface splatting: the nearest splat (`depths`), weighted sums (`gather`), and
//! division by the weights (`divided`). They work square by square from lists of splats, so a
//! picture has the same bits on any number of threads.

mod settings;

pub mod guides;

mod error;

mod splat;

mod flow;

#[cfg(test)]
mod made_up;

mod coloring;

mod tones;

mod paint_tones;

mod places;

mod grid;

mod roots;

mod offsets;

mod strokes;

mod silhouette;

mod lists;

mod square;

mod depths;

mod gather;

mod divided;

mod amounts;

mod passes;

mod model_painter;

pub use error::ModelPainterError;
pub use model_painter::ModelPainter;
pub use passes::PaintedModel;
pub use settings::{
    ColorSettings, ColorSource, ColorSpace, FlowSettings, LightSettings, LightWith, Offsets,
    OverlapSettings, Preset, Settings, SettingsError, SilhouetteSettings, StrokeDirection,
    StrokeSettings, Zoom,
};
pub use splat::StrokeSplat;
