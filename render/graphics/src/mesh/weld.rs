//! Welding: vertices with the same position treated as one, so that seams of textures do
//! not matter.

use rayon::prelude::*;

use super::model::Mesh;

impl Mesh {
    /// Numbers the distinct positions from 0. Returns that number for every vertex, and how
    /// many distinct positions there are.
    pub(super) fn weld(&self) -> (Vec<u32>, usize) {
        // Adding 0 turns -0 into 0.
        let bits = |at: u32| self.positions[at as usize].map(|value| (value + 0.0).to_bits());
        let mut order: Vec<u32> = (0..self.positions.len() as u32).collect();
        order.par_sort_unstable_by_key(|&at| (bits(at), at));
        let mut welded = vec![0; order.len()];
        let mut count = 0;
        for (i, &at) in order.iter().enumerate() {
            count += u32::from(i > 0 && bits(order[i - 1]) != bits(at));
            welded[at as usize] = count;
        }
        let count = if order.is_empty() { 0 } else { count as usize + 1 };
        (welded, count)
    }

    /// Whether the surface is watertight and oriented outwards: every edge is used equally
    /// often in both directions, and the enclosed volume is positive.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let (welded, _) = self.weld();
        let mut edges: Vec<[u32; 3]> = Vec::with_capacity(3 * self.triangles.len());
        for triangle in &self.triangles {
            let [a, b, c] = triangle.corners.map(|corner| welded[corner as usize]);
            // Lower vertex first; the third entry is the direction of travel.
            let edge = |from: u32, to: u32| [from.min(to), from.max(to), u32::from(from < to)];
            edges.extend([edge(a, b), edge(b, c), edge(c, a)].into_iter().filter(|e| e[0] != e[1]));
        }
        edges.par_sort_unstable();
        let balanced = edges.chunk_by(|a, b| a[..2] == b[..2]).all(|edge| {
            2 * edge.iter().filter(|[.., direction]| *direction == 1).count() == edge.len()
        });
        balanced && self.volume() > 0.0
    }

    /// Six times the enclosed volume; negative if the mesh is inside out.
    fn volume(&self) -> f64 {
        let first = self.positions.first().copied().unwrap_or_default().map(f64::from);
        let volumes = self.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.corners.map(|corner| {
                let position = self.positions[corner as usize];
                [0, 1, 2].map(|axis| f64::from(position[axis]) - first[axis])
            });
            let [x, y, z] =
                [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
            x * c[0] + y * c[1] + z * c[2]
        });
        volumes.sum()
    }
}
