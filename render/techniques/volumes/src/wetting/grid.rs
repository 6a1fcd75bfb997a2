//! The grid of a scene: samples of its surface, cells, links between them and the reach of paint.

use glam::Vec3;
use graphics::mesh::Mesh;

use super::bodies::Bodies;
use super::cells::Cells;
use super::fault::WettingError;
use super::graph::Graph;
use super::pieces::Pieces;
use super::reach::Reach;
use super::samples::SurfaceSamples;

/// Everything that is known of the surface before paint lies on it.
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
    /// samples in each on average. Places are drawn from `seed`.
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
        let body = |&cell: &u32| bodies.of_cells[cell as usize];
        samples.bodies = samples.cells.iter().map(body).collect();
        let reach = Reach::of(&samples, &cells);
        Ok(Self { samples, cells, graph, reach, bodies })
    }

    /// The grid of the surface where `kept` is true. The numbers of cells stay; cells without
    /// such surface have no capacity and no links.
    #[must_use]
    pub fn within(&self, kept: impl Fn(Vec3) -> bool) -> Self {
        let samples = self.samples.within(kept);
        let cells = Cells::of(&samples);
        let graph = self.graph.cut(|cell| cells.capacities[cell] > 0);
        let reach = Reach::of(&samples, &cells);
        Self { samples, cells, graph, reach, bodies: self.bodies.clone() }
    }

    /// The sample nearest to `place`, the first of several, and its distance in the unit of the
    /// scene; none if no cell takes paint.
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
        // The cell of the place comes first: few others then have nearer samples.
        self.samples.cell_at(place).into_iter().for_each(&mut search);
        (0..self.cells.centers.len()).for_each(search);
        found.map(|sample| (sample, least))
    }

    /// The place on the surface of `cell` that is nearest to the place `from`.
    #[must_use]
    pub fn entrance(&self, cell: usize, from: Vec3) -> Vec3 {
        let own = self.samples.places[self.samples.of_cell(cell)].iter().copied();
        let nearest =
            own.min_by(|a, b| a.distance_squared(from).total_cmp(&b.distance_squared(from)));
        nearest.unwrap_or(self.cells.centers[cell])
    }
}
