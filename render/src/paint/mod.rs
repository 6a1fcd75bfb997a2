//! Painting: canvas, brush, motion, drying, and the backends that do it.

pub mod pose;

pub mod contact;

pub mod motion;

mod engine;

pub mod document;

pub mod ground;

pub mod brush;

pub mod stroke;

pub mod on_cpu;

pub mod on_gpu;

pub mod history;

pub mod scene;

pub mod painting;

pub mod strokes;

pub mod easel;

pub mod file;

pub use engine::{BrushId, Engine, EngineError, Slot, View};
