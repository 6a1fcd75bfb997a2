//! Painting with calibrated pigments: thick wet paint moved by a brush, drying layers, and
//! their colour under any light.
//!
//! ```text
//! pen samples -> stroke (sub-steps) -> brush (contacts) -> engine (CPU or GPU): wet paint
//!                                                             |  dry, undo, layers
//!                painting file (EXR) <- Document <------------+
//!                picture (linear sRGB) <- shade <- composite <+  eight wavelengths
//! ```
//!
//! ```
//! use paint::{BrushSpec, Canvas, HeadShape, PaintingSession, Sample};
//! use pigment::library::PigmentLibrary;
//!
//! let oils = PigmentLibrary::van_gogh_oils();
//! let canvas = Canvas { width_mm: 20.0, height_mm: 10.0, cell_mm: 0.5, ..Canvas::default() };
//! let mut painting = PaintingSession::on_canvas(&oils, &canvas)?;
//! painting.set_brush("flat", &BrushSpec { shape: HeadShape::Flat, size_mm: 4.0 })?;
//! painting.load("flat", [("Zinc White", 3.0), ("Prussian Blue", 1.0)], 0.3)?;
//! let samples = [Sample::upright(0.0, 3.0, 5.0, 0.6), Sample::upright(1.0, 17.0, 5.0, 0.6)];
//! assert!(painting.stroke("flat", &samples)?.substeps > 20);
//! let path = std::env::temp_dir().join("impasto-paint-door.exr");
//! painting.save(&path)?;
//! # std::fs::remove_file(path)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`PaintingSession`] is the main entry point: it takes pigments and brushes by name, undoes
//! actions and records them.
//! [`OpenStroke`] is a stroke whose samples arrive one by one. [`StrokeScript`] is a
//! file of strokes, and [`document::Document`] a painting at rest.
//!
//! We follow Baxter, Wendt and Lin, "IMPaSTo: A Realistic, Interactive Model for Paint" (NPAR
//! 2004). Amounts of paint are integers (see [`amount`]), so that paint is conserved exactly and
//! CPU and GPU agree to the bit. Light is computed in f32 at eight wavelengths chosen for the
//! illuminant.
//!
//! Out of scope: meshes, the painting techniques themselves (what they have in common is
//! [`technique::Technique`]), fitting pigments (crate `calibrate`).
//!
//! Modules are listed in order of dependence: each uses only modules above it.

pub mod amount;
pub mod layer;
pub mod optics;
pub mod light;
pub mod composite;
pub mod shade;
pub mod pose;
pub mod contact;
pub mod motion;
pub mod mask;
pub mod engine;
pub mod ground;
pub mod document;
pub mod separation;
pub mod brush;
pub mod stroke;
pub mod history;
pub mod scene;
pub mod strokes;
pub mod file;
pub mod painting;
pub mod session;
pub mod export;
pub mod timelapse;
pub mod technique;

pub use brush::HeadShape;
pub use document::Canvas;
pub use engine::{BrushId, PaintEngine, UndoSlot, View};
pub use painting::OpenStroke;
pub use pose::Sample;
pub use session::PaintingSession;
pub use strokes::{BrushSpec, StrokeScript};
