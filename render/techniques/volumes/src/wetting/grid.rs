//! The grid of a scene: samples of its surface, cells, links between them and the reach of paint. A
//! cell knows its middle, its area and its room for paint. The reach says how large the volume of
//! an amount of paint is, so that the films of all volumes have one thickness.

use glam::Vec3;
use graphics::mesh::Mesh;
use paint::amount::MAX_COLUMN;

use super::graph::Graph;
use super::lattice::WettingError;
use super::pieces::{Bodies, Pieces};
use super::samples::SurfaceSamples;

/// Facts about the surface before paint lies on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// The surface in samples.
    pub samples: SurfaceSamples,
    /// The cells that hold them.
    pub cells: Cells,
    /// The cells joined by surface.
    pub graph: Graph,
    /// Radii of volumes by their amount of paint.
    pub reach: Reach,
    /// Parts that are one surface for paint.
    pub bodies: Bodies,
}

impl Grid {
    /// The grid of a mesh with cells of width `cell`, in the unit of the scene, and `per_cell`
    /// samples in each on average. `seed` decides the places of the samples.
    ///
    /// # Errors
    /// If the mesh has no surface, the cells have no size, or cells or samples are too many.
    pub fn of(mesh: &Mesh, cell: f32, per_cell: usize, seed: u64) -> Result<Self, WettingError> {
        let cubes = SurfaceSamples::of(mesh, cell, per_cell, seed)?;
        let pieces = Pieces::of(mesh, &cubes)?;
        let (mut samples, of_cells) = cubes.by_piece(&pieces.of_samples(&cubes));
        let cells = Cells::of(&samples);
        let graph = Graph::of(&pieces, &of_cells);
        let bodies = Bodies::of(&pieces, &of_cells);
        samples.bodies =
            samples.cells.iter().map(|&cell: &u32| bodies.of_cells[cell as usize]).collect();
        let reach = Reach::of(&samples, &cells);
        Ok(Self { samples, cells, graph, reach, bodies })
    }

    /// The grid of the surface where `kept` is true. Cells keep their numbers. If a cell has no
    /// such surface, it has no capacity and no links.
    #[must_use]
    pub fn within(&self, kept: impl Fn(Vec3) -> bool) -> Self {
        let samples = self.samples.within(kept);
        let cells = Cells::of(&samples);
        let graph = self.graph.cut(|cell| cells.capacities[cell] > 0);
        let reach = Reach::of(&samples, &cells);
        Self { samples, cells, graph, reach, bodies: self.bodies.clone() }
    }

    /// The sample nearest to `place`, the first of several, and its distance in the unit of the
    /// scene. `None` if no cell takes paint.
    #[must_use]
    pub fn nearest(&self, place: Vec3) -> Option<(usize, f32)> {
        // No place in a cell is farther from the middle of its surface than this.
        let diagonal = 1.75 * self.samples.lattice.cell;
        let mut found = None;
        let mut least = f32::INFINITY;
        let mut search = |cell: usize| {
            let near = self.cells.centers[cell].distance(place) <= least + diagonal;
            if near && self.cells.capacities[cell] > 0 {
                for sample in self.samples.of_cell(cell) {
                    let distance = self.samples.places[sample].distance(place);
                    if distance < least || (distance == least && Some(sample) < found) {
                        (found, least) = (Some(sample), distance);
                    }
                }
            }
        };
        // We take the cell of the place first, because few others then have nearer samples.
        self.samples.cell_at(place).into_iter().for_each(&mut search);
        (0..self.cells.centers.len()).for_each(search);
        found.map(|sample| (sample, least))
    }

    /// The place on the surface of `cell` nearest to `from`.
    #[must_use]
    pub fn entrance(&self, cell: usize, from: Vec3) -> Vec3 {
        let own = self.samples.places[self.samples.of_cell(cell)].iter().copied();
        let nearest =
            own.min_by(|a, b| a.distance_squared(from).total_cmp(&b.distance_squared(from)));
        nearest.unwrap_or(self.cells.centers[cell])
    }
}

/// A film that covers an area as large as a face of a cell has this many quanta.
pub const QUANTA_PER_FACE: u32 = 1 << 22;

/// A cell can hold this many times its capacity.
pub const MOST_FILMS: u32 = 16;

/// If the cosine between a sample's normal and the mean normal of its cell is below this, the
/// sample faces away. Surface between the samples may face away a little more.
const AWAY: f32 = 0.0;

/// The surface in each cell. All lists have one entry per cell.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cells {
    /// Mean place of the surface, in the unit of the scene.
    pub centers: Vec<Vec3>,
    /// Mean unit normal of the surface. It is zero where its sides cancel out.
    pub normals: Vec<Vec3>,
    /// The direction that the surface faces. This is its mean normal, or zero if some of the
    /// surface faces away from it, e.g. in a cell with both sides of a thin wall.
    pub facing: Vec<Vec3>,
    /// Quanta of a film that covers all surface in the cell: 2^22 for an area as large as a face
    /// of the cell. If a cell takes no paint, this is 0.
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

/// A cell of this capacity can hold at most this many quanta: 16 films, but no more than a column
/// of paint.
pub(super) fn room(capacity: u32) -> u32 {
    capacity.saturating_mul(MOST_FILMS).min(MAX_COLUMN)
}

fn capacity(samples: &SurfaceSamples, count: u32) -> u32 {
    let quanta = quanta_per_sample(samples) * f64::from(count);
    if count == 0 { 0 } else { quanta.round().clamp(1.0, f64::from(MAX_COLUMN)) as u32 }
}

pub(super) fn quanta_per_sample(samples: &SurfaceSamples) -> f64 {
    let cell = f64::from(samples.lattice.cell);
    let area = samples.areas.first().copied().map_or(0.0, f64::from);
    f64::from(QUANTA_PER_FACE) * area / (cell * cell)
}

/// Radii of the volumes of all cells by amount of paint.
#[derive(Debug, Clone, PartialEq)]
pub struct Reach {
    /// Distances of the samples of each cell from its middle, in ascending order.
    distances: Vec<f32>,
    /// Index of the first distance of each cell. The last entry is their number.
    starts: Vec<u32>,
    per_sample: f32,
    spacing: f32,
}

impl Reach {
    /// Measures the reach over the samples around the middles of `cells`.
    #[must_use]
    pub fn of(samples: &SurfaceSamples, cells: &Cells) -> Self {
        let mut distances = Vec::with_capacity(samples.len());
        let mut starts = vec![0];
        for cell in 0..samples.cell_count() {
            let first = distances.len();
            let own = &samples.places[samples.of_cell(cell)];
            distances.extend(own.iter().map(|place| place.distance(cells.centers[cell])));
            distances[first..].sort_unstable_by(f32::total_cmp);
            starts.push(distances.len() as u32);
        }
        let spacing = samples.areas.first().map_or(0.0, |area| area.sqrt());
        Self { distances, starts, per_sample: quanta_per_sample(samples) as f32, spacing }
    }

    /// Radius of the volume of `cell` that holds `amount` quanta. A film over the samples within
    /// this radius has this amount, with linear steps between samples. From the capacity of the
    /// cell on, the volume reaches beyond its farthest sample by the distance between samples,
    /// even where a surface rough by `microstructure` (0 to below 1) is lowest.
    #[must_use]
    pub fn radius(&self, cell: usize, amount: u32, microstructure: f32) -> f32 {
        let own = &self.distances[self.starts[cell] as usize..self.starts[cell + 1] as usize];
        let [Some(&nearest), Some(&farthest)] = [own.first(), own.last()] else { return 0.0 };
        let full = (farthest + self.spacing) / (1.0 - microstructure);
        // Half of a sample's area lies nearer than the sample.
        let covered = amount as f32 / self.per_sample - 0.5;
        if covered < 0.0 {
            return nearest * (2.0 * (covered + 0.5)).sqrt();
        }
        let before = covered as usize;
        let between = covered - before as f32;
        match (own.get(before), own.get(before + 1)) {
            (Some(from), Some(to)) => from + (to - from) * between,
            (Some(last), None) => last + (full - last) * (2.0 * between).min(1.0),
            (None, _) => full,
        }
    }
}
