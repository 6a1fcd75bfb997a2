//! The paint engine: it holds the paint of one painting, moves it under brushes and
//! renders it, on the processor or on a graphics device.
//!
//! ```text
//! Contact  -> apply_contacts -> wet paint, paint on the brush
//! share    -> dry            -> dry layers, floor
//! Scene    -> render         -> picture
//! ```
//!
//! Amounts of paint are integers, so both backends hold the same bits after the same
//! calls; pictures are f32 and agree to rounding. The caller decides where the brush
//! is, which tiles an undo needs and which light is used.

mod ids;
mod cpu;
mod gpu;
mod paint_engine;
mod dry_layers;
mod tiles;

pub use cpu::CpuPaint;
pub use gpu::{GpuPaint, kernels, max_canvas_cells};
pub use ids::{BrushId, UndoSlot, View};
pub use paint_engine::{OpenedEngine, PaintEngine};
