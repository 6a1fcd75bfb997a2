//! The cells of the grid that hold surface: their middles, areas and room for paint.

use glam::Vec3;
use paint::amount::MAX_COLUMN;

use super::samples::SurfaceSamples;

/// Quanta in a film that covers an area as large as a face of a cell.
pub const QUANTA_PER_FACE: u32 = 1 << 22;

/// How many times its capacity a cell can hold.
pub const MOST_FILMS: u32 = 16;

/// Cosine between the mean normal of a cell and that of a sample below which the sample faces away.
/// Surface between the samples may face away somewhat more.
const AWAY: f32 = 0.0;

/// The surface in each cell. All lists have one entry a cell.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cells {
    /// Mean place of the surface, in the unit of the scene.
    pub centers: Vec<Vec3>,
    /// Mean unit normal of the surface; zero where its sides cancel out.
    pub normals: Vec<Vec3>,
    /// What the surface faces: its mean normal, or zero where some of it faces away from that, as in
    /// a cell with both sides of a thin wall.
    pub facing: Vec<Vec3>,
    /// Quanta of a film that covers all surface in the cell: 2^22 for an area as large as a face
    /// of the cell. 0 for a cell that takes no paint.
    pub capacities: Vec<u32>,
}

impl Cells {
    /// The cells of `samples`.
    #[must_use]
    pub fn of(samples: &SurfaceSamples) -> Self {
        let mut cells = Self::default();
        for cell in 0..samples.cell_count() {
            let mut count = 0_u32;
            let mut place = Vec3::ZERO;
            let mut normal = Vec3::ZERO;
            for sample in samples.of_cell(cell) {
                count += 1;
                place += samples.places[sample];
                normal += samples.normals[sample];
            }
            cells.centers.push(place / count.max(1) as f32);
            let mean = normal.normalize_or_zero();
            let two_sided =
                samples.of_cell(cell).any(|sample: usize| samples.normals[sample].dot(mean) < AWAY);
            cells.facing.push(if two_sided { Vec3::ZERO } else { mean });
            cells.normals.push(mean);
            cells.capacities.push(capacity(samples, count));
        }
        cells
    }

    /// The most quanta that a cell can hold.
    #[must_use]
    pub fn room(&self, cell: usize) -> u32 {
        room(self.capacities[cell])
    }

    /// Number of cells.
    #[must_use]
    pub fn len(&self) -> usize {
        self.capacities.len()
    }

    /// Whether there is no cell.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.capacities.is_empty()
    }
}

/// The most quanta that a cell of this capacity can hold: 16 films, but no more than a column of
/// paint.
pub(super) fn room(capacity: u32) -> u32 {
    capacity.saturating_mul(MOST_FILMS).min(MAX_COLUMN)
}

/// Quanta of a film over this many samples.
fn capacity(samples: &SurfaceSamples, count: u32) -> u32 {
    let quanta = quanta_per_sample(samples) * f64::from(count);
    if count == 0 { 0 } else { quanta.round().clamp(1.0, f64::from(MAX_COLUMN)) as u32 }
}

/// Quanta of a film over the area of one sample.
pub(super) fn quanta_per_sample(samples: &SurfaceSamples) -> f64 {
    let cell = f64::from(samples.lattice.cell);
    let area = samples.areas.first().copied().map_or(0.0, f64::from);
    f64::from(QUANTA_PER_FACE) * area / (cell * cell)
}
