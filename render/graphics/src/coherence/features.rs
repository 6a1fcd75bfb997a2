//! Features of noise on a mesh, and those that a sight needs.
//!
//! Every patch has one feature, at an even place on it. Its priority, the number
//! of features per unit of area at which it is needed, lies between those at which
//! its patch has one feature and at which the part it is on has: in every part of
//! the mesh, however it was divided, there are then as many features of at least a
//! priority as that priority says. Below the faces this goes on with halves of
//! triangles, without end and only where a sight needs it.

use std::sync::Arc;

use glam::Vec3;
use rayon::prelude::*;

use super::hierarchy::{Face, Hierarchy, place_in};
use super::octaves::{FeatureNoise, Octaves};
use super::random::Seed;
use super::sight::Sight;
use super::splat::Splat;

/// Patches that one thread goes through at a time.
const SHARE: usize = 4096;

/// Triangles are not halved more often: f32 tells no smaller ones apart.
const DEEPEST: u32 = 40;

#[derive(Debug, Clone, Copy, PartialEq)]
struct Feature {
    place: Vec3,
    normal: Vec3,
    /// Features per unit of area.
    priority: f32,
    /// 1 or -1.
    sign: f32,
}

/// Features strewn over a mesh by a seed.
#[derive(Debug, Clone)]
pub struct Features {
    hierarchy: Arc<Hierarchy>,
    seed: Seed,
    /// One for each patch, then one of the whole mesh.
    of_patches: Vec<Feature>,
    /// Patches that are gone through in one piece, as far as the next one's begin
    /// and their ends; then all that have them inside.
    pieces: Vec<usize>,
    above: Vec<usize>,
}

fn sign(seed: Seed) -> f32 {
    if seed.unit(4) < 0.5 { 1.0 } else { -1.0 }
}

/// Even between both.
fn between(low: f64, high: f64, seed: Seed) -> f32 {
    (low + (high - low) * f64::from(seed.unit(3))) as f32
}

/// A triangle and its halves.
#[derive(Debug, Clone, Copy)]
struct Half {
    corners: [Vec3; 3],
    seed: Seed,
    depth: u32,
}

impl Half {
    fn of(face: &Face, seed: Seed) -> Self {
        Self { corners: face.corners, seed: seed.below(u64::from(face.number)), depth: 0 }
    }

    /// Cut across its longest edge.
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
            seed: self.seed.below(8 + number),
            depth: self.depth + 1,
        };
        [half([a, middle, c], 0), half([middle, b, c], 1)]
    }

    fn feature(self, halves: &[Self; 2], normal: Vec3, area: f64) -> Feature {
        let seed = self.seed;
        let half = &halves[usize::from(seed.unit(0) < 0.5)];
        Feature {
            place: place_in(half.corners, seed.unit(1), seed.unit(2)),
            normal,
            priority: between(1.0 / area, 2.0 / area, seed),
            sign: sign(seed),
        }
    }
}

impl Features {
    /// Strews features by `seed`: the same mesh and seed give the same ones.
    #[must_use]
    pub fn new(hierarchy: Arc<Hierarchy>, seed: u64) -> Self {
        let seed = Seed(seed).below(0);
        let patches = &hierarchy.patches;
        let of_patch = |patch: usize| {
            let own = &patches[patch];
            let seed = seed.below(patch as u64);
            let Some(parts) = hierarchy.parts(patch) else {
                let face = &hierarchy.faces[own.faces.start];
                let half = Half::of(face, seed);
                return half.feature(&half.halves(), face.normal, face.area);
            };
            // The smaller part needs its next feature later, by which this one is the
            // likelier to be on it.
            let larger = usize::from(f64::from(seed.unit(5)) * own.area < patches[parts[0]].area);
            let part = parts[larger];
            let (place, face) = hierarchy.place_on(part, seed);
            let priority = between(1.0 / own.area, 1.0 / patches[part].area, seed);
            Feature { place, normal: face.normal, priority, sign: sign(seed) }
        };
        let mut of_patches: Vec<Feature> =
            (0..patches.len()).into_par_iter().map(of_patch).collect();
        if let Some(whole) = patches.first() {
            let seed = seed.below(patches.len() as u64);
            let (place, face) = hierarchy.place_on(0, seed);
            let priority = between(0.0, 1.0 / whole.area, seed);
            of_patches.push(Feature { place, normal: face.normal, priority, sign: sign(seed) });
        }
        let (mut pieces, mut above, mut patch) = (Vec::new(), Vec::new(), 0);
        while patch < patches.len() {
            let small = patches[patch].end - patch <= SHARE;
            if small { &mut pieces } else { &mut above }.push(patch);
            patch = if small { patches[patch].end } else { patch + 1 };
        }
        above.extend((!patches.is_empty()).then_some(patches.len()));
        Self { hierarchy, seed, of_patches, pieces, above }
    }

    /// What is to be drawn of `noise` in a sight, in an order that does not depend
    /// on it. What is hidden is among it.
    #[must_use]
    pub fn splats(&self, sight: &Sight, noise: FeatureNoise) -> Vec<Splat> {
        let octaves = Octaves::new(noise);
        let forward = (sight.camera.target - sight.camera.eye).normalize_or_zero();
        let look = Look { features: self, sight, forward, end: octaves.end(), octaves };
        let pieces = self.pieces.par_iter().map(|&piece| {
            let mut splats = Vec::new();
            look.go_through(piece, &mut splats);
            splats
        });
        let mut splats = Vec::new();
        for &patch in &self.above {
            look.draw(&self.of_patches[patch], &mut splats);
        }
        let pieces: Vec<_> = pieces.collect();
        splats.reserve(pieces.iter().map(Vec::len).sum());
        pieces.iter().for_each(|piece| splats.extend_from_slice(piece));
        splats
    }
}

struct Look<'a> {
    features: &'a Features,
    sight: &'a Sight,
    forward: Vec3,
    octaves: Octaves,
    end: f32,
}

impl Look<'_> {
    /// The highest priority that is needed within a ball; none where the ball is
    /// out of the picture.
    fn needed(&self, middle: Vec3, radius: f32) -> Option<f32> {
        let sight = self.sight;
        let to = middle - sight.camera.eye;
        let (along, towards) = (to.dot(self.forward), to.length() + radius);
        if along + radius < sight.camera.near || along - radius > sight.camera.far {
            return None;
        }
        let nearest = (along - radius).max(sight.camera.near);
        if along - radius > sight.camera.near
            && let Some(at) = sight.project(middle)
        {
            // A place off the axis moves by more than the radius seen from the front.
            let margin =
                sight.focal_px * radius * towards / (nearest * nearest) + self.octaves.largest_px();
            let inside = |at: f32, size: usize| at > -margin && at < size as f32 + margin;
            if !inside(at.x, sight.width) || !inside(at.y, sight.height) {
                return None;
            }
        }
        Some(self.end * sight.focal_px * sight.focal_px * towards / nearest.powi(3))
    }

    fn go_through(&self, piece: usize, splats: &mut Vec<Splat>) {
        let hierarchy = &self.features.hierarchy;
        let end = hierarchy.patches[piece].end;
        let mut index = piece;
        while index < end {
            let patch = &hierarchy.patches[index];
            let needed = self.needed(patch.middle, patch.radius);
            if needed.is_none_or(|needed| f64::from(needed) * patch.area <= 1.0) {
                index = patch.end;
                continue;
            }
            self.draw(&self.features.of_patches[index], splats);
            if patch.faces.len() == 1 {
                let face = &hierarchy.faces[patch.faces.start];
                let halves = Half::of(face, self.features.seed.below(index as u64)).halves();
                for half in halves {
                    self.halve(half, face.normal, face.area / 2.0, splats);
                }
            }
            index += 1;
        }
    }

    fn halve(&self, half: Half, normal: Vec3, area: f64, splats: &mut Vec<Splat>) {
        let [a, b, c] = half.corners;
        let middle = (a + b + c) / 3.0;
        let radius = [a, b, c].map(|at| at.distance_squared(middle)).into_iter();
        let radius = radius.fold(0.0, f32::max).sqrt();
        let needed = self.needed(middle, radius);
        if half.depth > DEEPEST || needed.is_none_or(|needed| f64::from(needed) * area <= 1.0) {
            return;
        }
        let halves = half.halves();
        self.draw(&half.feature(&halves, normal, area), splats);
        for half in halves {
            self.halve(half, normal, area / 2.0, splats);
        }
    }

    fn draw(&self, feature: &Feature, splats: &mut Vec<Splat>) {
        let sight = self.sight;
        let Some(at) = sight.project(feature.place) else { return };
        let towards = feature.normal.dot(feature.place - sight.camera.eye);
        // Pixels that a unit of area takes here.
        let focal = sight.focal_px / at.distance;
        let pixels = focal * focal * towards.abs() / at.distance;
        let rank = feature.priority / pixels;
        // False for what is seen edge-on.
        if !(rank < self.end && at.depth <= 1.0) {
            return;
        }
        let [slope_x, slope_y] = sight.slope(feature.normal, towards);
        let near = |at: f32, size: usize, r: f32| at > -r && at < size as f32 + r;
        for [radius, amplitude] in self.octaves.parts(rank) {
            if !near(at.x, sight.width, radius) || !near(at.y, sight.height, radius) {
                continue;
            }
            // A pixel, and what a round surface bends away within the reach.
            let slack = sight.depth_scale() * (1.0 + radius / 4.0) / (sight.focal_px * at.distance);
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

    /// Features of at least this priority within the half x > 0 and the other,
    /// with the area of each.
    fn counts(features: &Features, priority: f32) -> [[f64; 2]; 2] {
        let mut found = [[0.0; 2]; 2];
        for face in &features.hierarchy.faces {
            let side = usize::from(face.corners.iter().map(|at| at.x).sum::<f32>() > 0.0);
            found[side][1] += face.area;
        }
        for feature in features.of_patches.iter().filter(|own| own.priority < priority) {
            found[usize::from(feature.place.x > 0.0)][0] += 1.0;
        }
        found
    }

    #[test]
    fn there_are_as_many_features_as_the_priority_says_everywhere() {
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
    fn unequal_parts_have_their_share_of_features() {
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
        let strewn: Vec<Features> =
            (0..3000).map(|seed| Features::new(Arc::clone(&hierarchy), seed)).collect();
        for priority in [0.1, 0.5, 1.5] {
            let all = strewn.iter().flat_map(|features| &features.of_patches);
            let small = all.filter(|own| own.place.x < 0.0 && own.priority < priority).count();
            let mean = small as f32 / strewn.len() as f32;
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
            // Before what would be the farther half begins.
            let sight = Sight::new(&camera, 400, 400);
            let splats = features.splats(&sight, noise);
            let inside = splats.iter().filter(|splat| {
                splat.narrowness < 1.0 / 12.0
                    && (0.0..400.0).contains(&splat.x)
                    && (0.0..400.0).contains(&splat.y)
            });
            let silhouette = (sight.focal_px / ((1.0 + distance).powi(2) - 1.0).sqrt()).min(226.0);
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
        assert_eq!(features.splats(&Sight::new(&camera, 20, 20), FeatureNoise::FLOW), []);
    }
}
