//! Features placed on a mesh at random, and the choice of those that a view or a density needs.
//!
//! Every patch has one feature at a uniformly distributed point. You draw a feature if the density
//! that you want (features per unit of area) is at least its priority. We pick the priority at
//! random between two densities: one feature on the patch, and one feature on the part of the patch
//! that the point lies on. So the features up to a priority have exactly this density everywhere on
//! the mesh, however you divide it into triangles. Below single faces the tree continues with
//! halves of triangles, made on demand.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::Vec3;
use rayon::prelude::*;

use super::depths::DepthTiles;
use super::hierarchy::{Face, Hierarchy, Seed, point_in};
use super::octaves::Octaves;
use super::projection::Projection;

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
    /// The feature of each patch, then one more for the whole mesh.
    pub(super) of_patches: Vec<Feature>,
    /// Roots of the largest subtrees of up to [`SUBTREE_PATCHES`] patches. One thread selects from
    /// each.
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

    pub(super) fn halves(self) -> [Self; 2] {
        let [a, b, c] = self.corners;
        let edges = [a.distance_squared(b), b.distance_squared(c), c.distance_squared(a)];
        let [a, b, c] = match edges {
            [ab, bc, ca] if ab >= bc && ab >= ca => [a, b, c],
            [_, bc, ca] if bc >= ca => [b, c, a],
            _ => [c, a, b],
        };
        let middle = (a + b) / 2.0;
        [([a, middle, c], 8), ([middle, b, c], 9)].map(|(corners, number)| Self {
            corners,
            seed: self.seed.child(number),
            depth: self.depth + 1,
        })
    }

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
    /// A uniform number in 0..1. Each `number` gives an independent one. Use 16 and above: the
    /// others place features.
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
        let mut of_patches: Vec<Feature> = (0..patches.len())
            .into_par_iter()
            .map(|patch: usize| {
                let own = &patches[patch];
                let seed = seed.child(patch as u64);
                let Some(parts) = hierarchy.parts(patch) else {
                    let face = &hierarchy.faces[own.faces.start];
                    let half = Half::whole(face, seed);
                    return half.feature(&half.halves(), face, face.area);
                };
                // We choose a part with the other part's share of the area as probability. The smaller
                // part then gets its next feature only at a higher density.
                let chosen =
                    usize::from(f64::from(seed.unit(5)) * own.area < patches[parts[0]].area);
                let part = parts[chosen];
                let (position, face) = hierarchy.point_on(part, seed);
                let priority = uniform(1.0 / own.area, 1.0 / patches[part].area, seed);
                Feature { seed: seed.0, face: face.number, position, normal: face.normal, priority }
            })
            .collect();
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

/// Triangles are halved at most this often. f32 cannot represent smaller ones.
const MAX_HALVINGS: u32 = 40;

/// The quantity that the rank of a feature refers to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Density {
    /// Features per pixel of the picture. Use this when the density in the picture must stay as
    /// the model moves away.
    Screen,
    /// Features per pixel that the surface would cover if it faced the eye. This is dense towards
    /// outlines.
    Facing,
    /// Features per pixel, if a unit of the model has this many pixels. Use this when the density
    /// on the surface must stay.
    Surface {
        /// Pixels to a unit of the model, above 0.
        px_per_unit: f32,
    },
}

/// Selects the features of a noise.
pub(super) trait Select: Sync {
    /// The highest priority that is needed within a sphere, `None` if nothing in it is. If you
    /// give a `normal`, everything in the sphere lies on the plane through the centre with this
    /// normal.
    fn needed(&self, center: Vec3, radius: f32, normal: Option<Vec3>) -> Option<f32>;

    /// Whether surfaces in front of a sphere hide all of it, so that you can skip it. `share` is
    /// the area within the sphere times the highest priority that is needed there.
    fn hidden(&self, _center: Vec3, _radius: f32, _share: f64) -> bool {
        false
    }
}

/// Selects the features that one projection needs.
pub(super) struct InSight<'a> {
    pub(super) projection: &'a Projection,
    pub(super) density: Density,
    pub(super) end: f32,
    /// Viewing direction, of length 1.
    forward: Vec3,
    /// Unit normals, inwards, of the planes through the eye that bound what reaches the picture.
    sides: [Vec3; 4],
    beyond: f32,
    surfaces: Option<(&'a DepthTiles, &'a Octaves)>,
}

struct Below(f32);

impl<'a> InSight<'a> {
    /// Selects features that reach the picture if their radius is at most `margin_px`. With
    /// [`Density::Surface`] this counts in pixels of that density.
    pub(super) fn new(
        projection: &'a Projection,
        density: Density,
        end: f32,
        margin_px: f32,
    ) -> Self {
        let forward = (projection.camera.target - projection.camera.eye).normalize_or_zero();
        let [margin_px, beyond] = match density {
            Density::Screen | Density::Facing => [margin_px, 0.0],
            Density::Surface { px_per_unit } => [0.0, margin_px / px_per_unit],
        };
        let [right, up] = projection.axes();
        let [across, down] = [projection.width, projection.height]
            .map(|size: usize| (size as f32 / 2.0 + margin_px) / projection.focal_px);
        fn side(axis: Vec3, slope: f32, forward: Vec3) -> Vec3 {
            (forward * slope - axis).normalize_or_zero()
        }
        let sides = [
            side(right, across, forward),
            side(-right, across, forward),
            side(up, down, forward),
            side(-up, down, forward),
        ];
        Self { projection, density, end, forward, sides, beyond, surfaces: None }
    }

    /// Leaves out most of the features that `surfaces` hide. `octaves` gives the ranks.
    pub(super) fn before(mut self, surfaces: &'a DepthTiles, octaves: &'a Octaves) -> Self {
        self.surfaces = Some((surfaces, octaves));
        self
    }
}

impl Select for InSight<'_> {
    fn needed(&self, center: Vec3, radius: f32, normal: Option<Vec3>) -> Option<f32> {
        let projection = self.projection;
        let to = center - projection.camera.eye;
        let along = to.dot(self.forward);
        // On a plane seen at a grazing angle few pixels show much of the surface. The distance
        // of the eye from the plane is the same everywhere on it, except for rounding.
        let towards = match normal {
            Some(normal) => normal.dot(to).abs() + 1e-4 * (to.length() + radius),
            None => to.length() + radius,
        };
        if along + radius < projection.camera.near || along - radius > projection.camera.far {
            return None;
        }
        if self.sides.iter().any(|side| side.dot(to) < -radius - self.beyond) {
            return None;
        }
        let nearest = (along - radius).max(projection.camera.near);
        Some(match self.density {
            Density::Screen => {
                self.end * projection.focal_px * projection.focal_px * towards / nearest.powi(3)
            }
            Density::Facing => self.end * (projection.focal_px / nearest).powi(2),
            Density::Surface { px_per_unit } => self.end * px_per_unit * px_per_unit,
        })
    }

    fn hidden(&self, center: Vec3, radius: f32, share: f64) -> bool {
        let (Some((surfaces, octaves)), projection) = (self.surfaces, self.projection) else {
            return false;
        };
        let to = center - projection.camera.eye;
        let along = to.dot(self.forward);
        let nearest = along - radius;
        // No feature of an area has a lower priority than one feature on all of it.
        let reach = octaves.largest_from((f64::from(self.end) / share) as f32);
        // A feature shows up to twice its tolerance before its surface, and its plane may lean
        // towards the eye.
        let ahead = nearest - nearest / projection.focal_px * (2.0 + 1.5 * reach);
        if ahead <= projection.camera.near {
            return false;
        }
        let [right, up] = projection.axes();
        let slopes = [to.dot(right) / along, -to.dot(up) / along];
        let sizes = [projection.width, projection.height];
        let [columns, rows] = [0, 1].map(|axis: usize| {
            let middle = sizes[axis] as f32 / 2.0 + projection.focal_px * slopes[axis];
            let wide = 1.0 + slopes[axis].abs();
            let around = projection.focal_px * radius * wide / nearest + reach;
            [middle - around, middle + around]
        });
        projection.depth_at(ahead) > surfaces.farthest(columns, rows)
    }
}

impl Select for Below {
    fn needed(&self, _: Vec3, _: f32, _: Option<Vec3>) -> Option<f32> {
        Some(self.0)
    }
}

/// A selection ends if it visits more parts of the mesh than its features would fill the picture
/// this many times. Ordinary models have fewer surfaces behind each other.
const MOST_LAYERS: f64 = 16.0;
/// A selection may always visit this many parts of the mesh.
const FEWEST_VISITS: f64 = (1u64 << 20) as f64;
/// No selection visits more parts than this in all, or for each pixel. A feature takes 32 to 84
/// bytes.
const MOST_VISITS: f64 = (1u64 << 25) as f64;
const MOST_VISITS_PER_PX: f64 = 4096.0;
/// Greatest number of parts that [`Features::below`] visits.
const VISITS_BELOW: usize = 1 << 20;
/// The end of a selection falls to a quarter, i.e. by one octave of noise, at most this often. That
/// is enough for 10 million surfaces.
const MOST_TRIES: usize = 12;

impl Features {
    /// Applies `draw` to the features that a projection needs, and to a few more. It also gets the
    /// rank at which they end. Their order does not depend on the projection.
    ///
    /// Surfaces may lie behind each other without limit, so this bounds the number of features by
    /// the picture: if there are too many, the finest ones are left out, by a lower rank of the
    /// end.
    pub(super) fn selected<T: Send + Copy>(
        &self,
        mut in_sight: InSight<'_>,
        draw: impl Fn(&Feature, f32, &mut Vec<T>) + Sync,
    ) -> Vec<T> {
        let Projection { width, height, .. } = in_sight.projection;
        let px = (width * height) as f64;
        let limit = (MOST_VISITS_PER_PX * px).clamp(FEWEST_VISITS, MOST_VISITS);
        let once = f64::from(in_sight.end) * px;
        let most = (MOST_LAYERS * once).clamp(FEWEST_VISITS, limit) as usize;
        for _ in 0..MOST_TRIES {
            let end = in_sight.end;
            let drawn = self.visited(&in_sight, most, |feature, all| draw(feature, end, all));
            if let Some(drawn) = drawn {
                return drawn;
            }
            in_sight.end = (end / 4.0).min((limit / px) as f32);
        }
        Vec::new()
    }

    /// All features below this priority, in an order that does not depend on it. If the mesh has
    /// more than about a million of them, you get those below a quarter of the priority, or a
    /// sixteenth, and so on.
    #[must_use]
    pub fn below(&self, priority: f32) -> Vec<Feature> {
        let mut priority = priority;
        let area = self.hierarchy.patches.first().map_or(0.0, |whole| whole.area);
        for _ in 0..MOST_TRIES {
            let found = self.visited(&Below(priority), VISITS_BELOW, |feature, all| {
                if feature.priority < priority {
                    all.push(*feature);
                }
            });
            if let Some(found) = found {
                return found;
            }
            priority = (priority / 4.0).min((VISITS_BELOW as f64 / area) as f32);
        }
        Vec::new()
    }

    /// Applies `draw` to the features that `select` needs, and to a few more. Returns `None` if
    /// these are more than `most`. This does not depend on threads.
    fn visited<T: Send + Copy>(
        &self,
        select: &impl Select,
        most: usize,
        draw: impl Fn(&Feature, &mut Vec<T>) + Sync,
    ) -> Option<Vec<T>> {
        let visits = Visits { count: AtomicUsize::new(0), most };
        let subtrees = self.subtrees.par_iter().map(|&subtree| {
            let mut drawn = Vec::new();
            self.select(select, subtree, &mut |feature| {
                let goes_on = visits.add();
                if goes_on {
                    draw(feature, &mut drawn);
                }
                goes_on
            });
            drawn
        });
        let mut drawn = Vec::new();
        for &patch in &self.above {
            draw(&self.of_patches[patch], &mut drawn);
        }
        let subtrees: Vec<_> = subtrees.collect();
        if visits.count.into_inner() > most {
            return None;
        }
        drawn.reserve(subtrees.iter().map(Vec::len).sum());
        // Each list is freed before the next one is copied.
        subtrees.into_iter().for_each(|subtree| drawn.extend_from_slice(&subtree));
        Some(drawn)
    }

    /// Gives the features of a subtree to `draw` until it returns false.
    fn select(
        &self,
        select: &impl Select,
        subtree: usize,
        draw: &mut impl FnMut(&Feature) -> bool,
    ) {
        let end = self.hierarchy.patches[subtree].end;
        let mut index = subtree;
        while index < end {
            let patch = &self.hierarchy.patches[index];
            // The centre of a patch is the centre of its box, which lies on no plane of its faces.
            if !wanted(select, patch.center, patch.radius, None, patch.area) {
                index = patch.end;
                continue;
            }
            if !draw(&self.of_patches[index]) {
                return;
            }
            if patch.faces.len() == 1 {
                let face = &self.hierarchy.faces[patch.faces.start];
                for half in Half::whole(face, self.seed.child(index as u64)).halves() {
                    if !halve(select, half, face, face.area / 2.0, draw) {
                        return;
                    }
                }
            }
            index += 1;
        }
    }
}

/// Counts the parts that all threads visit.
struct Visits {
    count: AtomicUsize,
    most: usize,
}

impl Visits {
    /// Counts one more, and returns whether there are still few enough.
    fn add(&self) -> bool {
        self.count.fetch_add(1, Ordering::Relaxed) < self.most
    }
}

/// Whether we select features of a part of the mesh with this `area`, or of smaller parts in it.
/// The sphere encloses the part.
fn wanted(
    select: &impl Select,
    center: Vec3,
    radius: f32,
    normal: Option<Vec3>,
    area: f64,
) -> bool {
    let share = select.needed(center, radius, normal).map(|needed| f64::from(needed) * area);
    share.is_some_and(|share| share > 1.0 && !select.hidden(center, radius, share))
}

/// Gives the features of a part of a face to `draw`. Returns false once `draw` does.
fn halve(
    select: &impl Select,
    half: Half,
    face: &Face,
    area: f64,
    draw: &mut impl FnMut(&Feature) -> bool,
) -> bool {
    let [a, b, c] = half.corners;
    let center = (a + b + c) / 3.0;
    let radius = [a, b, c].map(|at| at.distance_squared(center)).into_iter();
    let radius = radius.fold(0.0, f32::max).sqrt();
    if half.depth > MAX_HALVINGS || !wanted(select, center, radius, Some(face.normal), area) {
        return true;
    }
    let halves = half.halves();
    draw(&half.feature(&halves, face, area))
        && halves.into_iter().all(|half| halve(select, half, face, area / 2.0, draw))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::coherence::hierarchy::Hierarchy;
    use crate::mesh::Mesh;
    use std::sync::Arc;

    fn features(mesh: &Mesh) -> Features {
        Features::new(Arc::new(Hierarchy::new(mesh)), 7)
    }

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
        let mut mesh = Mesh::sphere(20);
        mesh.triangles.truncate(3);
        fn triangle(x: f32, size: f32) -> [[f32; 3]; 3] {
            [[x, 0.0, 0.0], [x + size, 0.0, 0.0], [x, size, 0.0]]
        }
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

    /// A square of 1600 equal triangles that lie on each other.
    fn stack() -> Mesh {
        let mut mesh = Mesh::sphere(20);
        mesh.positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let [mut one, mut other] = [mesh.triangles[0]; 2];
        (one.corners, other.corners) = ([0, 1, 2], [0, 2, 3]);
        mesh.triangles = [one, other].repeat(800);
        mesh
    }

    #[test]
    fn features_of_surfaces_without_end_are_bounded_by_the_picture() {
        let mesh = stack();
        let features = features(&mesh);
        let camera = Camera::framing(mesh.bounds(), 0.0, 0.0, 30.0);
        let projection = Projection::new(&camera, 32, 24);
        // One surface has about 130,000 features, and all have 10^8.
        let seen = features.seen(&projection, Density::Screen, 300.0, 1.0);
        assert!((50_000..1 << 21).contains(&seen.len()), "{}", seen.len());
        let again = features.seen(&projection, Density::Screen, 300.0, 1.0);
        assert!(seen == again, "threads made a difference");
        // Only the features of the highest ranks are left out.
        let highest = seen.iter().map(|seen| seen.rank).fold(0.0, f32::max);
        let few = features.seen(&projection, Density::Screen, highest / 16.0, 1.0);
        let of_seen = seen.iter().filter(|seen| seen.rank < highest / 16.0);
        assert!(few.iter().eq(of_seen), "{} features", few.len());
        let below = features.below(1e6);
        assert!((10_000..1 << 20).contains(&below.len()), "{}", below.len());
    }

    #[test]
    fn halving_ends_where_every_density_is_too_low() {
        for (scale, end) in [(1e-9, 1e30), (1e9, f32::INFINITY)] {
            let mut mesh = Mesh::sphere(20);
            mesh.positions.iter_mut().for_each(|at| *at = at.map(|value| value * scale));
            let features = features(&mesh);
            let camera = Camera::framing(mesh.bounds(), 0.0, 0.0, 30.0);
            let projection = Projection::new(&camera, 8, 8);
            for density in [Density::Screen, Density::Surface { px_per_unit: 1e30 }] {
                let seen = features.seen(&projection, density, end, 1.0);
                assert!(seen.len() <= 1 << 25, "{scale} {end}: {}", seen.len());
            }
            assert!(features.below(end).len() <= 1 << 20, "{scale} {end}");
        }
    }

    #[test]
    fn all_features_below_a_priority_are_found_in_one_order() {
        for triangles in [20, 3000] {
            let hierarchy = Arc::new(Hierarchy::new(&Mesh::sphere(triangles)));
            let area = hierarchy.patches[0].area;
            let features = Features::new(hierarchy, 7);
            let [few, many] = [50.0, 400.0].map(|priority| features.below(priority));
            for (found, priority) in [(&few, 50.0), (&many, 400.0)] {
                let wanted = area * priority;
                let error = (found.len() as f64 - wanted).abs();
                assert!(error < 2.0 * wanted.sqrt(), "{triangles}: {}", found.len());
            }
            let of_many: Vec<u64> =
                many.iter().filter(|own| own.priority < 50.0).map(|own| own.seed).collect();
            let of_few: Vec<u64> = few.iter().map(|own| own.seed).collect();
            assert_eq!(of_few, of_many);
            let mut seeds: Vec<u64> = many.iter().map(|own| own.seed).collect();
            seeds.sort_unstable();
            assert!(seeds.windows(2).all(|pair| pair[0] != pair[1]), "two of one seed");
        }
    }

    #[test]
    fn an_eye_inside_a_mesh_finds_all_features_of_the_picture_and_few_others() {
        let mesh = Mesh::sphere(3000);
        let features = Features::new(Arc::new(Hierarchy::new(&mesh)), 7);
        let eye = Vec3::new(0.1, 0.2, -0.1);
        let camera = Camera {
            eye,
            target: eye + Vec3::new(0.3, 0.1, 1.0),
            near: 0.01,
            ..Camera::framing(mesh.bounds(), 0.0, 0.0, 40.0)
        };
        let size = [160, 120];
        let margin_px = 6.0;
        let end = 0.02;
        let projection = Projection::new(&camera, size[0], size[1]);
        for density in [Density::Screen, Density::Facing, Density::Surface { px_per_unit: 90.0 }] {
            let reaches = |position: Vec3| {
                projection.project(position).is_some_and(|at| {
                    let own = match density {
                        Density::Surface { px_per_unit } => {
                            margin_px * projection.focal_px / (at.distance * px_per_unit)
                        }
                        _ => margin_px,
                    };
                    [(at.x, size[0]), (at.y, size[1])]
                        .into_iter()
                        .all(|(at, size): (f32, usize)| at > -own && at < size as f32 + own)
                })
            };
            let seen = features.seen(&projection, density, end, margin_px);
            let mut found: Vec<u64> = Vec::new();
            for own in seen.iter().filter(|own| reaches(own.feature.position)) {
                found.push(own.feature.seed);
            }
            // The surface is at least 0.7 in front of the eye where it shows.
            let most = end * (projection.focal_px / 0.7).powi(2) * 1.5;
            let all = features.below(most);
            let wanted = all.iter().filter(|own| reaches(own.position));
            let wanted = wanted.filter(|own: &&Feature| {
                let Some(at) = projection.project(own.position) else { return false };
                let focal = projection.focal_px / at.distance;
                let towards = own.normal.dot(camera.eye - own.position).abs();
                let rank = match density {
                    Density::Screen => own.priority * at.distance / (focal * focal * towards),
                    Density::Facing => own.priority / (focal * focal),
                    Density::Surface { px_per_unit } => own.priority / (px_per_unit * px_per_unit),
                };
                rank < end
            });
            let wanted: Vec<u64> = wanted.map(|own| own.seed).collect();
            assert_eq!(found, wanted, "{density:?}");
            assert!(wanted.len() > 100, "{density:?}: {}", wanted.len());
            assert!(seen.len() < 2 * wanted.len(), "{density:?}: {} seen", seen.len());
        }
    }
}
