//! Vertices at one place taken as one: what a mesh is like apart from the seams of
//! its textures.

use rayon::prelude::*;

use super::model::Mesh;

impl Mesh {
    /// For every vertex a number that those at the same place, and only they, share;
    /// from 0 on without gaps. And how many places there are.
    pub(super) fn places(&self) -> (Vec<u32>, usize) {
        // Adding 0 makes -0 the same as 0.
        let bits = |at: u32| self.positions[at as usize].map(|value| (value + 0.0).to_bits());
        let mut order: Vec<u32> = (0..self.positions.len() as u32).collect();
        order.par_sort_unstable_by_key(|&at| (bits(at), at));
        let mut places = vec![0; order.len()];
        let mut count = 0;
        for (i, &at) in order.iter().enumerate() {
            count += u32::from(i > 0 && bits(order[i - 1]) != bits(at));
            places[at as usize] = count;
        }
        let count = if order.is_empty() { 0 } else { count as usize + 1 };
        (places, count)
    }

    /// Whether its surface encloses space without a hole: every edge belongs to as
    /// many triangles in one direction as in the other, and the outside is outside.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let (places, _) = self.places();
        let mut edges: Vec<[u32; 3]> = Vec::with_capacity(3 * self.triangles.len());
        for triangle in &self.triangles {
            let [a, b, c] = triangle.corners.map(|corner| places[corner as usize]);
            // The lower place first; the third is the direction.
            let edge = |from: u32, to: u32| [from.min(to), from.max(to), u32::from(from < to)];
            edges.extend([edge(a, b), edge(b, c), edge(c, a)].into_iter().filter(|e| e[0] != e[1]));
        }
        edges.par_sort_unstable();
        let balanced = edges.chunk_by(|a, b| a[..2] == b[..2]).all(|edge| {
            2 * edge.iter().filter(|[.., direction]| *direction == 1).count() == edge.len()
        });
        balanced && self.volume() > 0.0
    }

    /// Six times what it encloses; negative if it is inside out.
    fn volume(&self) -> f64 {
        let first = self.positions.first().copied().unwrap_or_default().map(f64::from);
        let volumes = self.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.corners.map(|corner| {
                let place = self.positions[corner as usize];
                [0, 1, 2].map(|axis| f64::from(place[axis]) - first[axis])
            });
            let [x, y, z] =
                [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
            x * c[0] + y * c[1] + z * c[2]
        });
        volumes.sum()
    }
}
