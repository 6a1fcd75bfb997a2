//! Features placed on a mesh at random.
//!
//! Every patch has one feature at a uniformly distributed point. Its priority is the
//! lowest density (features per unit of area) at which it is drawn. The priority lies
//! between the density at which the patch has one feature and the density at which the
//! part that it lies on has one. So everywhere on the mesh, however it is divided into
//! triangles, the features up to a priority have exactly that density. Below single faces
//! the tree continues with halves of triangles, made on demand.

use std::sync::Arc;

use glam::Vec3;
use rayon::prelude::*;

use super::hierarchy::{Face, Hierarchy, point_in};
use super::random::Seed;

/// Largest number of patches that one thread selects from at a time.
const SUBTREE_PATCHES: usize = 4096;

/// A point on the mesh that carries one bump of noise or one stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feature {
    /// Seed of the feature's own random numbers, the same at every visit.
    pub seed: u64,
    /// Index of the triangle of the mesh that it lies on.
    pub face: u32,
    /// Position in the unit of the model.
    pub position: Vec3,
    /// Unit normal of the triangle.
    pub normal: Vec3,
    /// Lowest density at which the feature is drawn, in features per unit of area.
    pub priority: f32,
}

/// Features placed at random over a mesh.
#[derive(Debug, Clone)]
pub struct Features {
    pub(super) hierarchy: Arc<Hierarchy>,
    pub(super) seed: Seed,
    /// The feature of each patch, then one more of the whole mesh.
    pub(super) of_patches: Vec<Feature>,
    /// Roots of the largest subtrees of up to [`SUBTREE_PATCHES`] patches; one thread
    /// selects from each.
    pub(super) subtrees: Vec<usize>,
    /// All patches above those subtrees, then the index of the whole mesh's feature.
    pub(super) above: Vec<usize>,
}

/// A uniform number between `low` and `high`.
fn uniform(low: f64, high: f64, seed: Seed) -> f32 {
    (low + (high - low) * f64::from(seed.unit(3))) as f32
}

/// A triangle that is halved on demand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Half {
    pub(super) corners: [Vec3; 3],
    seed: Seed,
    pub(super) depth: u32,
}

impl Half {
    pub(super) fn whole(face: &Face, seed: Seed) -> Self {
        Self { corners: face.corners, seed: seed.child(u64::from(face.number)), depth: 0 }
    }

    /// Divides the triangle at the middle of its longest edge.
    pub(super) fn halves(self) -> [Self; 2] {
        let [a, b, c] = self.corners;
        let edges = [a.distance_squared(b), b.distance_squared(c), c.distance_squared(a)];
        let [a, b, c] = match edges {
            [ab, bc, ca] if ab >= bc && ab >= ca => [a, b, c],
            [_, bc, ca] if bc >= ca => [b, c, a],
            _ => [c, a, b],
        };
        let middle = (a + b) / 2.0;
        let half = |corners, number: u64| Self {
            corners,
            seed: self.seed.child(8 + number),
            depth: self.depth + 1,
        };
        [half([a, middle, c], 0), half([middle, b, c], 1)]
    }

    /// The feature of this part, of `area`, of a face.
    pub(super) fn feature(self, halves: &[Self; 2], face: &Face, area: f64) -> Feature {
        let seed = self.seed;
        let half = &halves[usize::from(seed.unit(0) < 0.5)];
        Feature {
            seed: seed.0,
            face: face.number,
            position: point_in(half.corners, seed.unit(1), seed.unit(2)),
            normal: face.normal,
            priority: uniform(1.0 / area, 2.0 / area, seed),
        }
    }
}

impl Feature {
    /// A uniform number in 0..1; each `number` gives an independent one. Numbers below 16 place
    /// features.
    #[must_use]
    pub fn unit(&self, number: u64) -> f32 {
        Seed(self.seed).unit(number)
    }
}

impl Features {
    /// Places features at random. The same mesh and seed give the same features.
    #[must_use]
    pub fn new(hierarchy: Arc<Hierarchy>, seed: u64) -> Self {
        let seed = Seed(seed).child(0);
        let patches = &hierarchy.patches;
        let of_patch = |patch: usize| {
            let own = &patches[patch];
            let seed = seed.child(patch as u64);
            let Some(parts) = hierarchy.parts(patch) else {
                let face = &hierarchy.faces[own.faces.start];
                let half = Half::whole(face, seed);
                return half.feature(&half.halves(), face, face.area);
            };
            // A part is chosen with the other part's share of the area as probability: the
            // smaller part gets its next feature only at a higher density.
            let chosen = usize::from(f64::from(seed.unit(5)) * own.area < patches[parts[0]].area);
            let part = parts[chosen];
            let (position, face) = hierarchy.point_on(part, seed);
            let priority = uniform(1.0 / own.area, 1.0 / patches[part].area, seed);
            Feature { seed: seed.0, face: face.number, position, normal: face.normal, priority }
        };
        let mut of_patches: Vec<Feature> =
            (0..patches.len()).into_par_iter().map(of_patch).collect();
        if let Some(whole) = patches.first() {
            let seed = seed.child(patches.len() as u64);
            let (position, face) = hierarchy.point_on(0, seed);
            let priority = uniform(0.0, 1.0 / whole.area, seed);
            of_patches.push(Feature {
                seed: seed.0,
                face: face.number,
                position,
                normal: face.normal,
                priority,
            });
        }
        let mut subtrees = Vec::new();
        let mut above = Vec::new();
        let mut patch = 0;
        while patch < patches.len() {
            let small = patches[patch].end - patch <= SUBTREE_PATCHES;
            if small { &mut subtrees } else { &mut above }.push(patch);
            patch = if small { patches[patch].end } else { patch + 1 };
        }
        above.extend((!patches.is_empty()).then_some(patches.len()));
        Self { hierarchy, seed, of_patches, subtrees, above }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    fn features(mesh: &Mesh) -> Features {
        Features::new(Arc::new(Hierarchy::new(mesh)), 7)
    }

    /// Number of features below this priority, and area, for the halves x <= 0 and x > 0.
    fn counts(features: &Features, priority: f32) -> [[f64; 2]; 2] {
        let mut found = [[0.0; 2]; 2];
        for face in &features.hierarchy.faces {
            let side = usize::from(face.corners.iter().map(|at| at.x).sum::<f32>() > 0.0);
            found[side][1] += face.area;
        }
        for feature in features.of_patches.iter().filter(|own| own.priority < priority) {
            found[usize::from(feature.position.x > 0.0)][0] += 1.0;
        }
        found
    }

    #[test]
    fn the_density_of_features_up_to_a_priority_is_that_priority_everywhere() {
        for mesh in [Mesh::sphere(3000), Mesh::torus_knot(3000)] {
            let features = features(&mesh);
            for priority in [3.0, 10.0, 30.0] {
                for [count, area] in counts(&features, priority) {
                    let wanted = area * f64::from(priority);
                    let error = (count - wanted).abs();
                    assert!(error < 2.0 * wanted.sqrt(), "{priority}: {count}, {wanted}");
                }
            }
        }
    }

    #[test]
    fn unequal_parts_have_features_in_proportion_to_their_area() {
        // Two small triangles beside one of fifteen times their area.
        let mut mesh = Mesh::sphere(20);
        mesh.triangles.truncate(3);
        let triangle = |x: f32, size: f32| [[x, 0.0, 0.0], [x + size, 0.0, 0.0], [x, size, 0.0]];
        let corners = [triangle(-4.0, 1.0), triangle(-2.0, 1.0), triangle(1.0, 15f32.sqrt())];
        mesh.positions = corners.concat();
        for (triangle, first) in mesh.triangles.iter_mut().zip([0, 3, 6]) {
            triangle.corners = [first, first + 1, first + 2];
        }
        let hierarchy = Arc::new(Hierarchy::new(&mesh));
        let placed: Vec<Features> =
            (0..3000).map(|seed| Features::new(Arc::clone(&hierarchy), seed)).collect();
        for priority in [0.1, 0.5, 1.5] {
            let all = placed.iter().flat_map(|features| &features.of_patches);
            let small = all.filter(|own| own.position.x < 0.0 && own.priority < priority).count();
            let mean = small as f32 / placed.len() as f32;
            // The two small ones together have an area of 1.
            assert!((mean / priority - 1.0).abs() < 0.15, "{priority}: {mean}");
        }
    }
}
