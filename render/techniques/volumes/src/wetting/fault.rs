//! Why a surface cannot be wetted.

use documents::hint::{Explain, Fault, Hint};
use graphics::mesh::MeshFault;

/// Greatest number of cells of a grid.
pub const MOST_CELLS: usize = 1 << 20;

/// A surface or a size of cells for which there is no grid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WettingError {
    /// The mesh is damaged.
    #[error(transparent)]
    Mesh(#[from] MeshFault),
    /// No triangle has an area, or the model is too large for its areas to be numbers.
    #[error("the model has {triangles} triangles, but no area that paint could lie on")]
    NoArea {
        /// Number of triangles.
        triangles: usize,
    },
    /// The cells have no size.
    #[error("cells of the grid are `{found}` wide")]
    CellSize {
        /// Width of a cell, in the unit of the scene.
        found: f32,
    },
    /// The grid would have too many cells.
    #[error("cells of {cell} are too small for this model: the grid has at most {MOST_CELLS}")]
    TooManyCells {
        /// Width of a cell, in the unit of the scene.
        cell: f32,
        /// Width of cells that are few enough, in the unit of the scene.
        fits: f32,
    },
    /// A cell would have no samples, or all cells together too many.
    #[error("cells of the grid have `{found}` samples each")]
    TooManySamples {
        /// Samples in a cell.
        found: usize,
        /// Samples in a cell that are few enough for this model.
        fits: usize,
    },
    /// The rate or the slope of spilling is out of its range.
    #[error("paint cannot spill at {what} `{found}`")]
    Spilling {
        /// Name of the setting.
        what: &'static str,
        /// Its value.
        found: f32,
    },
}

impl Explain for WettingError {
    fn hint(&self) -> Option<Hint> {
        Some(match self {
            Self::Mesh(fault) => return fault.hint(),
            Self::NoArea { .. } => Hint::new("export the model with its faces, at its real size"),
            Self::CellSize { .. } => Hint::verbatim("grid.cell is a share above 0"),
            Self::TooManyCells { fits, .. } => Hint::verbatim(format!("cells of {fits} would fit")),
            Self::TooManySamples { fits, .. } => {
                Hint::verbatim(format!("grid.samples is 1 to {fits}"))
            }
            Self::Spilling { what, .. } if *what == "rate" => {
                Hint::verbatim("grid.rate is 0 to 0.067")
            }
            Self::Spilling { .. } => Hint::verbatim("grid.slope is 0 to 1000"),
        })
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Mesh(_) | Self::NoArea { .. } => Fault::Input,
            _ => Fault::Setting,
        }
    }
}
