//! Models and pictures painted in the brushwork of art maps.
//!
//! After Yan, Chi, Lee and Lin, "Stylized rendering using samples of a painted image" (IEEE TVCG
//! 2008). A model is covered with splats that run along its curvature; each shows a part of the
//! map ([`artmap::map::ArtMap`]), in the tone that the light asks for. A picture is a plane, or a
//! relief, whose strokes run along the edges of the picture and have its tones.
//!
//! ```text
//! maps -> tones ---------------------------------------+
//! mesh or picture -> subject -> places -> roots -------+-> strokes of a sight -> three passes
//!                                         (offsets)    |   for each layer, one over the other
//! camera, light, time ---------------------------------+
//! ```
//!
//! The passes of surface splatting: the nearest splat (`depths`), weighted sums (`gather`), and
//! division by the weights (`divided`). They work square by square from lists of splats, so a
//! picture has the same bits on any number of threads. On a graphics device one kernel does all three
//! (`passes_on_device`) and agrees to rounding.

mod settings;
pub mod guides;
mod splat;
mod flow;
mod regions;

#[cfg(test)]
mod made_up;

#[cfg(test)]
mod test_device;
mod coloring;
mod tones;
mod joined_paint;
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
mod device_tones;
mod passes_on_device;
mod amounts;
mod passes;
mod paint_layer;
mod color_paint;
mod error;
mod brushwork;
mod composed;
mod built_ground;
mod subject;
mod painter;
mod painting;
mod stages;
mod compositing;
mod model;
mod picture_form;
mod picture_layers;
mod picture;
mod kernels;

pub use brushwork::Brushwork;
pub use color_paint::{ColorPaint, ColorPaintError, ColorPaintSettings, FilmHeight};
pub use compositing::CompositingError;
pub use error::PainterError;
pub use joined_paint::PaintOfMapsError;
pub use kernels::kernels;
pub use paint_layer::paint_layer;
pub use paint_tones::Amounts;
pub use painter::Painter;
pub use passes::PaintedPicture;
pub use picture_form::{FlowPicture, PictureForm};
pub use regions::{Region, RegionArea, Regions, RegionsError};
pub use settings::{
    ColorSettings, ColorSource, ColorSpace, FlowSettings, LayerSettings, LightSettings, LightWith,
    Offsets, OverlapSettings, PictureSettings, Preset, Settings, SettingsError, SilhouetteSettings,
    StrokeDirection, StrokeSettings, ToneSource, Zoom,
};
pub use splat::StrokeSplat;
pub use stages::Stage;

#[cfg(test)]
mod exact_tests;
