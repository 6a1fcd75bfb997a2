//! Painting techniques with calibrated pigments: photographs in strokes, and watercolor of
//! photographs and 3D models.
//!
//! ```text
//! photograph -> photograph::Painter ------------> painting of strokes -+
//!                                                                      |
//! photograph -> watercolor::PhotographPainter -+-> picture             +-> PNG, EXR
//! mesh ------> watercolor::ModelPainter -------+                       |
//!                                              +-> wash -> GlazePainter+
//!                                                          (painting)
//! mesh + art map -> painterly::Painter --------> picture
//! ```
//!
//! A painting holds amounts of pigment and can be relit; a picture holds colours only.
//!
//! ```
//! use render::picture::Photograph;
//! use render::watercolor::{PhotographPainter, Preset};
//!
//! # let bytes = render::export::frame_png(&render::field::Field::filled(24, 16, [200, 90, 60]))?;
//! # let folder = std::env::temp_dir().join(format!("render-doctest-{}", std::process::id()));
//! # std::fs::create_dir_all(&folder)?;
//! # let path = folder.join("photograph.png");
//! # std::fs::write(&path, bytes)?;
//! let photograph = Photograph::open(&path)?;
//! let mut painter = PhotographPainter::new(Preset::Landscape.settings());
//! let picture = painter.paint(&photograph)?;
//! assert_eq!((picture.width(), picture.height()), photograph.size());
//! # std::fs::remove_dir_all(&folder)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Techniques never use each other. They share the crates `graphics` (pictures, devices,
//! meshes) and `paint` (paint, brushes, paintings), which are re-exported here, so that a
//! program depends on `render` alone. `examples/` has a program for each entry point.

pub use artmap;
pub use graphics::kernels as graphics_kernels;
pub use graphics::{
    self, camera, coherence, compute, distant_light, encoding, exr_picture, field, gpu, mesh,
    morphology, orientation, picture, picture_formats, segmentation, surface, tile, tones,
};
pub use paint::{self, amount, composite, layer, light, node_pigments, optics, separation, shade};
pub use paint::{BrushSpec, Canvas, HeadShape, OpenStroke, PaintingSession, Sample, StrokeScript};
pub use volumes;

/// Files of pictures, animations and paintings for other programs.
pub mod export {
    pub use graphics::export::*;
    pub use paint::export::*;
}

mod settings_text;

pub mod photograph;

pub mod watercolor;

pub mod painterly;
