//! Models and pictures painted in the brushwork of art maps.
//!
//! After Yan, Chi, Lee and Lin, "Stylized rendering using samples of a painted image" (IEEE TVCG
//! 2008). A model is covered with splats that run along its curvature. Each splat shows a part of
//! the map ([`artmap::map::ArtMap`]), in the tone that the light asks for. A picture is a plane or
//! a relief. Its strokes run along the edges of the picture and have its tones.
//!
//! ```text
//! maps -> tones ---------------------------------------+
//! mesh or picture -> subject -> places -> roots -------+-> strokes of a view -> three passes
//!                                         (offsets)    |   for each layer, one over the other
//! camera, light, time ---------------------------------+
//! ```
//!
//! The passes of surface splatting: the nearest splat (`splats`), weighted sums and division by the
//! weights (`gather`). They work square by square from lists of splats, so a picture has the same
//! bits on any number of threads. On a graphics device one kernel does all three (`passes`) and
//! agrees to rounding.

mod settings;
pub mod guides;
mod splats;
mod regions;

#[cfg(test)]
mod test_scenes;

mod coloring;
mod tones;
mod paint_tones;
mod places;
mod roots;
mod strokes;
mod gather;
mod passes;
mod color_paint;
mod painter;
mod painting;
mod model;
mod picture;
mod subject;

use graphics::gpu::Kernel;

use passes::PASSES;

pub use color_paint::{ColorPaint, ColorPaintError, ColorPaintSettings, FilmHeight};
pub use paint::technique::Stage;
pub use paint_tones::{Amounts, PaintOfMapsError, paint_layer};
pub use painter::{Brushwork, Painter, PainterError};
pub use painting::CompositingError;
pub use passes::PaintedPicture;
pub use picture::{FlowPicture, PictureForm};
pub use regions::{Region, RegionArea, Regions, RegionsError};
pub use settings::{
    ColorSettings, ColorSource, ColorSpace, FlowSettings, LayerSettings, LightSettings, LightWith,
    Offsets, OverlapSettings, PictureSettings, Preset, Settings, SettingsError, SilhouetteSettings,
    StrokeDirection, StrokeSettings, ToneSource, Zoom,
};
pub use splats::StrokeSplat;
pub use subject::{Form, Subject, View};

/// Every compute kernel of models in brushwork.
#[must_use]
pub fn kernels() -> Vec<&'static Kernel> {
    vec![&PASSES]
}
