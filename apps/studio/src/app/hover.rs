//! A brush that hovers over a surface, and the mesh of its head.

use paint::brush::{Head, Relief};
use paint::pose::Sample;
use paint::strokes::{BrushSpec, SurfaceId};

use session::HeadOnCanvas;

/// A brush that hovers over a surface.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Hover {
    /// Surface below the brush.
    pub(super) surface: SurfaceId,
    /// Position, tilt and twist of the brush.
    pub(super) sample: Sample,
    /// Name of the brush.
    pub(super) brush: String,
}

/// Cached mesh of a brush head that hovers, undeformed, over a level surface.
#[derive(Debug)]
pub(super) struct HoveringHead {
    spec: BrushSpec,
    head: Head,
    level: Relief,
}

impl HoveringHead {
    /// Builds the head of a brush; `None` if the size is invalid for the cell size.
    pub(super) fn of(spec: &BrushSpec, cell_mm: f64) -> Option<Self> {
        let head = Head::new(spec.shape, spec.size_mm, cell_mm).ok()?;
        Some(Self { spec: spec.clone(), head, level: Relief::flat(1, 1, cell_mm) })
    }

    /// Whether this head was built for the same brush head and cell size.
    pub(super) fn is_of(&self, spec: &BrushSpec, cell_mm: f64) -> bool {
        self.spec == *spec && self.level.cell_mm() == cell_mm
    }

    /// Places the head at the hover position. `None` if the head has no mesh.
    pub(super) fn over(&mut self, hover: &Hover) -> Option<HeadOnCanvas> {
        self.head.hover(&hover.sample.pose(self.level.cell_mm()), &self.level);
        let mesh = self.head.mesh()?;
        let surface = hover.surface;
        Some(HeadOnCanvas {
            surface,
            around: mesh.around,
            along: mesh.along,
            vertices: mesh.vertices,
        })
    }
}
