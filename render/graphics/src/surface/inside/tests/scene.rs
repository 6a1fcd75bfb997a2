//! Scenes of closed surfaces, some of them random. We compare their counts with an oracle: winding
//! numbers in f64. This leaves out points too near an outline or a skin for rasterised faces to
//! decide.

use std::f32::consts::{PI, TAU};

use glam::{DVec2, DVec3, Vec3};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::camera::Camera;
use crate::field::Field;
use crate::mesh::{Mesh, Triangle};
use crate::surface::{
    ClosedSurfaces, Count, Crossings, Fragment, NO_TRIANGLE, VisibilityBuffer, visible,
};

pub(crate) struct Scene {
    pub(crate) mesh: Mesh,
    pub(crate) surfaces: Surfaces,
    pub(crate) camera: Camera,
    pub(crate) size: (usize, usize),
}

/// How the counts of a scene compare with winding numbers.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct CountErrors {
    pub(super) samples: usize,
    pub(super) most: i32,
    pub(super) differ: usize,
    /// Points with a wrong count that are farther than half a pixel from every outline, and farther
    /// than a thousandth of the radius from every skin.
    pub(super) wrong: usize,
}

impl Scene {
    pub(crate) fn visible(&self) -> VisibilityBuffer {
        visible(&self.mesh, &self.camera, self.size.0, self.size.1)
    }

    pub(crate) fn counts(&self) -> Field<i32> {
        Crossings::default().sum(&Count, self.surfaces.closed(), &self.camera, &self.visible())
    }

    fn view(&self) -> View {
        let [right, up, back] = self.camera.axes().map(Vec3::as_dvec3);
        let middle = DVec2::new(self.size.0 as f64, self.size.1 as f64) / 2.0;
        let half = f64::from(self.camera.field_of_view_deg.to_radians() / 2.0).tan();
        let eye = self.camera.eye.as_dvec3();
        let near = f64::from(self.camera.near);
        View { eye, right, up, forward: -back, near, focal_px: middle.y / half, middle }
    }

    fn place(&self, seen: Fragment) -> DVec3 {
        let corners = self.mesh.triangles[seen.triangle as usize].corners;
        let [a, b, c] = corners.map(|at| Vec3::from(self.mesh.positions[at as usize]).as_dvec3());
        a + (b - a) * f64::from(seen.second) + (c - a) * f64::from(seen.third)
    }

    /// Compares the counts with winding numbers at every pixel that shows the scene.
    pub(super) fn compared_with_winding_numbers(&self) -> CountErrors {
        let visible = self.visible();
        let counts = self.counts();
        let view = self.view();
        let surfaces = &self.surfaces;
        let solids: Vec<_> = (0..surfaces.count).map(|i| Solid::new(surfaces.faces(i))).collect();
        let pixels = visible.values().par_iter().zip(counts.values()).enumerate();
        let found = pixels.map(|(pixel, (&seen, &count))| {
            if seen.triangle == NO_TRIANGLE {
                assert_eq!(count, 0, "nothing is seen at {pixel}");
                return CountErrors::default();
            }
            let place = self.place(seen);
            let expected = solids.iter().filter(|solid| solid.holds(place)).count() as i32;
            let at = [pixel % self.size.0, pixel / self.size.0].map(|at| at as f64 + 0.5);
            let differs = count != expected;
            let wrong = differs
                && !solids.iter().any(|solid: &Solid| {
                    solid.has_skin_at(place, 1e-3) || solid.has_outline_at(at.into(), 0.5, &view)
                });
            let [differ, wrong] = [differs, wrong].map(usize::from);
            CountErrors { samples: 1, most: expected, differ, wrong }
        });
        found.reduce(CountErrors::default, CountErrors::and)
    }
}

impl CountErrors {
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            samples: self.samples + other.samples,
            most: self.most.max(other.most),
            differ: self.differ + other.differ,
            wrong: self.wrong + other.wrong,
        }
    }
}

pub(crate) fn mesh_of(triangles: &[[Vec3; 3]]) -> Mesh {
    let positions: Vec<_> = triangles.iter().flatten().map(Vec3::to_array).collect();
    let corners = (0..positions.len() as u32).step_by(3).map(|i| [i, i + 1, i + 2]);
    let triangles = corners.map(|corners| Triangle { corners, material: 0 }).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}

pub(crate) fn wall(z: f32, half: f32, cells: usize) -> Mesh {
    fn at(i: usize, cells: usize, half: f32) -> f32 {
        half * (2.0 * i as f32 / cells as f32 - 1.0)
    }
    let triangles = (0..cells * cells).flat_map(|cell| {
        let [x, y] = [cell % cells, cell / cells];
        let [a, b, c, d] = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]]
            .map(|[x, y]| Vec3::new(at(x, cells, half), at(y, cells, half), z));
        [[a, b, c], [a, c, d]]
    });
    mesh_of(&triangles.collect::<Vec<_>>())
}

pub(crate) fn camera(eye: Vec3, target: Vec3) -> Camera {
    Camera { eye, target, up: Vec3::Y, field_of_view_deg: 50.0, near: 0.05, far: 20.0 }
}

#[derive(Debug, Clone, Default)]
pub(crate) struct Surfaces {
    pub(crate) vertices: Vec<[f32; 3]>,
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) count: u32,
}

const RINGS: u32 = 10;
const AROUND: u32 = 14;

impl Surfaces {
    /// Adds a closed surface around `center`. `radius` gives its distance from the centre in each
    /// direction.
    pub(crate) fn add_star(&mut self, center: Vec3, radius: impl Fn(Vec3) -> f32) {
        let first = self.vertices.len() as u32;
        let mut directions = vec![Vec3::Y];
        for ring in 1..RINGS {
            let (high, wide) = (PI * ring as f32 / RINGS as f32).sin_cos();
            for step in 0..AROUND {
                let (x, z) = (TAU * step as f32 / AROUND as f32).sin_cos();
                directions.push(Vec3::new(x * high, wide, z * high));
            }
        }
        directions.push(Vec3::NEG_Y);
        self.vertices
            .extend(directions.iter().map(|&along| (center + along * radius(along)).to_array()));
        let last = first + 1 + (RINGS - 1) * AROUND;
        fn at(ring: u32, step: u32, first: u32, last: u32) -> u32 {
            match ring {
                0 => first,
                RINGS => last,
                _ => first + 1 + (ring - 1) * AROUND + step % AROUND,
            }
        }
        for ring in 0..RINGS {
            for step in 0..AROUND {
                let [a, b] = [at(ring, step, first, last), at(ring, step + 1, first, last)];
                let [c, d] = [at(ring + 1, step, first, last), at(ring + 1, step + 1, first, last)];
                for corners in [[a, c, d], [a, d, b]] {
                    let [p, q, r] = corners;
                    if p != q && q != r && r != p {
                        self.triangles.push(Triangle { corners, material: self.count });
                    }
                }
            }
        }
        self.count += 1;
    }

    pub(crate) fn add_ball(&mut self, center: Vec3, radius: f32) {
        self.add_star(center, |_| radius);
    }

    /// Adds a sphere with random waves of up to a quarter of its radius.
    pub(crate) fn add_bumpy(&mut self, center: Vec3, radius: f32, random: &mut impl Rng) {
        let waves: [(Vec3, f32); 4] = std::array::from_fn(|_| {
            let wave = Vec3::from_array(std::array::from_fn(|_| random.random_range(-4.0..4.0)));
            (wave, random.random_range(0.0..TAU))
        });
        self.add_star(center, |direction| {
            let sum: f32 = waves.iter().map(|(wave, at)| (wave.dot(direction) + at).sin()).sum();
            radius * (1.0 + sum / 16.0)
        });
    }

    pub(crate) fn add_box(&mut self, low: Vec3, high: Vec3) {
        let first = self.vertices.len() as u32;
        for corner in 0..8 {
            self.vertices.push(std::array::from_fn(|axis: usize| {
                if corner >> axis & 1 == 0 { low[axis] } else { high[axis] }
            }));
        }
        let sides =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        for [a, b, c, d] in sides {
            for corners in [[a, b, c], [a, c, d]] {
                let corners = corners.map(|corner| first + corner);
                self.triangles.push(Triangle { corners, material: self.count });
            }
        }
        self.count += 1;
    }

    pub(crate) fn closed(&self) -> ClosedSurfaces<'_, [f32; 3]> {
        ClosedSurfaces { vertices: &self.vertices, triangles: &self.triangles }
    }

    pub(crate) fn faces(&self, surface: u32) -> impl Iterator<Item = [Vec3; 3]> + '_ {
        let own = self.triangles.iter().filter(move |one| one.material == surface);
        own.map(|one| one.corners.map(|corner| self.vertices[corner as usize].into()))
    }
}

/// How often closed faces wind around `point`. This sums their solid angles over 4 pi (van
/// Oosterom, Strackee 1983, eq. 8).
pub(super) fn winding_number(point: DVec3, faces: &[[DVec3; 3]]) -> f64 {
    let angles = faces.iter().map(|face| {
        let [a, b, c] = face.map(|corner| corner - point);
        let [la, lb, lc] = [a.length(), b.length(), c.length()];
        let over = a.dot(b.cross(c));
        let under = la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la;
        2.0 * over.atan2(under)
    });
    angles.sum::<f64>() / (4.0 * std::f64::consts::PI)
}

pub(super) struct Solid {
    faces: Vec<[DVec3; 3]>,
    low: DVec3,
    high: DVec3,
}

impl Solid {
    pub(super) fn new(faces: impl Iterator<Item = [Vec3; 3]>) -> Self {
        let faces: Vec<_> = faces.map(|face| face.map(Vec3::as_dvec3)).collect();
        let corners = faces.iter().flatten().copied();
        let low = corners.clone().fold(DVec3::INFINITY, DVec3::min);
        let high = corners.fold(DVec3::NEG_INFINITY, DVec3::max);
        Self { faces, low, high }
    }

    pub(super) fn holds(&self, point: DVec3) -> bool {
        // Nothing winds around a point outside of the bounding box.
        let inside = point.cmpge(self.low).all() && point.cmple(self.high).all();
        inside && winding_number(point, &self.faces) > 0.5
    }

    pub(super) fn has_skin_at(&self, point: DVec3, share: f64) -> bool {
        let near = share * (self.high - self.low).max_element() / 2.0;
        let box_distance = (self.low - point).max(point - self.high).max_element();
        box_distance <= near
            && self.faces.iter().any(|&face| distance_to_triangle(point, face) <= near)
    }

    /// Whether the outline seen from `eye` passes within `near` pixels of `at`.
    pub(super) fn has_outline_at(&self, at: DVec2, near: f64, view: &View) -> bool {
        let fronts =
            self.faces.iter().filter(|[a, b, c]| (*b - *a).cross(*c - *a).dot(view.eye - *a) > 0.0);
        // An edge is of the outline if only one of its two faces faces the eye.
        let mut edges: Vec<[[u64; 3]; 2]> = Vec::new();
        fn bits(corner: DVec3) -> [u64; 3] {
            corner.to_array().map(f64::to_bits)
        }
        for [a, b, c] in fronts.map(|face| face.map(bits)) {
            edges.extend([[a, b], [b, c], [c, a]]);
        }
        edges.sort_unstable();
        let alone = edges.iter().filter(|[a, b]| edges.binary_search(&[*b, *a]).is_err());
        alone.copied().any(|edge| {
            let ends = view
                .segment(edge.map(|bits: [u64; 3]| DVec3::from_array(bits.map(f64::from_bits))));
            ends.is_some_and(|[a, b]| distance_to_segment(at, a, b) <= near)
        })
    }
}

pub(super) struct View {
    pub(super) eye: DVec3,
    pub(super) right: DVec3,
    pub(super) up: DVec3,
    pub(super) forward: DVec3,
    pub(super) near: f64,
    pub(super) focal_px: f64,
    pub(super) middle: DVec2,
}

impl View {
    /// The ends in pixels of the part of a segment beyond the near plane.
    fn segment(&self, [a, b]: [DVec3; 2]) -> Option<[DVec2; 2]> {
        let [to_a, to_b] = [a, b].map(|at| (at - self.eye).dot(self.forward) - self.near);
        if to_a < 0.0 && to_b < 0.0 {
            return None;
        }
        let cut = a + (b - a) * (to_a / (to_a - to_b));
        let ends = [if to_a < 0.0 { cut } else { a }, if to_b < 0.0 { cut } else { b }];
        Some(ends.map(|at| {
            let from_eye = at - self.eye;
            let along = from_eye.dot(self.forward).max(self.near * 0.5);
            let at = DVec2::new(from_eye.dot(self.right), -from_eye.dot(self.up));
            self.middle + at * (self.focal_px / along)
        }))
    }
}

fn distance_to_segment(at: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let share = (at - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
    at.distance(a + along * share.clamp(0.0, 1.0))
}

fn distance_to_triangle(at: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a).normalize_or_zero();
    fn beside(from: DVec3, to: DVec3, at: DVec3, normal: DVec3) -> bool {
        normal.cross(to - from).dot(at - from) >= 0.0
    }
    if normal != DVec3::ZERO
        && beside(a, b, at, normal)
        && beside(b, c, at, normal)
        && beside(c, a, at, normal)
    {
        return (at - a).dot(normal).abs();
    }
    fn to_edge(from: DVec3, to: DVec3, at: DVec3) -> f64 {
        let along = to - from;
        let share = (at - from).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
        at.distance(from + along * share.clamp(0.0, 1.0))
    }
    to_edge(a, b, at).min(to_edge(b, c, at)).min(to_edge(c, a, at))
}

#[test]
fn the_oracle_knows_inside_from_outside() {
    let mut surfaces = Surfaces::default();
    surfaces.add_box(Vec3::ZERO, Vec3::ONE);
    let faces: Vec<_> = surfaces.faces(0).map(|face| face.map(Vec3::as_dvec3)).collect();
    for (x, number) in [(-0.5, 0.0), (0.01, 1.0), (0.99, 1.0), (1.01, 0.0)] {
        let found = winding_number(DVec3::new(x, 0.3, 0.6), &faces);
        assert!((found - number).abs() < 1e-9, "{x}: {found}");
    }
    assert!((distance_to_triangle(DVec3::new(0.6, 0.3, 1.5), faces[2]) - 0.5).abs() < 1e-12);
}

fn place(random: &mut impl Rng, reach: f32) -> Vec3 {
    Vec3::from_array(std::array::from_fn(|_| random.random_range(-reach..reach)))
}

/// A knot and loose triangles, with 1 to 40 closed surfaces among them, seen from anywhere.
pub(crate) fn random_scene(seed: u64) -> Scene {
    let random = &mut ChaCha8Rng::seed_from_u64(seed);
    let loose: Vec<[Vec3; 3]> =
        (0..25).map(|_| std::array::from_fn(|_| place(random, 1.5))).collect();
    let mut mesh = mesh_of(&loose);
    let knot = Mesh::torus_knot(1200);
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(&knot.positions);
    mesh.triangles.extend(
        knot.triangles
            .iter()
            .map(|&one| Triangle { corners: one.corners.map(|corner| corner + first), ..one }),
    );
    let mut surfaces = Surfaces::default();
    for _ in 0..random.random_range(1..=40) {
        let radius = random.random_range(0.2..0.8);
        surfaces.add_bumpy(place(random, 1.5), radius, random);
    }
    let camera = Camera {
        eye: place(random, 2.0),
        target: place(random, 0.5),
        up: Vec3::Y,
        field_of_view_deg: random.random_range(25.0..90.0),
        near: random.random_range(0.01..0.2),
        far: random.random_range(2.0..8.0),
    };
    Scene { mesh, surfaces, camera, size: (97, 61) }
}

fn agreement(seeds: std::ops::Range<u64>) -> CountErrors {
    let found = seeds.map(|seed| {
        let found = random_scene(seed).compared_with_winding_numbers();
        assert_eq!(found.wrong, 0, "scene {seed}: {found:?}");
        found
    });
    found.fold(CountErrors::default(), CountErrors::and)
}

#[test]
fn counts_of_two_hundred_scenes_are_winding_numbers() {
    let found = agreement(0..200);
    assert!(found.samples > 400_000 && found.most >= 5, "{found:?}");
    assert!(found.differ * 1000 <= found.samples, "{found:?}");
}
