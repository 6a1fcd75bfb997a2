//! Normals of vertices: from the triangles around them, and smoothed.

use glam::Vec3;
use rayon::prelude::*;

use super::model::Mesh;

impl Mesh {
    /// The normals of all vertices from the triangles around them, weighted by their
    /// angles there (Thuermer and Wuethrich, "Computing vertex normals from polygonal
    /// facets", 1998); those at one place have one normal. Upwards where there is
    /// no triangle.
    #[must_use]
    pub fn vertex_normals(&self) -> Vec<[f32; 3]> {
        let (places, count) = self.places();
        let mut sums = vec![Vec3::ZERO; count];
        for triangle in &self.triangles {
            let at = triangle.corners.map(|corner| Vec3::from(self.positions[corner as usize]));
            let Some(normal) = (at[1] - at[0]).cross(at[2] - at[0]).try_normalize() else {
                continue;
            };
            for i in 0..3 {
                let [here, next, last] = [at[i], at[(i + 1) % 3], at[(i + 2) % 3]];
                let place = places[triangle.corners[i] as usize] as usize;
                sums[place] += normal * (next - here).angle_between(last - here);
            }
        }
        let normals: Vec<[f32; 3]> =
            sums.iter().map(|sum| sum.try_normalize().unwrap_or(Vec3::Y).into()).collect();
        places.iter().map(|&place| normals[place as usize]).collect()
    }

    /// The normals after `rounds` in which each becomes the mean of itself and those
    /// of its neighbours, as Bousseau, Kaplan, Thollot and Sillion 2006 abstract
    /// shapes (section 3.3): shading grows simple, while places, and with them
    /// silhouettes, stay. Vertices at one place count as one, so textures have no
    /// seams in it; with no round normals stay as they are.
    #[must_use]
    pub fn smoothed_normals(&self, rounds: usize) -> Vec<[f32; 3]> {
        if rounds == 0 {
            return self.normals.clone();
        }
        let (places, count) = self.places();
        let neighbours = Neighbours::new(self, &places, count);
        let mut normals = vec![Vec3::ZERO; count];
        for (&place, &normal) in places.iter().zip(&self.normals) {
            normals[place as usize] += Vec3::from(normal);
        }
        normals.par_iter_mut().for_each(|normal| *normal = normal.normalize_or_zero());
        let mut next = normals.clone();
        for _ in 0..rounds {
            next.par_iter_mut().with_min_len(1 << 10).enumerate().for_each(|(place, next)| {
                let around = neighbours.of(place).iter();
                let sum: Vec3 = around.map(|&other| normals[other as usize]).sum();
                // Those that cancel each other say nothing.
                *next = (normals[place] + sum).try_normalize().unwrap_or(normals[place]);
            });
            std::mem::swap(&mut normals, &mut next);
        }
        places.iter().map(|&place| normals[place as usize].into()).collect()
    }
}

/// Places that share an edge.
struct Neighbours {
    /// Where those of each place start.
    starts: Vec<u32>,
    others: Vec<u32>,
}

impl Neighbours {
    fn new(mesh: &Mesh, places: &[u32], count: usize) -> Self {
        let mut edges: Vec<[u32; 2]> = Vec::with_capacity(6 * mesh.triangles.len());
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.corners.map(|corner| places[corner as usize]);
            edges.extend([[a, b], [b, a], [b, c], [c, b], [c, a], [a, c]]);
        }
        edges.par_sort_unstable();
        edges.dedup();
        edges.retain(|[from, to]| from != to);
        let mut starts = vec![0; count + 1];
        edges.iter().for_each(|[from, _]| starts[*from as usize + 1] += 1);
        for place in 0..count {
            starts[place + 1] += starts[place];
        }
        Self { starts, others: edges.iter().map(|[_, to]| *to).collect() }
    }

    fn of(&self, place: usize) -> &[u32] {
        &self.others[self.starts[place] as usize..self.starts[place + 1] as usize]
    }
}
