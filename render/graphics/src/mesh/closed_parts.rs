//! Which parts of a mesh are closed.

use glam::DVec3;

use super::model::Mesh;
use super::neighbours::Neighbours;

impl Mesh {
    /// For every triangle whether the connected part of the mesh that it belongs to is watertight
    /// and oriented outwards, as [`Self::is_closed`] tells of a whole mesh.
    ///
    /// # Panics
    /// If a triangle has a vertex that does not exist; [`Mesh::check`] finds that.
    #[must_use]
    pub fn closed_parts(&self) -> Vec<bool> {
        let (welded, count) = self.weld();
        let corners = self.triangles.iter().map(|triangle| triangle.corners);
        let triangles: Vec<[u32; 3]> =
            corners.map(|corners| corners.map(|corner| welded[corner as usize])).collect();
        let (part_of, parts) = parts(&Neighbours::of_triangles(triangles.iter().copied(), count));
        let mut open = vec![false; parts];
        let mut edges: Vec<[u32; 3]> = Vec::with_capacity(3 * triangles.len());
        for [a, b, c] in &triangles {
            // Lower place first; the third entry is the direction of travel.
            let edge = |from: u32, to: u32| [from.min(to), from.max(to), u32::from(from < to)];
            let all = [edge(*a, *b), edge(*b, *c), edge(*c, *a)];
            edges.extend(all.into_iter().filter(|edge| edge[0] != edge[1]));
        }
        edges.sort_unstable();
        for edge in edges.chunk_by(|a, b| a[..2] == b[..2]) {
            let onwards = edge.iter().filter(|[.., direction]| *direction == 1).count();
            open[part_of[edge[0][0] as usize] as usize] |= 2 * onwards != edge.len();
        }
        let mut volumes = vec![0.0; parts];
        let place = |corner: u32| DVec3::from(self.positions[corner as usize].map(f64::from));
        let first = self.positions.first().map_or(DVec3::ZERO, |_| place(0));
        for (triangle, places) in self.triangles.iter().zip(&triangles) {
            let [a, b, c] = triangle.corners.map(|corner| place(corner) - first);
            volumes[part_of[places[0] as usize] as usize] += a.cross(b).dot(c);
        }
        let part = |places: &[u32; 3]| part_of[places[0] as usize] as usize;
        triangles.iter().map(part).map(|part| !open[part] && volumes[part] > 0.0).collect()
    }
}

/// The connected part of every place, and the number of parts.
fn parts(neighbours: &Neighbours) -> (Vec<u32>, usize) {
    let mut part_of = vec![u32::MAX; neighbours.count()];
    let mut parts = 0;
    for first in 0..part_of.len() {
        if part_of[first] != u32::MAX {
            continue;
        }
        part_of[first] = parts;
        let mut waiting = vec![first];
        while let Some(place) = waiting.pop() {
            for &next in neighbours.of(place) {
                if std::mem::replace(&mut part_of[next as usize], parts) != parts {
                    waiting.push(next as usize);
                }
            }
        }
        parts += 1;
    }
    (part_of, parts as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::test_shapes::bare;

    #[test]
    fn each_part_is_closed_or_open_for_itself() {
        let sphere = Mesh::sphere(100);
        assert!(sphere.closed_parts().iter().all(|closed| *closed));
        let mut both = sphere.clone();
        let first = both.positions.len() as u32;
        let sheet = bare(&[[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, 0.0]], &[[0, 1, 2]]);
        both.positions.extend(&sheet.positions);
        let mut triangle = sheet.triangles[0];
        triangle.corners = triangle.corners.map(|corner| corner + first);
        both.triangles.push(triangle);
        let closed = both.closed_parts();
        assert!(closed[..closed.len() - 1].iter().all(|closed| *closed));
        assert!(!closed[closed.len() - 1], "a sheet is open");
    }

    #[test]
    fn a_part_with_a_hole_or_inside_out_is_open() {
        let mut holed = Mesh::sphere(100);
        holed.triangles.pop();
        assert!(holed.closed_parts().iter().all(|closed| !closed));
        let mut inside_out = Mesh::sphere(100);
        inside_out.triangles.iter_mut().for_each(|triangle| triangle.corners.swap(0, 1));
        assert!(inside_out.closed_parts().iter().all(|closed| !closed));
        assert!(Mesh::default().closed_parts().is_empty());
    }
}
