//! Size and ground of a canvas.

use pigment::library::PigmentLibrary;
use serde::{Deserialize, Serialize};

use crate::ground::{Ground, GroundError, GroundSpec};

/// A canvas without paint: its size, its cells and its ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Canvas {
    /// Width in mm, 0.001 to 1e6.
    pub width_mm: f64,
    /// Height in mm, 0.001 to 1e6.
    pub height_mm: f64,
    /// Width and height of a cell in mm, 0.001 to 10; 0.1 (254 to the inch) by default.
    #[serde(default = "default_cell_mm")]
    pub cell_mm: f64,
    /// The ground; primed linen by default.
    #[serde(default)]
    pub ground: GroundSpec,
}

impl Default for Canvas {
    /// Primed linen of 192 x 108 mm, which are 1920 x 1080 cells.
    fn default() -> Self {
        let cell_mm = default_cell_mm();
        Self { width_mm: 192.0, height_mm: 108.0, cell_mm, ground: GroundSpec::default() }
    }
}

impl Canvas {
    /// Columns and rows of cells: as many as cover the canvas, at least one each.
    #[must_use]
    pub fn cells(&self) -> (usize, usize) {
        let Self { width_mm, height_mm, cell_mm, .. } = *self;
        (covering_cells(width_mm, cell_mm), covering_cells(height_mm, cell_mm))
    }

    /// The ground of this canvas, with its reflectance on the grid of `library`.
    ///
    /// # Errors
    /// [`GroundError`] for a ground that cannot be made or whose picture cannot be read.
    pub fn ground(&self, library: &PigmentLibrary) -> Result<Ground, GroundError> {
        let (width, height) = self.cells();
        self.ground.build(width, height, self.cell_mm, library)
    }

    /// The longer side in mm.
    pub(crate) fn longer_side_mm(&self) -> f64 {
        self.width_mm.max(self.height_mm)
    }
}

/// Number of cells that cover a side, at least one.
pub(crate) fn covering_cells(side_mm: f64, cell_mm: f64) -> usize {
    // A remainder below 1e-6 of a cell is a rounding error and adds no cell.
    ((side_mm / cell_mm - 1e-6).ceil() as usize).max(1)
}

fn default_cell_mm() -> f64 {
    0.1
}
