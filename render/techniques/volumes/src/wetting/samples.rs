//! The surface of a scene in samples. Each stands for the same area.

use glam::Vec3;
use graphics::mesh::Mesh;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::lattice::{Lattice, MOST_CELLS, WettingError, rounded_up};

/// A flat piece of surface as large as a face of a cell usually has this many samples.
pub const SAMPLES_PER_CELL: usize = 64;

/// A model has at most this many samples: the usual number in each of as many cells as there can
/// be.
const MOST_SAMPLES: f64 = (MOST_CELLS * SAMPLES_PER_CELL) as f64;

/// We halve a triangle this often. Then the middle of the part that is left is the place.
const HALVINGS: u32 = 32;

/// Places spread evenly over the surface of a mesh, in the order of the cells that hold them. All
/// lists except `starts` have the same length.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceSamples {
    /// The cells in which the samples are counted.
    pub lattice: Lattice,
    /// Places on the surface, in the unit of the scene.
    pub places: Vec<Vec3>,
    /// Unit normals of the triangles, on the side of the normals of the mesh.
    pub normals: Vec<Vec3>,
    /// The area that each sample stands for, in square units of the scene. All samples have the
    /// same area.
    pub areas: Vec<f32>,
    /// Index of the triangle of each sample.
    pub triangles: Vec<u32>,
    /// The cell that holds each sample, counted from 0 in ascending order of [`Lattice::key`]. In
    /// a grid, surfaces in one cube that are not connected have separate cells.
    pub cells: Vec<u32>,
    /// Index of the first sample of each cell. The last entry is the number of samples.
    pub starts: Vec<u32>,
    /// Number of the body of each sample, see `Bodies`. Outside of a grid it is 0.
    pub bodies: Vec<u32>,
}

impl SurfaceSamples {
    /// Samples of a mesh, `per_cell` for an area of `cell` by `cell` in the unit of the scene. Use
    /// [`SAMPLES_PER_CELL`] if you do not need another number. We cut the surface into as many
    /// pieces of one area, along a path that winds through each triangle. `seed` gives each piece
    /// a random place. This leaves out triangles without area.
    ///
    /// # Errors
    /// If the mesh fails [`Mesh::check`], has no area, `cell` is not above 0 or too small, or
    /// `per_cell` is 0 or too many for as many cells.
    pub fn of(mesh: &Mesh, cell: f32, per_cell: usize, seed: u64) -> Result<Self, WettingError> {
        mesh.check()?;
        let triangles = mesh.triangles.len();
        let bounds = mesh.bounds();
        let size = bounds[1] - bounds[0];
        if !size.is_finite() {
            return Err(WettingError::NoArea(triangles));
        }
        let areas: Vec<f64> = (0..triangles).map(|triangle| area(mesh, triangle)).collect();
        let whole: f64 = areas.iter().sum();
        if !(whole.is_finite() && whole > 0.0) {
            return Err(WettingError::NoArea(triangles));
        }
        let lattice = Lattice::around(bounds, cell)?;
        let flat_cells = whole / (f64::from(cell) * f64::from(cell));
        if flat_cells > MOST_CELLS as f64 {
            let fits =
                rounded_up((f64::from(cell) * (flat_cells / MOST_CELLS as f64).sqrt()) as f32);
            return Err(WettingError::TooManyCells { cell, fits });
        }
        let count = (flat_cells * per_cell as f64).ceil().max(1.0);
        if per_cell == 0 || count > MOST_SAMPLES {
            let fits = (MOST_SAMPLES / flat_cells).floor() as usize;
            return Err(WettingError::TooManySamples { found: per_cell, fits });
        }
        let found = spread(mesh, &areas, whole / count, seed);
        Ok(Self::sorted(mesh, lattice, &found, (whole / count) as f32))
    }

    fn sorted(mesh: &Mesh, lattice: Lattice, found: &[(u32, Vec3)], area: f32) -> Self {
        let keys = found.iter().map(|(_, place)| Lattice::key(lattice.coordinates(*place)));
        let mut order: Vec<(u64, u32)> = keys.zip(0..).collect();
        order.sort_unstable();
        let mut cells = Vec::with_capacity(order.len());
        let mut starts = Vec::new();
        for (cell, members) in order.chunk_by(|a, b| a.0 == b.0).enumerate() {
            starts.push(cells.len() as u32);
            cells.resize(cells.len() + members.len(), cell as u32);
        }
        starts.push(cells.len() as u32);
        let triangles: Vec<u32> = order.iter().map(|&(_, at)| found[at as usize].0).collect();
        Self {
            lattice,
            places: order.iter().map(|&(_, at)| found[at as usize].1).collect(),
            normals: triangles.iter().map(|&triangle| normal(mesh, triangle as usize)).collect(),
            areas: vec![area; triangles.len()],
            bodies: vec![0; triangles.len()],
            triangles,
            cells,
            starts,
        }
    }

    /// Gives the pieces of surface in one cube separate cells, in ascending order. `pieces` has
    /// one entry for each sample. Also returns the piece of each cell.
    pub(super) fn by_piece(&self, pieces: &[u32]) -> (Self, Vec<u32>) {
        let mut order: Vec<(u32, u32)> = pieces.iter().copied().zip(0..).collect();
        order.sort_unstable();
        let mut cells = Vec::new();
        let mut starts = vec![0];
        let mut of_cells = Vec::new();
        for (members, cell) in order.chunk_by(|a, b| a.0 == b.0).zip(0..) {
            cells.resize(cells.len() + members.len(), cell);
            starts.push(cells.len() as u32);
            of_cells.push(members[0].0);
        }
        fn from(at: &(u32, u32)) -> usize {
            at.1 as usize
        }
        let samples = Self {
            lattice: self.lattice,
            places: order.iter().map(|at| self.places[from(at)]).collect(),
            normals: order.iter().map(|at| self.normals[from(at)]).collect(),
            areas: order.iter().map(|at| self.areas[from(at)]).collect(),
            triangles: order.iter().map(|at| self.triangles[from(at)]).collect(),
            bodies: order.iter().map(|at| self.bodies[from(at)]).collect(),
            cells,
            starts,
        };
        (samples, of_cells)
    }

    /// The samples at places that are `kept`. Cells keep their numbers, so some may be empty.
    #[must_use]
    pub fn within(&self, kept: impl Fn(Vec3) -> bool) -> Self {
        let all: Vec<usize> = (0..self.len()).filter(|&sample| kept(self.places[sample])).collect();
        Self {
            lattice: self.lattice,
            places: all.iter().map(|&sample| self.places[sample]).collect(),
            normals: all.iter().map(|&sample| self.normals[sample]).collect(),
            areas: all.iter().map(|&sample| self.areas[sample]).collect(),
            triangles: all.iter().map(|&sample| self.triangles[sample]).collect(),
            cells: all.iter().map(|&sample| self.cells[sample]).collect(),
            bodies: all.iter().map(|&sample| self.bodies[sample]).collect(),
            starts: self
                .starts
                .iter()
                .map(|&start: &u32| all.partition_point(|&sample| sample < start as usize) as u32)
                .collect(),
        }
    }

    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether there is no sample.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// Number of cells. Each of them held a sample before [`Self::within`].
    #[must_use]
    pub fn cell_count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The cell that holds a place. If there are several, this is the first. `None` if there is no
    /// surface in it.
    #[must_use]
    pub fn cell_at(&self, place: Vec3) -> Option<usize> {
        let key = |place: Vec3| Lattice::key(self.lattice.coordinates(place));
        let wanted = place.is_finite().then(|| key(place))?;
        // Samples are in the order of their cells. Cells outside of all regions have none.
        let first = self.places.partition_point(|at| key(*at) < wanted);
        let found = self.places.get(first).is_some_and(|at| key(*at) == wanted);
        found.then(|| self.cells[first] as usize)
    }

    /// Indices of the samples in the cell with this index.
    #[must_use]
    pub fn of_cell(&self, cell: usize) -> std::ops::Range<usize> {
        self.starts[cell] as usize..self.starts[cell + 1] as usize
    }
}

fn corners(mesh: &Mesh, triangle: usize) -> [Vec3; 3] {
    mesh.triangles[triangle].corners.map(|corner| Vec3::from(mesh.positions[corner as usize]))
}

fn area(mesh: &Mesh, triangle: usize) -> f64 {
    let [a, b, c] = corners(mesh, triangle).map(Vec3::as_dvec3);
    (b - a).cross(c - a).length() / 2.0
}

pub(super) fn normal(mesh: &Mesh, triangle: usize) -> Vec3 {
    let [a, b, c] = corners(mesh, triangle).map(Vec3::as_dvec3);
    let facet = (b - a).cross(c - a).normalize_or_zero().as_vec3();
    let own = mesh.triangles[triangle].corners;
    let side: Vec3 = own.iter().map(|&corner| Vec3::from(mesh.normals[corner as usize])).sum();
    if side.dot(facet) < 0.0 { -facet } else { facet }
}

/// Picks a random point in every piece of area `step`. Returns its triangle and place.
fn spread(mesh: &Mesh, areas: &[f64], step: f64, seed: u64) -> Vec<(u32, Vec3)> {
    let random = &mut ChaCha8Rng::seed_from_u64(seed);
    let mut found = Vec::new();
    let mut before = 0.0;
    let mut piece = 0.0;
    let mut next = random.random::<f64>() * step;
    for (triangle, &area) in areas.iter().enumerate() {
        while next < before + area {
            let share = ((next - before) / area).clamp(0.0, 1.0);
            found.push((triangle as u32, on_path(corners(mesh, triangle), share)));
            piece += 1.0;
            next = (piece + random.random::<f64>()) * step;
        }
        before += area;
    }
    found
}

/// The place at a share of the area along a path that winds through the whole triangle. The path
/// goes through halves of halves in an order in which neighbours touch (Sierpinski's curve). This
/// makes every stretch of the path a compact piece.
fn on_path(corners: [Vec3; 3], share: f64) -> Vec3 {
    let squared = [0, 1, 2].map(|i: usize| corners[i].distance_squared(corners[(i + 1) % 3]));
    let longest = (1..3).fold(0, |most, i| if squared[i] > squared[most] { i } else { most });
    let [mut start, mut end, mut apex] = [0, 1, 2].map(|i| corners[(longest + i) % 3]);
    let mut bits = (share * (1_u64 << HALVINGS) as f64) as u64;
    bits = bits.min((1 << HALVINGS) - 1);
    for level in (0..HALVINGS).rev() {
        let middle = (start + end) / 2.0;
        match bits >> level & 1 {
            0 => (end, apex) = (apex, middle),
            _ => (start, apex) = (apex, middle),
        }
    }
    (start + end + apex) / 3.0
}

#[cfg(test)]
mod tests {
    use graphics::mesh::SampleModel;

    use super::*;
    use crate::test_volumes::{bare, sheet};

    #[test]
    fn areas_add_up_to_that_of_the_surface() {
        let samples =
            SurfaceSamples::of(&Mesh::sphere(60_000), 1.0 / 6.0, SAMPLES_PER_CELL, 1).unwrap();
        let whole: f64 = samples.areas.iter().map(|&area| f64::from(area)).sum();
        assert!((whole / (4.0 * std::f64::consts::PI) - 1.0).abs() < 1e-3, "{whole}");
        assert_eq!(samples.len().div_ceil(1000), 29);
        for (place, normal) in samples.places.iter().zip(&samples.normals) {
            assert!((place.length() - 1.0).abs() < 1e-3 && place.dot(*normal) > 0.99);
        }
    }

    #[test]
    fn samples_face_as_the_normals_of_the_mesh_do() {
        let mut mesh = Mesh::sphere(500);
        mesh.triangles.iter_mut().step_by(3).for_each(|triangle| triangle.corners.swap(0, 1));
        let samples = SurfaceSamples::of(&mesh, 0.5, SAMPLES_PER_CELL, 1).unwrap();
        let mut facing = samples.places.iter().zip(&samples.normals);
        assert!(facing.all(|(place, normal)| place.normalize().dot(*normal) > 0.9));
    }

    #[test]
    fn every_part_of_a_surface_has_its_share() {
        // We cut a triangle by lines into parts. Each part must have as many samples as fit its
        // area.
        let mesh = bare(&[[0.0; 3], [8.0, 0.0, 0.0], [0.0, 0.0, 8.0]], &[[0, 2, 1]]);
        let samples = SurfaceSamples::of(&mesh, 1.0, SAMPLES_PER_CELL, 7).unwrap();
        assert_eq!(samples.len(), 32 * SAMPLES_PER_CELL);
        for (x, z) in [(0.0, 0.0), (2.0, 2.0), (1.0, 3.0), (3.5, 0.2)] {
            let inside = samples
                .places
                .iter()
                .filter(|at| (x..x + 2.0).contains(&at.x) && (z..z + 2.0).contains(&at.z));
            // Pieces at the rim of a part of 256 samples may lie on either side.
            let found = inside.count();
            assert!((240..=272).contains(&found), "{x} {z}: {found}");
        }
    }

    #[test]
    fn no_place_is_far_from_a_sample() {
        let mesh = bare(&[[0.0; 3], [9.0, 0.0, 1.0], [2.0, 0.0, 8.0]], &[[0, 2, 1]]);
        let samples = SurfaceSamples::of(&mesh, 1.0, SAMPLES_PER_CELL, 7).unwrap();
        let spacing = samples.areas[0].sqrt();
        let random = &mut ChaCha8Rng::seed_from_u64(9);
        let [a, b, c] = corners(&mesh, 0);
        let mut most = 0.0_f32;
        for _ in 0..4000 {
            let [u, v]: [f32; 2] = [(); 2].map(|()| random.random());
            let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
            let place = a + (b - a) * u + (c - a) * v;
            let distances = samples.places.iter().map(|at| at.distance(place));
            most = most.max(distances.fold(f32::INFINITY, f32::min) / spacing);
        }
        assert!(most < 1.3, "{most} spacings");
    }

    #[test]
    fn samples_do_not_depend_on_the_cut_into_triangles() {
        let corners = [[0.0; 3], [4.0, 0.0, 0.0], [4.0, 0.0, 4.0], [0.0, 0.0, 4.0]];
        let flat =
            SurfaceSamples::of(&bare(&corners, &[[0, 2, 1], [0, 3, 2]]), 1.0, SAMPLES_PER_CELL, 3)
                .unwrap();
        let fine = SurfaceSamples::of(
            &sheet(100, |u, v| [4.0 * u, 0.0, 4.0 * v]),
            1.0,
            SAMPLES_PER_CELL,
            3,
        )
        .unwrap();
        assert_eq!(flat.cell_count(), fine.cell_count());
        assert!(flat.len().abs_diff(fine.len()) <= 1);
        for cell in 0..flat.cell_count() {
            let [a, b] = [&flat, &fine].map(|samples| samples.of_cell(cell).len());
            assert!(a.abs_diff(b) <= 14, "{cell}: {a} {b}");
        }
    }

    #[test]
    fn samples_are_in_the_order_of_cells() {
        for shape in SampleModel::ALL {
            let mesh = shape.mesh(4000);
            let [low, high] = mesh.bounds();
            let cell = (high - low).max_element() / 12.0;
            let samples = SurfaceSamples::of(&mesh, cell, SAMPLES_PER_CELL, 1).unwrap();
            assert_eq!(samples, SurfaceSamples::of(&mesh, cell, SAMPLES_PER_CELL, 1).unwrap());
            let mut last = 0;
            for index in 0..samples.cell_count() {
                let range = samples.of_cell(index);
                assert!(!range.is_empty() && range.start == last);
                last = range.end;
                let at = samples.lattice.coordinates(samples.places[range.start]);
                assert_eq!(samples.cell_at(samples.places[range.start]), Some(index));
                for sample in range {
                    assert_eq!(samples.lattice.coordinates(samples.places[sample]), at);
                    assert_eq!(samples.cells[sample] as usize, index);
                }
            }
            assert_eq!(last, samples.len());
            assert_eq!(samples.cell_at(high + cell), None);
        }
    }

    #[test]
    fn triangles_without_area_are_left_out_and_models_of_them_refused() {
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let mesh = bare(&positions, &[[0, 1, 2], [0, 3, 1], [1, 1, 1]]);
        let samples = SurfaceSamples::of(&mesh, 0.25, SAMPLES_PER_CELL, 1).unwrap();
        assert!(samples.triangles.iter().all(|&triangle| triangle == 1));
        let line = bare(&positions, &[[0, 1, 2]]);
        let refused = SurfaceSamples::of(&line, 0.25, SAMPLES_PER_CELL, 1);
        assert_eq!(refused, Err(WettingError::NoArea(1)));
        let points = bare(&positions, &[]);
        assert!(matches!(
            SurfaceSamples::of(&points, 0.25, SAMPLES_PER_CELL, 1),
            Err(WettingError::Mesh(_))
        ));
        let Err(WettingError::TooManyCells { fits, .. }) =
            SurfaceSamples::of(&mesh, 1e-4, SAMPLES_PER_CELL, 1)
        else {
            panic!("cells of 1e-4 fit");
        };
        assert!((6.9e-4..7.1e-4).contains(&fits), "{fits}");
    }

    #[test]
    fn a_cell_has_as_many_samples_as_are_wanted() {
        let mesh = sheet(10, |u, v| [8.0 * u, 0.0, 8.0 * v]);
        for per_cell in [8, 64, 200] {
            let samples = SurfaceSamples::of(&mesh, 1.0, per_cell, 1).unwrap();
            assert_eq!(samples.len(), 64 * per_cell);
        }
        let none = SurfaceSamples::of(&mesh, 1.0, 0, 1);
        assert!(matches!(none, Err(WettingError::TooManySamples { found: 0, .. })));
        let many = SurfaceSamples::of(&mesh, 0.01, 1024, 1);
        assert_eq!(many, Err(WettingError::TooManySamples { found: 1024, fits: 104 }));
    }
}
