//! The pieces of surface in each cell. A piece is connected within the cell, so that a cell does
//! not mix bodies that only come near each other. This also finds bodies, which are the parts of a
//! model that are one surface for paint.

use glam::{DVec3, Vec3};
use graphics::mesh::Mesh;
use rayon::prelude::*;

use super::lattice::{Lattice, WettingError, entered, in_cells, rounded_up, touches};
use super::samples::SurfaceSamples;

/// All triangles together may enter at most this many cells.
const MOST_ENTERED: f64 = (1 << 26) as f64;

/// Surfaces touch if they are nearer than this in cells, which is the distance between samples.
const NEAR: f32 = 1.0 / 8.0;

/// Surfaces touch only if the cosine between their normals is at least this. For example, a wall
/// touches its ground, and a pane its wall. But a fruit does not touch the cloth on which it lies,
/// because their sides face each other.
const FACING: f32 = -0.2;

#[derive(Debug, Clone, Default)]
pub(super) struct Pieces {
    /// An entry is a cell that a triangle enters. This is the index of the first entry of each
    /// triangle, and at the end the number of entries.
    starts: Vec<u32>,
    cells: Vec<[i32; 3]>,
    of_entries: Vec<u32>,
    /// [`Lattice::key`] of the cell of each piece, in ascending order.
    pub(super) keys: Vec<u64>,
    /// Pairs of pieces in neighbouring cells that share surface, in both directions and ascending
    /// order.
    pub(super) pairs: Vec<(u32, u32)>,
}

impl Pieces {
    /// The pieces of the surface of `samples`. Triangles with a common edge in a cell belong to
    /// one piece, and so do surfaces that touch there.
    ///
    /// # Errors
    /// If the triangles enter too many cells.
    pub(super) fn of(mesh: &Mesh, samples: &SurfaceSamples) -> Result<Self, WettingError> {
        let lattice = &samples.lattice;
        let places: Vec<DVec3> =
            mesh.positions.par_iter().map(|&position| in_cells(lattice, position)).collect();
        let (starts, cells) = entries(mesh, &places, lattice.cell)?;
        let mut pieces = Self { starts, cells, ..Self::default() };
        let edges = shared_edges(mesh, &pieces);
        let mut roots: Vec<u32> = (0..pieces.cells.len() as u32).collect();
        for edge in &edges {
            pieces.connect(edge, &places, &mut roots);
        }
        for (one, other) in pieces.touching(mesh, samples, &roots) {
            unite(&mut roots, one, other);
        }
        pieces.number(&mut roots);
        pieces.pair(&edges, &places);
        Ok(pieces)
    }

    pub(super) fn of_samples(&self, samples: &SurfaceSamples) -> Vec<u32> {
        let mut last = 0;
        (0..samples.len())
            .map(|sample: usize| {
                let entry = self.entry_of(samples, sample);
                // Rounding may put a sample outside of all cells that its triangle enters.
                last = entry.map_or(last, |entry| self.of_entries[entry]);
                last
            })
            .collect()
    }

    pub(super) fn triangles(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    pub(super) fn of_triangle(&self, triangle: usize) -> &[u32] {
        &self.of_entries[self.entries_of(triangle)]
    }

    fn entries_of(&self, triangle: usize) -> std::ops::Range<usize> {
        self.starts[triangle] as usize..self.starts[triangle + 1] as usize
    }

    fn entry_of(&self, samples: &SurfaceSamples, sample: usize) -> Option<usize> {
        let at = samples.lattice.coordinates(samples.places[sample]);
        let own = self.entries_of(samples.triangles[sample] as usize);
        let found = self.cells[own.clone()].binary_search(&at);
        found.ok().map(|index| own.start + index)
    }

    /// Makes one piece of the entries of two triangles, in each cell that their common edge
    /// touches.
    fn connect(&self, edge: &SharedEdge, places: &[DVec3], roots: &mut [u32]) {
        let line = edge.line.map(|corner| places[corner as usize]);
        let [own, others] = edge.triangles.map(|triangle| self.entries_of(triangle as usize));
        for one in own {
            let cell = self.cells[one];
            let found = self.cells[others.clone()].binary_search(&cell);
            if let Ok(index) = found
                && ((edge.is_inside(self)) || touches(line, cell))
            {
                unite(roots, one as u32, (others.start + index) as u32);
            }
        }
    }

    fn touching(&self, mesh: &Mesh, samples: &SurfaceSamples, roots: &[u32]) -> Vec<(u32, u32)> {
        let mut order: Vec<(u64, u32, u32)> = Vec::with_capacity(self.cells.len());
        for triangle in 0..mesh.triangles.len() {
            let own = self.entries_of(triangle);
            order.extend(
                own.map(|entry| (Lattice::key(self.cells[entry]), entry as u32, triangle as u32)),
            );
        }
        order.par_sort_unstable();
        let near = NEAR * samples.lattice.cell;
        let cells = (0..samples.cell_count()).into_par_iter().flat_map_iter(|cell| {
            let own = samples.of_cell(cell);
            let key = Lattice::key(samples.lattice.coordinates(samples.places[own.start]));
            let from = order.partition_point(|entry| entry.0 < key);
            let to = from + order[from..].partition_point(|entry| entry.0 == key);
            let inside = &order[from..to];
            let single =
                inside.iter().all(|entry| root_of(roots, entry.1) == root_of(roots, inside[0].1));
            let mut found: Vec<(u32, u32)> = Vec::new();
            for sample in own.filter(|_| !single) {
                let Some(entry) = self.entry_of(samples, sample) else { continue };
                let one = root_of(roots, entry as u32);
                let place = samples.places[sample];
                for &(_, entry, triangle) in inside {
                    let other = root_of(roots, entry);
                    let pair = (one.min(other), one.max(other));
                    if one == other || found.contains(&pair) {
                        continue;
                    }
                    let corners = mesh.triangles[triangle as usize].corners;
                    let corners = corners.map(|at| Vec3::from(mesh.positions[at as usize]));
                    let [low, high] = [Vec3::min, Vec3::max].map(|end| {
                        let [a, b, c] = corners;
                        end(end(a, b), c)
                    });
                    let beside = place.clamp(low, high).distance_squared(place) >= near * near;
                    if beside || distance(place, corners) >= near {
                        continue;
                    }
                    let normal = super::samples::normal(mesh, triangle as usize);
                    if normal.dot(samples.normals[sample]) >= FACING {
                        found.push(pair);
                    }
                }
            }
            found
        });
        cells.collect()
    }

    /// Numbers the pieces in the order of their cells. Within a cell their first triangle decides.
    fn number(&mut self, roots: &mut [u32]) {
        for entry in 0..roots.len() {
            // Roots are the lowest entries of their pieces.
            roots[entry] = roots[roots[entry] as usize];
        }
        let firsts = (0..roots.len() as u32).filter(|&entry| root_of(roots, entry) == entry);
        let mut order: Vec<(u64, u32)> =
            firsts.map(|entry| (Lattice::key(self.cells[entry as usize]), entry)).collect();
        order.par_sort_unstable();
        let mut numbers = vec![0; roots.len()];
        for (&(_, entry), number) in order.iter().zip(0..) {
            numbers[entry as usize] = number;
        }
        self.of_entries =
            (0..roots.len() as u32).map(|entry| numbers[root_of(roots, entry) as usize]).collect();
        self.keys = order.into_iter().map(|(key, _)| key).collect();
    }

    /// Fills `pairs`. Two pieces share surface if a triangle enters both, or if two triangles with
    /// a common edge enter one each, and this edge touches both cells.
    fn pair(&mut self, edges: &[SharedEdge], places: &[DVec3]) {
        let mut pairs = Vec::new();
        for triangle in 0..self.starts.len() - 1 {
            let own = self.entries_of(triangle);
            for one in own.clone().filter(|_| own.len() > 1) {
                let others = own.clone().filter(|&other| self.adjacent(one, other));
                pairs.extend(others.map(|other| (self.of_entries[one], self.of_entries[other])));
            }
        }
        for edge in edges {
            let line = edge.line.map(|corner| places[corner as usize]);
            if !is_near_wall(line) {
                continue;
            }
            let [own, others] = edge.triangles.map(|triangle| self.entries_of(triangle as usize));
            for one in own.filter(|&one| touches(line, self.cells[one])) {
                let near = others
                    .clone()
                    .filter(|&other| self.adjacent(one, other) && touches(line, self.cells[other]));
                for other in near {
                    let [a, b] = [one, other].map(|entry| self.of_entries[entry]);
                    pairs.extend([(a, b), (b, a)]);
                }
            }
        }
        pairs.par_sort_unstable();
        pairs.dedup();
        self.pairs = pairs;
    }

    fn adjacent(&self, one: usize, other: usize) -> bool {
        let [a, b] = [one, other].map(|entry| self.cells[entry]);
        a != b && (0..3).all(|axis| (a[axis] - b[axis]).abs() <= 1)
    }
}

/// The cells that all triangles enter. Triangles without area enter none.
fn entries(
    mesh: &Mesh,
    places: &[DVec3],
    cell: f32,
) -> Result<(Vec<u32>, Vec<[i32; 3]>), WettingError> {
    let all = mesh.triangles.iter().map(|own| own.corners.map(|corner| places[corner as usize]));
    fn length([a, b, c]: [DVec3; 3]) -> f64 {
        a.distance(b).max(b.distance(c)).max(c.distance(a))
    }
    let most = all.map(|corners| 1.0 + length(corners)).sum::<f64>();
    if most > MOST_ENTERED {
        let fits = rounded_up(cell * (most / MOST_ENTERED) as f32);
        return Err(WettingError::TooManyCells { cell, fits });
    }
    fn flat([a, b, c]: [DVec3; 3]) -> bool {
        (b - a).cross(c - a).length_squared() == 0.0
    }
    let lists = mesh.triangles.par_iter().map(|own| {
        let corners = own.corners.map(|corner| places[corner as usize]);
        let mut found = Vec::new();
        if !flat(corners) {
            entered(corners, &mut found);
            found.sort_unstable();
        }
        found
    });
    let lists: Vec<Vec<[i32; 3]>> = lists.collect();
    let mut starts = vec![0];
    let mut count = 0;
    for list in &lists {
        count += list.len() as u32;
        starts.push(count);
    }
    Ok((starts, lists.concat()))
}

struct SharedEdge {
    triangles: [u32; 2],
    line: [u32; 2],
}

impl SharedEdge {
    fn is_inside(&self, pieces: &Pieces) -> bool {
        self.triangles.iter().all(|&triangle| pieces.entries_of(triangle as usize).len() == 1)
    }
}

/// The common edges of all pairs of triangles with area. Vertices at one place are the same.
fn shared_edges(mesh: &Mesh, pieces: &Pieces) -> Vec<SharedEdge> {
    // Adding 0 turns -0 into 0.
    let mut order: Vec<([u32; 3], u32)> = (0..mesh.positions.len() as u32)
        .map(|vertex| {
            (mesh.positions[vertex as usize].map(|value| (value + 0.0).to_bits()), vertex)
        })
        .collect();
    order.par_sort_unstable();
    let mut first = vec![0; order.len()];
    for same in order.chunk_by(|a, b| a.0 == b.0) {
        same.iter().for_each(|&(_, vertex)| first[vertex as usize] = same[0].1);
    }
    let mut edges = Vec::with_capacity(3 * mesh.triangles.len());
    for (triangle, own) in (0_u32..).zip(&mesh.triangles) {
        if !pieces.entries_of(triangle as usize).is_empty() {
            let [a, b, c] = own.corners.map(|corner| first[corner as usize]);
            let ends = [(a, b), (b, c), (c, a)];
            edges.extend(ends.map(|(from, to): (u32, u32)| (from.min(to), from.max(to), triangle)));
        }
    }
    edges.par_sort_unstable();
    let mut shared = Vec::with_capacity(edges.len() / 2);
    for same in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        for (index, &(from, to, one)) in same.iter().enumerate() {
            let others = same[index + 1..].iter();
            shared.extend(
                others.map(|other| SharedEdge { triangles: [one, other.2], line: [from, to] }),
            );
        }
    }
    shared
}

/// Whether the line between two places (in widths of a cell) may touch a wall between cells.
fn is_near_wall([a, b]: [DVec3; 2]) -> bool {
    let margin = DVec3::splat(1e-3);
    (a.min(b) - margin).floor() != (a.max(b) + margin).floor()
}

pub(super) fn root_of(roots: &[u32], mut entry: u32) -> u32 {
    while roots[entry as usize] != entry {
        entry = roots[entry as usize];
    }
    entry
}

/// Makes one piece of two entries. Its root is the lowest of them.
pub(super) fn unite(roots: &mut [u32], one: u32, other: u32) {
    let [a, b] = [one, other].map(|entry| root_of(roots, entry));
    let root = a.min(b);
    for end in [one, other] {
        let mut entry = end;
        // This shortens the way for the next search.
        while roots[entry as usize] != entry {
            entry = std::mem::replace(&mut roots[entry as usize], root);
        }
        roots[entry as usize] = root;
    }
}

fn distance(place: Vec3, [a, b, c]: [Vec3; 3]) -> f32 {
    let normal = (b - a).cross(c - a);
    let edges = [(a, b), (b, c), (c, a)];
    if edges.iter().all(|&(from, to)| (to - from).cross(place - from).dot(normal) >= 0.0) {
        return (place - a).dot(normal).abs() / normal.length();
    }
    let [to_first, to_second, to_third] = edges.map(|(from, to): (Vec3, Vec3)| {
        let along = to - from;
        let share = (place - from).dot(along) / along.length_squared().max(f32::MIN_POSITIVE);
        place.distance(from + along * share.clamp(0.0, 1.0))
    });
    to_first.min(to_second).min(to_third)
}

/// The bodies of a model, numbered from 1. Surface is one body if it is connected or touches.
/// Number 0 means any body. Parts too small to take paint have this number.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Bodies {
    /// The body of each cell.
    pub of_cells: Vec<u32>,
    /// The body of each triangle of the mesh.
    pub of_triangles: Vec<u32>,
}

impl Bodies {
    /// The bodies that `pieces` form. `of_cells` has the piece of each cell.
    pub(super) fn of(pieces: &Pieces, of_cells: &[u32]) -> Self {
        let mut roots: Vec<u32> = (0..pieces.keys.len() as u32).collect();
        for &(one, other) in &pieces.pairs {
            unite(&mut roots, one, other);
        }
        let mut numbers = vec![0; roots.len()];
        let mut count = 0;
        for &piece in of_cells {
            let number = &mut numbers[root_of(&roots, piece) as usize];
            if *number == 0 {
                count += 1;
                *number = count;
            }
        }
        Self {
            of_cells: of_cells
                .iter()
                .map(|&piece| numbers[root_of(&roots, piece) as usize])
                .collect(),
            of_triangles: (0..pieces.triangles())
                .map(|triangle| {
                    let first = pieces.of_triangle(triangle).first();
                    first.map_or(0, |&piece| numbers[root_of(&roots, piece) as usize])
                })
                .collect(),
        }
    }
}
