//! Handles that a caller of the paint engine holds.

/// Identifies a brush of one engine; returned by
/// [`PaintEngine::add_brush`](super::PaintEngine::add_brush).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BrushId(pub usize);

/// Identifies a place in the engine's memory that holds the wet paint of one tile
/// for undo. Slots are numbered from 0; the engine allocates up to the highest used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct UndoSlot(pub usize);

/// Selects one of the two pictures that an engine can hold of its paint, each
/// rendered under a scene of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum View {
    /// The main picture.
    First,
    /// A second picture of the same paint, such as under another lamp for comparison.
    Second,
}
