//! Painting with calibrated pigments: thick wet paint moved by a brush, drying
//! layers, and their colour under any light.
//!
//! Follows Baxter, Wendt and Lin, "IMPaSTo: A Realistic, Interactive Model for
//! Paint" (NPAR 2004). Amounts of paint are integers (see [`amount`]), so that
//! nothing is ever lost and CPU and GPU agree bit for bit; light is computed in
//! f32 at eight wavelengths chosen for the illuminant.
//!
//! Out of scope: meshes, painting techniques (crate `render`), fitting pigments
//! (crate `calibrate`).
//!
//! Files stand in an order of dependence; each uses only what stands above it.

pub mod amount;

pub mod layer;

pub mod optics;

pub mod node_pigments;

pub mod light;

pub mod composite;

pub mod shade;

pub mod pose;

pub mod contact;

pub mod motion;

pub mod engine;

pub mod ground;

pub mod document;

pub mod canvas;

pub mod palette;

pub mod separation;

pub mod brush;

pub mod stroke;

pub mod history;

pub mod scene;

pub mod painting;

pub mod strokes;

pub mod session;

pub mod file;

pub mod export;

pub use engine::{BrushId, PaintEngine, UndoSlot, View};
