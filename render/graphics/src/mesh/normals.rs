//! Vertex normals: computed from the adjacent triangles, and smoothed.

use glam::Vec3;
use rayon::prelude::*;

use super::model::Mesh;
use super::neighbours::Neighbours;

impl Mesh {
    /// Computes a normal for every vertex from the adjacent triangles, weighted by the angle
    /// at the vertex (Thuermer and Wuethrich, "Computing vertex normals from polygonal
    /// facets", 1998). Vertices with the same position get the same normal; a vertex without
    /// triangles gets +y.
    #[must_use]
    pub fn vertex_normals(&self) -> Vec<[f32; 3]> {
        let (welded, count) = self.weld();
        let mut sums = vec![Vec3::ZERO; count];
        for triangle in &self.triangles {
            let at = triangle.corners.map(|corner| Vec3::from(self.positions[corner as usize]));
            let Some(normal) = (at[1] - at[0]).cross(at[2] - at[0]).try_normalize() else {
                continue;
            };
            for i in 0..3 {
                let [here, next, last] = [at[i], at[(i + 1) % 3], at[(i + 2) % 3]];
                let vertex = welded[triangle.corners[i] as usize] as usize;
                sums[vertex] += normal * (next - here).angle_between(last - here);
            }
        }
        let normals: Vec<[f32; 3]> =
            sums.iter().map(|sum| sum.try_normalize().unwrap_or(Vec3::Y).into()).collect();
        welded.iter().map(|&vertex| normals[vertex as usize]).collect()
    }

    /// Normals after `rounds` rounds of averaging each with its neighbours along edges
    /// (Bousseau, Kaplan, Thollot and Sillion 2006, section 3.3). This simplifies shading
    /// while the silhouette stays. Vertices with the same position count as one, so texture
    /// seams do not show. 0 rounds return the normals unchanged.
    #[must_use]
    pub fn smoothed_normals(&self, rounds: usize) -> Vec<[f32; 3]> {
        if rounds == 0 {
            return self.normals.clone();
        }
        let (welded, count) = self.weld();
        let triangles = self
            .triangles
            .iter()
            .map(|triangle| triangle.corners.map(|corner: u32| welded[corner as usize]));
        let neighbours = Neighbours::of_triangles(triangles, count);
        let mut normals = vec![Vec3::ZERO; count];
        for (&vertex, &normal) in welded.iter().zip(&self.normals) {
            normals[vertex as usize] += Vec3::from(normal);
        }
        normals.par_iter_mut().for_each(|normal| *normal = normal.normalize_or_zero());
        let mut next = normals.clone();
        for _ in 0..rounds {
            next.par_iter_mut().with_min_len(1 << 10).enumerate().for_each(|(vertex, next)| {
                let around = neighbours.of(vertex).iter();
                let sum: Vec3 = around.map(|&other| normals[other as usize]).sum();
                // Opposite normals cancel out: keep the old one.
                *next = (normals[vertex] + sum).try_normalize().unwrap_or(normals[vertex]);
            });
            std::mem::swap(&mut normals, &mut next);
        }
        welded.iter().map(|&vertex| normals[vertex as usize].into()).collect()
    }
}
