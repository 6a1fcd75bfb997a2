//! Which cells are joined by surface, so that paint can spill from one to the other.

use glam::DVec3;
use graphics::mesh::Mesh;
use rayon::prelude::*;

use super::entering::{entered, in_cells, touches};
use super::fault::WettingError;
use super::lattice::{Lattice, rounded_up};
use super::samples::SurfaceSamples;

/// Greatest number of cells entered by all triangles together.
const MOST_ENTERED: f64 = (1 << 26) as f64;

/// The cells joined to each cell by surface, in ascending order: a list of links over all cells.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Graph {
    /// Index of the first link of each cell, and at last the number of links.
    pub starts: Vec<u32>,
    /// The cell at the other end of each link.
    pub others: Vec<u32>,
    /// Number of axes along which the two cells of each link differ: 1 across a face, 2 across an
    /// edge, 3 across a corner.
    pub axes: Vec<u8>,
    /// Index of the same link seen from the other end.
    pub back: Vec<u32>,
}

impl Graph {
    /// The links between the cells of `samples`.
    ///
    /// Two cells with a common face, edge or corner are joined if a triangle enters both, or one
    /// of two triangles at a common edge each, where this edge touches both cells; and if steps
    /// through joined faces of the cells between them lead from one to the other. The last rule
    /// makes the links the same for any cut into triangles.
    ///
    /// # Errors
    /// If the triangles enter too many cells.
    pub fn of(mesh: &Mesh, samples: &SurfaceSamples) -> Result<Self, WettingError> {
        let surface = Surface::of(mesh, &samples.lattice)?;
        let coordinates =
            |cell: usize| samples.lattice.coordinates(samples.places[samples.of_cell(cell).start]);
        let cells: Vec<[i32; 3]> = (0..samples.cell_count()).map(coordinates).collect();
        let keys: Vec<u64> = cells.iter().map(|&at| Lattice::key(at)).collect();
        let onwards = |cell: usize| {
            let at = cells[cell];
            let joined = forward_steps().filter_map(|step| {
                let other = keys.binary_search(&Lattice::key(plus(at, step))).ok()?;
                surface.joins(at, step).then_some((cell as u32, other as u32, axes_of(step)))
            });
            joined.collect::<Vec<_>>()
        };
        let onwards: Vec<_> = (0..cells.len()).into_par_iter().flat_map_iter(onwards).collect();
        Ok(Self::of_links(&onwards, cells.len()))
    }

    /// The graph with each of these links in both directions.
    fn of_links(onwards: &[(u32, u32, u8)], count: usize) -> Self {
        let both = |&(from, to, axes): &(u32, u32, u8)| [(from, to, axes), (to, from, axes)];
        let mut links: Vec<(u32, u32, u8)> = onwards.iter().flat_map(both).collect();
        links.par_sort_unstable();
        let mut starts = vec![0; count + 1];
        links.iter().for_each(|&(from, ..)| starts[from as usize + 1] += 1);
        for cell in 0..count {
            starts[cell + 1] += starts[cell];
        }
        let others: Vec<u32> = links.iter().map(|&(_, to, _)| to).collect();
        let back = links.par_iter().map(|&(from, to, _)| {
            let range = starts[to as usize] as usize..starts[to as usize + 1] as usize;
            (range.start + others[range].partition_point(|&other| other < from)) as u32
        });
        let back = back.collect();
        Self { starts, axes: links.iter().map(|link| link.2).collect(), others, back }
    }

    /// Number of cells.
    #[must_use]
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Whether there is no cell.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Indices of the links of a cell.
    #[must_use]
    pub fn links(&self, cell: usize) -> std::ops::Range<usize> {
        self.starts[cell] as usize..self.starts[cell + 1] as usize
    }

    /// The graph without the links of cells that are not kept.
    #[must_use]
    pub fn cut(&self, kept: impl Fn(usize) -> bool) -> Self {
        let from = (0..self.len()).filter(|&cell| kept(cell));
        let onwards = from.flat_map(|cell| self.links(cell).map(move |link| (cell, link)));
        let onwards = onwards.filter_map(|(cell, link)| {
            let other = self.others[link];
            let onwards = other as usize > cell && kept(other as usize);
            onwards.then_some((cell as u32, other, self.axes[link]))
        });
        Self::of_links(&onwards.collect::<Vec<_>>(), self.len())
    }
}

/// Pairs of cells that share a piece of surface, by key, lower key first, in ascending order.
struct Surface {
    pairs: Vec<(u64, u64)>,
}

impl Surface {
    fn of(mesh: &Mesh, lattice: &Lattice) -> Result<Self, WettingError> {
        let places: Vec<DVec3> =
            mesh.positions.iter().map(|&position| in_cells(lattice, position)).collect();
        let corners = |triangle: usize| mesh.triangles[triangle].corners;
        let at = |triangle: usize| corners(triangle).map(|corner| places[corner as usize]);
        let length = |[a, b, c]: [DVec3; 3]| a.distance(b).max(b.distance(c)).max(c.distance(a));
        let most =
            (0..mesh.triangles.len()).map(|triangle| 1.0 + length(at(triangle))).sum::<f64>();
        if most > MOST_ENTERED {
            let cell = lattice.cell;
            let fits = rounded_up(cell * (most / MOST_ENTERED) as f32);
            return Err(WettingError::TooManyCells { cell, fits });
        }
        let flat = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length_squared() == 0.0;
        let lists = (0..mesh.triangles.len()).into_par_iter().map(|triangle| {
            let mut found = Vec::new();
            if !flat(at(triangle)) {
                entered(at(triangle), &mut found);
                found.sort_unstable();
            }
            found
        });
        let cells: Vec<Vec<[i32; 3]>> = lists.collect();
        let mut pairs: Vec<(u64, u64)> =
            cells.par_iter().flat_map_iter(|own| within(own)).collect();
        pairs.extend(across_edges(mesh, &places, &cells));
        pairs.par_sort_unstable();
        pairs.dedup();
        Ok(Self { pairs })
    }

    /// Whether surface leads from the cell `at` to the one at `step` from it.
    fn joins(&self, at: [i32; 3], step: [i32; 3]) -> bool {
        self.shares(at, plus(at, step)) || self.leads(at, step)
    }

    fn shares(&self, a: [i32; 3], b: [i32; 3]) -> bool {
        self.pairs.binary_search(&pair(a, b)).is_ok()
    }

    /// Whether steps along single axes, in any order, lead through cells that share surface.
    fn leads(&self, at: [i32; 3], step: [i32; 3]) -> bool {
        let mut axes = (0..3).filter(|&axis| step[axis] != 0).peekable();
        axes.peek().is_none()
            || axes.any(|axis| {
                let (mut next, mut rest) = (at, step);
                next[axis] += step[axis];
                rest[axis] = 0;
                self.shares(at, next) && self.leads(next, rest)
            })
    }
}

fn pair(a: [i32; 3], b: [i32; 3]) -> (u64, u64) {
    let [a, b] = [a, b].map(Lattice::key);
    (a.min(b), a.max(b))
}

fn plus(at: [i32; 3], step: [i32; 3]) -> [i32; 3] {
    [0, 1, 2].map(|axis| at[axis] + step[axis])
}

fn axes_of(step: [i32; 3]) -> u8 {
    step.iter().map(|value| value.unsigned_abs() as u8).sum()
}

fn adjacent(a: [i32; 3], b: [i32; 3]) -> bool {
    a != b && (0..3).all(|axis| (a[axis] - b[axis]).abs() <= 1)
}

/// One of the two directions to each of the 26 cells around a cell.
fn forward_steps() -> impl Iterator<Item = [i32; 3]> {
    (14..27).map(|i| [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1])
}

/// The pairs of neighbours among the cells of one triangle, which are in ascending order.
fn within(cells: &[[i32; 3]]) -> Vec<(u64, u64)> {
    let mut pairs = Vec::new();
    if cells.len() > 1 {
        for &cell in cells {
            for step in forward_steps() {
                let other = plus(cell, step);
                if cells.binary_search(&other).is_ok() {
                    pairs.push(pair(cell, other));
                }
            }
        }
    }
    pairs
}

/// The pairs of neighbours of which two triangles with a common edge enter one each, where the
/// edge touches both.
fn across_edges(mesh: &Mesh, places: &[DVec3], cells: &[Vec<[i32; 3]>]) -> Vec<(u64, u64)> {
    // Adding 0 turns -0 into 0.
    let bits = |corner: u32| mesh.positions[corner as usize].map(|value| (value + 0.0).to_bits());
    let mut edges = Vec::new();
    for (triangle, (own, found)) in (0_u32..).zip(mesh.triangles.iter().zip(cells)) {
        let [a, b, c] = own.corners;
        for [from, to] in [[a, b], [b, c], [c, a]] {
            if !found.is_empty() && is_near_wall([from, to].map(|corner| places[corner as usize])) {
                let ends = [bits(from), bits(to)];
                edges.push((ends[0].min(ends[1]), ends[0].max(ends[1]), triangle, [from, to]));
            }
        }
    }
    edges.par_sort_unstable();
    let mut pairs = Vec::new();
    for shared in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let line = shared[0].3.map(|corner| places[corner as usize]);
        for (i, one) in shared.iter().enumerate() {
            for other in &shared[i + 1..] {
                let [own, others] = [one, other].map(|edge| &cells[edge.2 as usize]);
                for &a in own.iter().filter(|&&cell| touches(line, cell)) {
                    let near = others.iter().filter(|&&b| adjacent(a, b) && touches(line, b));
                    pairs.extend(near.map(|&b| pair(a, b)));
                }
            }
        }
    }
    pairs
}

/// Whether the line between two places (in widths of a cell) may touch a wall between cells.
fn is_near_wall([a, b]: [DVec3; 2]) -> bool {
    let margin = DVec3::splat(1e-3);
    (a.min(b) - margin).floor() != (a.max(b) + margin).floor()
}
