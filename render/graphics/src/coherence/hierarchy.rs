//! The faces of a mesh, grouped into a binary tree of patches, and random numbers for its nodes.
//!
//! The two parts of a patch have nearly equal area. Where triangles are smaller than a feature of
//! noise, a whole patch of them carries one feature (Bousseau, Kaplan, Thollot and Sillion 2006).
//! We group triangles by position and by normal, so that, for example, the two sides of a thin
//! leaf become two patches. A node has the same random numbers at every visit.

use std::ops::Range;

use glam::Vec3;

use crate::mesh::Mesh;

/// Weight of the normal relative to the position when faces are grouped: a difference of 1 in the
/// normal counts as a distance of this many patch radii. We chose it by eye.
const FACING: f32 = 0.5;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Face {
    pub(super) corners: [Vec3; 3],
    pub(super) normal: Vec3,
    pub(super) area: f64,
    pub(super) number: u32,
}

/// A node of the tree: some neighbouring faces.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Patch {
    /// Its faces in [`Hierarchy::faces`], one face if the patch is a leaf.
    pub(super) faces: Range<usize>,
    pub(super) area: f64,
    pub(super) center: Vec3,
    /// Radius of a sphere around `center` that encloses the patch.
    pub(super) radius: f32,
    /// Index after the last descendant. The first part of the patch comes right after this patch.
    /// The second begins where the first one ends.
    pub(super) end: usize,
}

/// All patches of a mesh. You can build this once for a mesh, because it does not depend on the
/// view.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Hierarchy {
    pub(super) faces: Vec<Face>,
    /// For each face the summed area of the faces before it, then the area of all faces.
    area_before: Vec<f64>,
    /// All patches, each before its parts. The first is the whole mesh.
    pub(super) patches: Vec<Patch>,
}

impl Face {
    fn of(mesh: &Mesh, number: usize) -> Option<Self> {
        let corners = mesh.triangles[number].corners;
        let corners = corners.map(|corner| Vec3::from(mesh.positions[corner as usize]));
        let [a, b, c] = corners;
        let cross = (b - a).cross(c - a);
        let area = f64::from(cross.length()) / 2.0;
        let normal = cross.try_normalize()?;
        area.is_finite().then_some(Self { corners, normal, area, number: number as u32 })
    }

    fn center(&self) -> Vec3 {
        (self.corners[0] + self.corners[1] + self.corners[2]) / 3.0
    }
}

/// Draws a uniformly distributed point of a triangle from two uniform numbers in 0..1 (Turk 1990:
/// this folds the unit square at its diagonal).
pub(super) fn point_in(corners: [Vec3; 3], mut second: f32, mut third: f32) -> Vec3 {
    if second + third > 1.0 {
        (second, third) = (1.0 - second, 1.0 - third);
    }
    let [a, b, c] = corners;
    a + (b - a) * second + (c - a) * third
}

impl Hierarchy {
    /// Builds the patches of `mesh`. Faces of area 0 are left out.
    ///
    /// # Panics
    /// If a triangle has a corner that the mesh does not have.
    #[must_use]
    pub fn new(mesh: &Mesh) -> Self {
        let mut hierarchy = Self::default();
        let all = 0..mesh.triangles.len();
        let mut faces: Vec<Face> = all.filter_map(|i| Face::of(mesh, i)).collect();
        hierarchy.patches.reserve(2 * faces.len());
        if !faces.is_empty() {
            hierarchy.split(&mut faces, 0);
        }
        let mut area = 0.0;
        hierarchy.area_before.push(area);
        for face in &faces {
            area += face.area;
            hierarchy.area_before.push(area);
        }
        hierarchy.faces = faces;
        hierarchy
    }

    /// Number of faces with an area above 0.
    #[must_use]
    pub fn faces(&self) -> usize {
        self.faces.len()
    }

    /// Adds the patch of `faces` and all its descendants. `first` is the index of the first face.
    /// The area of a patch is at most half of its grandparent's, so the range of f32 bounds the
    /// depth of recursion.
    fn split(&mut self, faces: &mut [Face], first: usize) {
        let corners = faces.iter().flat_map(|face| face.corners);
        let (low, high) =
            corners.clone().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), at| {
                (low.min(at), high.max(at))
            });
        let center = (low + high) / 2.0;
        let radius = corners.map(|at| at.distance_squared(center)).fold(0.0, f32::max).sqrt();
        let area = faces.iter().map(|face| face.area).sum();
        let index = self.patches.len();
        let all = first..first + faces.len();
        self.patches.push(Patch { faces: all, area, center, radius, end: 0 });
        if faces.len() > 1 {
            let cut = halve(faces, area, radius);
            let (lower, upper) = faces.split_at_mut(cut);
            self.split(lower, first);
            self.split(upper, first + cut);
        }
        self.patches[index].end = self.patches.len();
    }

    /// Indices of the two parts of a patch. `None` if the patch is one face.
    pub(super) fn parts(&self, patch: usize) -> Option<[usize; 2]> {
        let has = self.patches[patch].faces.len() > 1;
        has.then(|| [patch + 1, self.patches[patch + 1].end])
    }

    /// A uniformly distributed point of a patch, and the face it is on.
    pub(super) fn point_on(&self, patch: usize, seed: Seed) -> (Vec3, &Face) {
        let faces = &self.patches[patch].faces;
        let low = self.area_before[faces.start];
        let high = self.area_before[faces.end];
        let wanted = low + (high - low) * f64::from(seed.unit(0));
        let inside = &self.area_before[faces.start + 1..faces.end];
        let face = &self.faces[faces.start + inside.partition_point(|&area| area <= wanted)];
        (point_in(face.corners, seed.unit(1), seed.unit(2)), face)
    }
}

/// Sorts faces along the coordinate (of position or normal) in which they spread most.
/// Returns the index that divides them into halves of nearly equal area.
fn halve(faces: &mut [Face], area: f64, radius: f32) -> usize {
    fn value(face: &Face, axis: usize, radius: f32) -> f32 {
        match axis {
            0..3 => face.center()[axis],
            _ => face.normal[axis - 3] * radius * FACING,
        }
    }
    let spreads = [0, 1, 2, 3, 4, 5].map(|axis: usize| {
        let mean =
            faces.iter().map(|face| face.area * f64::from(value(face, axis, radius))).sum::<f64>()
                / area;
        faces
            .iter()
            .map(|face: &Face| face.area * (f64::from(value(face, axis, radius)) - mean).powi(2))
            .sum::<f64>()
    });
    let axis = (0..6).max_by(|&a, &b| spreads[a].total_cmp(&spreads[b])).unwrap_or(0);
    faces.sort_by(|a, b| {
        value(a, axis, radius).total_cmp(&value(b, axis, radius)).then(a.number.cmp(&b.number))
    });
    let mut before = 0.0;
    let cut = faces.iter().position(|face| {
        before += face.area;
        before > area / 2.0
    });
    cut.unwrap_or(1).clamp(1, faces.len() - 1)
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Seed(pub(super) u64);

impl Seed {
    /// The seed of the node's child `number` (SplitMix64, Steele, Lea and Flood 2014).
    pub(super) fn child(self, number: u64) -> Self {
        let step = 0x9e37_79b9_7f4a_7c15u64.wrapping_mul(number.wrapping_add(1));
        let mut bits = self.0.wrapping_add(step);
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        Self(bits ^ (bits >> 31))
    }

    /// A uniform number in 0..1. Each `number` gives an independent one.
    pub(super) fn unit(self, number: u64) -> f32 {
        (self.child(number).0 >> 40) as f32 / (1u64 << 24) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_are_halves_down_to_every_face() {
        let mesh = Mesh::torus_knot(2000);
        let hierarchy = Hierarchy::new(&mesh);
        assert_eq!(hierarchy.patches.len(), 2 * hierarchy.faces() - 1);
        let mut numbers: Vec<u32> = hierarchy.faces.iter().map(|face| face.number).collect();
        numbers.sort_unstable();
        assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]), "a face twice");
        let largest = hierarchy.faces.iter().map(|face| face.area).fold(0.0, f64::max);
        for (index, patch) in hierarchy.patches.iter().enumerate() {
            let Some(parts) = hierarchy.parts(index) else {
                assert_eq!(patch.end, index + 1);
                continue;
            };
            let [a, b] = parts.map(|part| &hierarchy.patches[part]);
            assert_eq!((a.faces.start, b.faces.end), (patch.faces.start, patch.faces.end));
            assert_eq!((a.faces.end, b.end), (b.faces.start, patch.end));
            assert!((a.area + b.area - patch.area).abs() < 1e-9 * patch.area);
            assert!((a.area - b.area).abs() <= 2.0 * largest, "{} {}", a.area, b.area);
        }
    }

    #[test]
    fn small_patches_are_connected_and_face_one_way() {
        let hierarchy = Hierarchy::new(&Mesh::sphere(4000));
        let small = hierarchy.patches.iter().filter(|patch| (8..20).contains(&patch.faces.len()));
        let mut count = 0;
        for patch in small {
            let faces = &hierarchy.faces[patch.faces.clone()];
            let least = faces
                .iter()
                .map(|face: &Face| face.normal.dot(faces[0].normal))
                .fold(1.0, f32::min);
            assert!(least > 0.7, "{least}");
            let round = (patch.area / std::f64::consts::PI).sqrt() as f32;
            assert!(patch.radius < 4.0 * round, "{} {round}", patch.radius);
            count += 1;
        }
        assert!(count > 200, "{count}");
    }

    #[test]
    fn meshes_without_area_have_no_patch() {
        assert_eq!(Hierarchy::new(&Mesh::default()).patches.len(), 0);
        let mut flat = Mesh::sphere(100);
        flat.positions.iter_mut().for_each(|place| *place = [place[0], 0.0, 0.0]);
        assert_eq!(Hierarchy::new(&flat).faces(), 0);
    }
}
