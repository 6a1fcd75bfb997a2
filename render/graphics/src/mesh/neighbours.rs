//! Adjacency of welded vertices along the edges of triangles.

use std::ops::Range;

use rayon::prelude::*;

/// The neighbours of every welded vertex, each list in ascending order.
#[derive(Debug, Clone)]
pub(super) struct Neighbours {
    /// Index into `others` at which each vertex's neighbours start.
    starts: Vec<u32>,
    others: Vec<u32>,
}

impl Neighbours {
    /// Joins the corners of every triangle; the corners are numbers below `count`.
    pub(super) fn of_triangles(triangles: impl Iterator<Item = [u32; 3]>, count: usize) -> Self {
        let mut edges: Vec<[u32; 2]> = Vec::with_capacity(6 * triangles.size_hint().0);
        for [a, b, c] in triangles {
            edges.extend([[a, b], [b, a], [b, c], [c, b], [c, a], [a, c]]);
        }
        edges.par_sort_unstable();
        edges.dedup();
        edges.retain(|[from, to]| from != to);
        let mut starts = vec![0; count + 1];
        edges.iter().for_each(|[from, _]| starts[*from as usize + 1] += 1);
        for vertex in 0..count {
            starts[vertex + 1] += starts[vertex];
        }
        Self { starts, others: edges.iter().map(|[_, to]| *to).collect() }
    }

    /// Number of vertices.
    pub(super) fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The neighbours of a vertex.
    pub(super) fn of(&self, vertex: usize) -> &[u32] {
        &self.others[self.slots(vertex)]
    }

    /// Places of a vertex's neighbours in a list over all neighbours of all vertices.
    pub(super) fn slots(&self, vertex: usize) -> Range<usize> {
        self.starts[vertex] as usize..self.starts[vertex + 1] as usize
    }

    /// Place of the neighbour `to` of the vertex `from` in a list over all neighbours of all
    /// vertices, if they are neighbours.
    pub(super) fn slot(&self, from: u32, to: u32) -> Option<usize> {
        let slots = self.slots(from as usize);
        let found = self.others[slots.clone()].binary_search(&to).ok()?;
        Some(slots.start + found)
    }

    /// Length of a list over all neighbours of all vertices.
    pub(super) fn slot_count(&self) -> usize {
        self.others.len()
    }
}
