//! The paint engine holds the paint of one painting, moves it under brushes and renders it, on the
//! processor or on a graphics device.
//!
//! ```text
//! Contact  -> apply_contacts -> wet paint, paint on the brush
//! share    -> dry            -> dry layers, floor
//! Scene    -> render         -> picture
//! ```
//!
//! Amounts of paint are integers, so both backends hold the same bits after the same calls.
//! Pictures are f32 and agree to rounding. You decide where the brush is, which tiles an undo needs
//! and which light you use.

mod cpu;
mod gpu;
mod paint_engine;

pub use cpu::CpuPaint;
pub use gpu::{GpuPaint, kernels, max_canvas_cells};
pub use paint_engine::{OpenedEngine, PaintEngine};

/// Identifies a brush of one engine. You get this from
/// [`PaintEngine::add_brush`](PaintEngine::add_brush).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BrushId(pub usize);

/// Identifies a place in the engine's memory that holds the wet paint of one tile for undo. You
/// number slots from 0. The engine allocates up to the highest that you use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct UndoSlot(pub usize);

/// Selects one of the two pictures that an engine can hold of its paint. You render each under a
/// scene of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum View {
    /// The main picture.
    First,
    /// A second picture of this paint, for example under another lamp for comparison.
    Second,
}
