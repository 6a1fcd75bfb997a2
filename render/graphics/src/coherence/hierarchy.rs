//! Faces of a mesh, joined to patches, patches to larger ones, up to the whole.
//!
//! A binary tree of patches of nearly equal area, so that where triangles are
//! smaller than a feature of noise, a patch of them can have one (Bousseau, Kaplan,
//! Thollot and Sillion 2006). Triangles are told apart by where they
//! lie and where they face, so that the two sides of a leaf are two patches.

use std::ops::Range;

use glam::Vec3;

use super::random::Seed;
use crate::mesh::Mesh;

/// How far apart triangles count that face opposite ways, by the size of their
/// patch.
const FACING: f32 = 0.5;

/// A triangle with an area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Face {
    pub(super) corners: [Vec3; 3],
    pub(super) normal: Vec3,
    pub(super) area: f64,
    /// Its number in the mesh.
    pub(super) number: u32,
}

/// A patch.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Patch {
    /// Faces in [`Hierarchy::faces`]; one where it has no parts.
    pub(super) faces: Range<usize>,
    pub(super) area: f64,
    /// A ball around it.
    pub(super) middle: Vec3,
    pub(super) radius: f32,
    /// The index after the last patch within it. Its first part is the next one,
    /// and its second where that one ends.
    pub(super) end: usize,
}

/// All patches of a mesh; built once, as it does not depend on the view.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Hierarchy {
    pub(super) faces: Vec<Face>,
    /// Area of all faces before each, and of all.
    before: Vec<f64>,
    /// Every patch before its parts.
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

    fn middle(&self) -> Vec3 {
        (self.corners[0] + self.corners[1] + self.corners[2]) / 3.0
    }
}

/// An even place in a triangle (Turk 1990): the square folded at its diagonal.
pub(super) fn place_in(corners: [Vec3; 3], mut second: f32, mut third: f32) -> Vec3 {
    if second + third > 1.0 {
        (second, third) = (1.0 - second, 1.0 - third);
    }
    let [a, b, c] = corners;
    a + (b - a) * second + (c - a) * third
}

impl Hierarchy {
    /// The patches of `mesh`; faces without an area are in none.
    ///
    /// # Panics
    /// If a triangle has a corner that there is not.
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
        hierarchy.before.push(area);
        for face in &faces {
            area += face.area;
            hierarchy.before.push(area);
        }
        hierarchy.faces = faces;
        hierarchy
    }

    /// How many faces have an area.
    #[must_use]
    pub fn faces(&self) -> usize {
        self.faces.len()
    }

    /// Adds the patch of `faces`, which begin at `first`, and all within it. The
    /// area of a patch is at most half that of the one two above, so this goes
    /// as deep as f32 has powers of two.
    fn split(&mut self, faces: &mut [Face], first: usize) {
        let corners = || faces.iter().flat_map(|face| face.corners);
        let (low, high) = corners()
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), at| {
                (low.min(at), high.max(at))
            });
        let middle = (low + high) / 2.0;
        let radius = corners().map(|at| at.distance_squared(middle)).fold(0.0, f32::max).sqrt();
        let area = faces.iter().map(|face| face.area).sum();
        let index = self.patches.len();
        let all = first..first + faces.len();
        self.patches.push(Patch { faces: all, area, middle, radius, end: 0 });
        if faces.len() > 1 {
            let cut = halve(faces, area, radius);
            let (lower, upper) = faces.split_at_mut(cut);
            self.split(lower, first);
            self.split(upper, first + cut);
        }
        self.patches[index].end = self.patches.len();
    }

    /// The parts of a patch; none where it is one face.
    pub(super) fn parts(&self, patch: usize) -> Option<[usize; 2]> {
        let has = self.patches[patch].faces.len() > 1;
        has.then(|| [patch + 1, self.patches[patch + 1].end])
    }

    /// An even place on a patch, with the face it is on.
    pub(super) fn place_on(&self, patch: usize, seed: Seed) -> (Vec3, &Face) {
        let faces = &self.patches[patch].faces;
        let (low, high) = (self.before[faces.start], self.before[faces.end]);
        let wanted = low + (high - low) * f64::from(seed.unit(0));
        let inside = &self.before[faces.start + 1..faces.end];
        let face = &self.faces[faces.start + inside.partition_point(|&area| area <= wanted)];
        (place_in(face.corners, seed.unit(1), seed.unit(2)), face)
    }
}

/// Sorts faces along what they differ most in, and cuts them where half of the
/// area lies on either side.
fn halve(faces: &mut [Face], area: f64, radius: f32) -> usize {
    let value = |face: &Face, axis: usize| match axis {
        0..3 => face.middle()[axis],
        _ => face.normal[axis - 3] * radius * FACING,
    };
    let spread = |axis: usize| {
        let mean =
            faces.iter().map(|face| face.area * f64::from(value(face, axis))).sum::<f64>() / area;
        let error = |face: &Face| face.area * (f64::from(value(face, axis)) - mean).powi(2);
        faces.iter().map(error).sum::<f64>()
    };
    let spreads = [0, 1, 2, 3, 4, 5].map(spread);
    let axis = (0..6).max_by(|&a, &b| spreads[a].total_cmp(&spreads[b])).unwrap_or(0);
    faces.sort_by(|a, b| value(a, axis).total_cmp(&value(b, axis)).then(a.number.cmp(&b.number)));
    let mut before = 0.0;
    let cut = faces.iter().position(|face| {
        before += face.area;
        before > area / 2.0
    });
    cut.unwrap_or(1).clamp(1, faces.len() - 1)
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
    fn a_small_patch_is_in_one_piece_and_faces_one_way() {
        let hierarchy = Hierarchy::new(&Mesh::sphere(4000));
        let small = hierarchy.patches.iter().filter(|patch| (8..20).contains(&patch.faces.len()));
        let mut count = 0;
        for patch in small {
            let faces = &hierarchy.faces[patch.faces.clone()];
            let dot = |face: &Face| face.normal.dot(faces[0].normal);
            let least = faces.iter().map(dot).fold(1.0, f32::min);
            assert!(least > 0.7, "{least}");
            // A disc of its area would have this radius.
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
