//! The palette and the brushes beside a canvas, as a painting's file keeps them.

use super::script::BrushSpec;
use super::surface_id::SurfaceId;
use crate::document::Document;
use crate::layer::Layer;

/// A brush with the paint that its head holds.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptBrush {
    /// Name of the brush.
    pub name: String,
    /// Shape and size of its head.
    pub spec: BrushSpec,
    /// Surface where it was last used.
    pub at: SurfaceId,
    /// Paint on the cells of its head, with the pigments of the palette; `None` if it is clean.
    pub paint: Option<Layer>,
}

/// The palette with its paint, and all brushes with theirs.
#[derive(Debug, Clone, PartialEq)]
pub struct SideTable {
    /// The palette that paint is mixed on, with the pigments, light and medium of the canvas.
    pub palette: Document,
    /// The brushes in the order of their names.
    pub brushes: Vec<KeptBrush>,
}
