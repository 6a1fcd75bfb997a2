//! Features of noise placed on a mesh, and the selection that a projection needs.
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
use super::octaves::{FeatureNoise, Octaves};
use super::projection::Projection;
use super::random::Seed;
use super::splat::Splat;

/// Largest number of patches that one thread selects from at a time.
const SUBTREE_PATCHES: usize = 4096;

/// Triangles are halved at most this often; f32 cannot represent smaller ones.
const MAX_HALVINGS: u32 = 40;

/// A point on the mesh that carries one bump of noise.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Feature {
    position: Vec3,
    normal: Vec3,
    /// Lowest density at which the feature is drawn, in features per unit of area.
    priority: f32,
    /// 1 for a bump, -1 for a hollow.
    sign: f32,
}

/// Features placed at random over a mesh.
#[derive(Debug, Clone)]
pub struct Features {
    hierarchy: Arc<Hierarchy>,
    seed: Seed,
    /// The feature of each patch, then one more of the whole mesh.
    of_patches: Vec<Feature>,
    /// Roots of the largest subtrees of up to [`SUBTREE_PATCHES`] patches; one thread
    /// selects from each.
    subtrees: Vec<usize>,
    /// All patches above those subtrees, then the index of the whole mesh's feature.
    above: Vec<usize>,
}

fn sign(seed: Seed) -> f32 {
    if seed.unit(4) < 0.5 { 1.0 } else { -1.0 }
}

/// A uniform number between `low` and `high`.
fn uniform(low: f64, high: f64, seed: Seed) -> f32 {
    (low + (high - low) * f64::from(seed.unit(3))) as f32
}

/// A triangle that is halved on demand.
#[derive(Debug, Clone, Copy)]
struct Half {
    corners: [Vec3; 3],
    seed: Seed,
    depth: u32,
}

impl Half {
    fn whole(face: &Face, seed: Seed) -> Self {
        Self { corners: face.corners, seed: seed.child(u64::from(face.number)), depth: 0 }
    }

    /// Divides the triangle at the middle of its longest edge.
    fn halves(self) -> [Self; 2] {
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

    fn feature(self, halves: &[Self; 2], normal: Vec3, area: f64) -> Feature {
        let seed = self.seed;
        let half = &halves[usize::from(seed.unit(0) < 0.5)];
        Feature {
            position: point_in(half.corners, seed.unit(1), seed.unit(2)),
            normal,
            priority: uniform(1.0 / area, 2.0 / area, seed),
            sign: sign(seed),
        }
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
                return half.feature(&half.halves(), face.normal, face.area);
            };
            // A part is chosen with the other part's share of the area as probability: the
            // smaller part gets its next feature only at a higher density.
            let chosen = usize::from(f64::from(seed.unit(5)) * own.area < patches[parts[0]].area);
            let part = parts[chosen];
            let (position, face) = hierarchy.point_on(part, seed);
            let priority = uniform(1.0 / own.area, 1.0 / patches[part].area, seed);
            Feature { position, normal: face.normal, priority, sign: sign(seed) }
        };
        let mut of_patches: Vec<Feature> =
            (0..patches.len()).into_par_iter().map(of_patch).collect();
        if let Some(whole) = patches.first() {
            let seed = seed.child(patches.len() as u64);
            let (position, face) = hierarchy.point_on(0, seed);
            let priority = uniform(0.0, 1.0 / whole.area, seed);
            of_patches.push(Feature { position, normal: face.normal, priority, sign: sign(seed) });
        }
        let (mut subtrees, mut above, mut patch) = (Vec::new(), Vec::new(), 0);
        while patch < patches.len() {
            let small = patches[patch].end - patch <= SUBTREE_PATCHES;
            if small { &mut subtrees } else { &mut above }.push(patch);
            patch = if small { patches[patch].end } else { patch + 1 };
        }
        above.extend((!patches.is_empty()).then_some(patches.len()));
        Self { hierarchy, seed, of_patches, subtrees, above }
    }

    /// The features of `noise` to draw in a projection, hidden ones included. Their order
    /// does not depend on the projection.
    #[must_use]
    pub fn splats(&self, projection: &Projection, noise: FeatureNoise) -> Vec<Splat> {
        let octaves = Octaves::new(noise);
        let forward = (projection.camera.target - projection.camera.eye).normalize_or_zero();
        let selection =
            Selection { features: self, projection, forward, end: octaves.end(), octaves };
        let subtrees = self.subtrees.par_iter().map(|&subtree| {
            let mut splats = Vec::new();
            selection.select(subtree, &mut splats);
            splats
        });
        let mut splats = Vec::new();
        for &patch in &self.above {
            selection.draw(&self.of_patches[patch], &mut splats);
        }
        let subtrees: Vec<_> = subtrees.collect();
        splats.reserve(subtrees.iter().map(Vec::len).sum());
        subtrees.iter().for_each(|subtree| splats.extend_from_slice(subtree));
        splats
    }
}

/// Selects the features that one projection needs.
struct Selection<'a> {
    features: &'a Features,
    projection: &'a Projection,
    /// Viewing direction, of length 1.
    forward: Vec3,
    octaves: Octaves,
    /// Features of this rank and above are not drawn.
    end: f32,
}

impl Selection<'_> {
    /// The highest priority that is drawn within a sphere. `None` if the sphere lies
    /// outside the picture.
    fn needed(&self, center: Vec3, radius: f32) -> Option<f32> {
        let projection = self.projection;
        let to = center - projection.camera.eye;
        let (along, towards) = (to.dot(self.forward), to.length() + radius);
        if along + radius < projection.camera.near || along - radius > projection.camera.far {
            return None;
        }
        let nearest = (along - radius).max(projection.camera.near);
        if along - radius > projection.camera.near
            && let Some(at) = projection.project(center)
        {
            // Off the viewing axis a sphere projects to more than its radius.
            let margin = projection.focal_px * radius * towards / (nearest * nearest)
                + self.octaves.largest_px();
            let inside = |at: f32, size: usize| at > -margin && at < size as f32 + margin;
            if !inside(at.x, projection.width) || !inside(at.y, projection.height) {
                return None;
            }
        }
        Some(self.end * projection.focal_px * projection.focal_px * towards / nearest.powi(3))
    }

    fn select(&self, subtree: usize, splats: &mut Vec<Splat>) {
        let hierarchy = &self.features.hierarchy;
        let end = hierarchy.patches[subtree].end;
        let mut index = subtree;
        while index < end {
            let patch = &hierarchy.patches[index];
            let needed = self.needed(patch.center, patch.radius);
            if needed.is_none_or(|needed| f64::from(needed) * patch.area <= 1.0) {
                index = patch.end;
                continue;
            }
            self.draw(&self.features.of_patches[index], splats);
            if patch.faces.len() == 1 {
                let face = &hierarchy.faces[patch.faces.start];
                let halves = Half::whole(face, self.features.seed.child(index as u64)).halves();
                for half in halves {
                    self.halve(half, face.normal, face.area / 2.0, splats);
                }
            }
            index += 1;
        }
    }

    fn halve(&self, half: Half, normal: Vec3, area: f64, splats: &mut Vec<Splat>) {
        let [a, b, c] = half.corners;
        let center = (a + b + c) / 3.0;
        let radius = [a, b, c].map(|at| at.distance_squared(center)).into_iter();
        let radius = radius.fold(0.0, f32::max).sqrt();
        let needed = self.needed(center, radius);
        if half.depth > MAX_HALVINGS || needed.is_none_or(|needed| f64::from(needed) * area <= 1.0)
        {
            return;
        }
        let halves = half.halves();
        self.draw(&half.feature(&halves, normal, area), splats);
        for half in halves {
            self.halve(half, normal, area / 2.0, splats);
        }
    }

    fn draw(&self, feature: &Feature, splats: &mut Vec<Splat>) {
        let projection = self.projection;
        let Some(at) = projection.project(feature.position) else { return };
        let towards = feature.normal.dot(feature.position - projection.camera.eye);
        // Pixels that one unit of area covers here.
        let focal = projection.focal_px / at.distance;
        let pixels = focal * focal * towards.abs() / at.distance;
        let rank = feature.priority / pixels;
        // The comparison is false for features seen edge-on, whose rank is NaN or infinite.
        if !(rank < self.end && at.depth <= 1.0) {
            return;
        }
        let [slope_x, slope_y] = projection.slope(feature.normal, towards);
        let near = |at: f32, size: usize, r: f32| at > -r && at < size as f32 + r;
        for [radius, amplitude] in self.octaves.parts(rank) {
            if !near(at.x, projection.width, radius) || !near(at.y, projection.height, radius) {
                continue;
            }
            // Allows for one pixel, and for the curvature of the surface within the radius.
            let slack = projection.depth_scale() * (1.0 + radius / 4.0)
                / (projection.focal_px * at.distance);
            splats.push(Splat {
                x: at.x,
                y: at.y,
                narrowness: 1.0 / radius,
                amplitude: amplitude * feature.sign,
                depth: at.depth,
                slope_x,
                slope_y,
                tightness: 1.0 / slack,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
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

    #[test]
    fn the_density_on_the_screen_does_not_depend_on_distance_or_triangles() {
        let noise = FeatureNoise { largest_px: 16.0, octaves: 2, persistence: 0.5, coverage: 4.0 };
        let mut densities = Vec::new();
        for (triangles, distance) in [(40_000, 2.0), (400, 2.0), (40_000, 9.0), (400, 0.3)] {
            let features = features(&Mesh::sphere(triangles));
            let camera = Camera {
                eye: Vec3::Z * (1.0 + distance),
                target: Vec3::ZERO,
                up: Vec3::Y,
                field_of_view_deg: 5.0,
                near: distance / 2.0,
                far: distance + 1.0,
            };
            // The far plane cuts off the farther half of the sphere.
            let projection = Projection::new(&camera, 400, 400);
            let splats = features.splats(&projection, noise);
            let inside = splats.iter().filter(|splat| {
                splat.narrowness < 1.0 / 12.0
                    && (0.0..400.0).contains(&splat.x)
                    && (0.0..400.0).contains(&splat.y)
            });
            let silhouette =
                (projection.focal_px / ((1.0 + distance).powi(2) - 1.0).sqrt()).min(226.0);
            let area = (std::f32::consts::PI * silhouette * silhouette).min(160_000.0);
            densities.push(inside.count() as f32 * 256.0 / area);
        }
        let mean = densities.iter().sum::<f32>() / densities.len() as f32;
        let even = densities.iter().all(|density| (density / mean - 1.0).abs() < 0.12);
        assert!(even, "{densities:?}");
    }

    #[test]
    fn an_empty_mesh_has_no_features() {
        let features = features(&Mesh::default());
        let camera = Camera::framing(Mesh::sphere(20).bounds(), 0.0, 0.0, 30.0);
        assert_eq!(features.splats(&Projection::new(&camera, 20, 20), FeatureNoise::FLOW), []);
    }
}
