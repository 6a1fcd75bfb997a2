//! Places: the distinct positions of a mesh, with one normal each, for what is computed over a
//! surface regardless of seams.

use glam::DVec3;
use rayon::prelude::*;

use super::model::Mesh;
use super::neighbours::Neighbours;

/// Sum of unit normals, relative to that of their weights, below which they cancel out (a sheet
/// with two sides): then one of them is taken.
const LEAST_SUM: f64 = 1e-3;

/// Least and greatest stiffness of an edge: an obtuse triangle would give a negative one, a
/// needle one without limit.
const STIFFNESS: [f64; 2] = [0.05, 5.0];

/// The distinct positions of a mesh.
#[derive(Debug, Clone)]
pub(super) struct Places {
    /// Number of the place of every vertex.
    pub(super) of_vertex: Vec<u32>,
    /// Position of every place.
    pub(super) positions: Vec<DVec3>,
    /// Unit normal of every place.
    pub(super) normals: Vec<DVec3>,
    /// Places of the corners of every triangle that has three distinct ones.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Adjacency along edges.
    pub(super) neighbours: Neighbours,
    /// Stiffness of the edge to each neighbour, see [`Neighbours::slots`].
    pub(super) stiffness: Vec<f64>,
}

impl Places {
    /// The places of a mesh; every normal is averaged `rounds` times with the mean of its
    /// neighbours.
    pub(super) fn of(mesh: &Mesh, rounds: usize) -> Self {
        let (of_vertex, count) = mesh.weld();
        let mut positions = vec![DVec3::ZERO; count];
        for (&place, position) in of_vertex.iter().zip(&mesh.positions) {
            positions[place as usize] = DVec3::from(position.map(f64::from));
        }
        let corners = mesh.triangles.iter().map(|triangle| triangle.corners);
        let triangles = corners.map(|corners| corners.map(|corner| of_vertex[corner as usize]));
        let triangles: Vec<[u32; 3]> =
            triangles.filter(|[a, b, c]| a != b && b != c && c != a).collect();
        let neighbours = Neighbours::of_triangles(triangles.iter().copied(), count);
        let normals = joined_normals(mesh, &of_vertex, &positions);
        let stiffness = stiffness(&triangles, &positions, &neighbours);
        let normals = averaged(normals, &neighbours, &stiffness, rounds);
        Self { of_vertex, positions, normals, triangles, neighbours, stiffness }
    }

    /// Root mean square distance of the surface from its centre, weighted by area (the radius of a
    /// sphere); 0 for a surface without area. Unlike a bounding box it does not change when
    /// the model is turned.
    pub(super) fn radius(&self) -> f64 {
        let corners = self.triangles.iter().map(|corners| {
            let at = corners.map(|corner| self.positions[corner as usize]);
            (at, (at[1] - at[0]).cross(at[2] - at[0]).length())
        });
        let mean = |value: &dyn Fn(DVec3) -> DVec3| {
            let (sum, area) = corners.clone().fold((DVec3::ZERO, 0.0), |(sum, all), (at, area)| {
                (sum + at.map(value).iter().sum::<DVec3>() * (area / 3.0), all + area)
            });
            if area > 0.0 { sum / area } else { DVec3::ZERO }
        };
        let center = mean(&|at| at);
        let squares = mean(&|at| (at - center) * (at - center));
        squares.element_sum().sqrt()
    }
}

/// One unit normal for every place: those of its vertices, each weighted over its triangles by the
/// sine of the angle over the lengths of both edges (Max, "Weights for computing vertex normals
/// from facet normals", 1999), so that neither seams nor the cut into triangles shift it. A vertex
/// without a normal has that of the triangle; a place without triangles has the mean of its
/// vertices' normals, or +y.
fn joined_normals(mesh: &Mesh, of_vertex: &[u32], positions: &[DVec3]) -> Vec<DVec3> {
    let normal_of = |vertex: usize| DVec3::from(mesh.normals[vertex].map(f64::from));
    let mut any = vec![DVec3::ZERO; positions.len()];
    for (vertex, &place) in of_vertex.iter().enumerate() {
        let own = &mut any[place as usize];
        // Opposite normals would cancel out: the first side counts.
        let normal = normal_of(vertex);
        *own += if own.dot(normal) < 0.0 { -normal } else { normal };
    }
    let mut sums = vec![(DVec3::ZERO, 0.0); positions.len()];
    for triangle in &mesh.triangles {
        let places = triangle.corners.map(|corner| of_vertex[corner as usize] as usize);
        let at = places.map(|place| positions[place]);
        let facet = (at[1] - at[0]).cross(at[2] - at[0]).normalize_or_zero();
        for i in 0..3 {
            let [next, last] = [(i + 1) % 3, (i + 2) % 3].map(|other| at[other] - at[i]);
            let weight =
                next.cross(last).length() / (next.length_squared() * last.length_squared());
            if weight.is_finite() {
                let (sum, all) = &mut sums[places[i]];
                *sum += weight * normal_of(triangle.corners[i] as usize).normalize_or(facet);
                *all += weight;
            }
        }
    }
    let pairs = sums.par_iter().zip(&any);
    let joined = pairs.map(|(&(sum, all), any)| {
        let cancelled = sum.length() <= LEAST_SUM * all;
        if cancelled { any.normalize_or(DVec3::Y) } else { sum.normalize_or(DVec3::Y) }
    });
    joined.collect()
}

/// Stiffness of the edges from all places to all neighbours: half the sum of the cotangents of the
/// angles that face the edge (Pinkall and Polthier, "Computing discrete minimal surfaces and their
/// conjugates", 1993), within [`STIFFNESS`]. With it sums over edges do not depend on the cut into
/// triangles.
fn stiffness(triangles: &[[u32; 3]], positions: &[DVec3], neighbours: &Neighbours) -> Vec<f64> {
    let mut sums = vec![0.0; neighbours.slot_count()];
    for corners in triangles {
        let at = corners.map(|corner| positions[corner as usize]);
        for i in 0..3 {
            let [next, last] = [(i + 1) % 3, (i + 2) % 3];
            let to_next = at[next] - at[i];
            let to_last = at[last] - at[i];
            let cotangent = to_next.dot(to_last) / to_next.cross(to_last).length();
            if !cotangent.is_finite() {
                continue;
            }
            for [from, to] in [[next, last], [last, next]] {
                if let Some(slot) = neighbours.slot(corners[from], corners[to]) {
                    sums[slot] += 0.5 * cotangent;
                }
            }
        }
    }
    sums.iter_mut().for_each(|sum| *sum = sum.clamp(STIFFNESS[0], STIFFNESS[1]));
    sums
}

/// Unit normals after rounds of averaging each, half and half, with the mean of its neighbours,
/// weighted by stiffness: a diagonal or an open edge does not pull them to one side.
fn averaged(
    mut normals: Vec<DVec3>,
    neighbours: &Neighbours,
    stiffness: &[f64],
    rounds: usize,
) -> Vec<DVec3> {
    for _ in 0..rounds {
        let places = normals.par_iter().with_min_len(1 << 9).enumerate();
        let next = places.map(|(place, &own)| {
            let around = neighbours.of(place).iter().zip(&stiffness[neighbours.slots(place)]);
            let sum: DVec3 = around.map(|(&to, &held)| held * (own + normals[to as usize])).sum();
            // Opposite normals cancel out: keep the old one.
            sum.try_normalize().unwrap_or(own)
        });
        normals = next.collect();
    }
    normals
}
