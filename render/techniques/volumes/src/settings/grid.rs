//! Settings of the grid of cells that paint spills over.

use serde::{Deserialize, Serialize};

use super::setting::{
    Setting,
    Takes::{Number, Whole},
};

/// Cells over the scene's surface, and how paint spills from one to the other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GridTable {
    /// Width of a cell by the scene's longest side, 0..=1; 0 is single volumes only.
    pub cell: f32,
    /// Thickness of the film that a cell holds before paint spills, in mm, 1e-4..=100.
    pub film_mm: f32,
    /// Share of the difference between two cells that flows in a step, 0..=0.067.
    pub rate: f32,
    /// Weight of height above the lowest cell, 0..=1000.
    pub slope: f32,
    /// Samples of the surface in a cell on average, 8..=1024.
    pub samples: u32,
}

impl Default for GridTable {
    fn default() -> Self {
        Self { cell: 0.083_333_3, film_mm: 0.02, rate: 0.04, slope: 0.0, samples: 64 }
    }
}

pub(super) const SETTINGS: [Setting; 5] = [
    Setting::new(
        "grid.cell",
        Number(0.0, 1.0),
        "longest sides of the scene",
        "Width of a cell; 0 is single volumes only.",
    ),
    Setting::new(
        "grid.film_mm",
        Number(1e-4, 100.0),
        "mm",
        "Thickness of the film that a surface takes before paint spills further.",
    ),
    Setting::new(
        "grid.rate",
        Number(0.0, 0.067),
        "",
        "Share of the difference between neighbouring cells that flows in a step of 1/120 s.",
    ),
    Setting::new(
        "grid.slope",
        Number(0.0, 1000.0),
        "",
        "How much paint prefers to run down; 0 spreads alike to all sides.",
    ),
    Setting::new(
        "grid.samples",
        Whole(8, 1024),
        "",
        "Samples of the surface in a cell, on average.",
    ),
];
