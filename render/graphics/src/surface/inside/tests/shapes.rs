//! Closed surfaces and pictures for tests.

use std::f32::consts::{PI, TAU};

use glam::Vec3;
use rand::{Rng, RngExt};

use crate::mesh::Triangle;
use crate::surface::ClosedSurfaces;

/// Closed surfaces in one list, as counting takes them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Surfaces {
    pub(crate) vertices: Vec<[f32; 3]>,
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) count: u32,
}

/// Corners from pole to pole, and around.
const RINGS: u32 = 10;
const AROUND: u32 = 14;

impl Surfaces {
    /// Adds a closed surface around `center`: the directions of a sphere, each as far as
    /// `radius` says.
    pub(crate) fn add_star(&mut self, center: Vec3, radius: impl Fn(Vec3) -> f32) {
        let first = self.vertices.len() as u32;
        let mut push = |direction: Vec3| {
            self.vertices.push((center + direction * radius(direction)).to_array());
        };
        push(Vec3::Y);
        for ring in 1..RINGS {
            let (high, wide) = (PI * ring as f32 / RINGS as f32).sin_cos();
            for step in 0..AROUND {
                let (x, z) = (TAU * step as f32 / AROUND as f32).sin_cos();
                push(Vec3::new(x * high, wide, z * high));
            }
        }
        push(Vec3::NEG_Y);
        let last = first + 1 + (RINGS - 1) * AROUND;
        let at = |ring: u32, step: u32| match ring {
            0 => first,
            RINGS => last,
            _ => first + 1 + (ring - 1) * AROUND + step % AROUND,
        };
        for ring in 0..RINGS {
            for step in 0..AROUND {
                let [a, b] = [at(ring, step), at(ring, step + 1)];
                let [c, d] = [at(ring + 1, step), at(ring + 1, step + 1)];
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

    /// Adds a sphere of triangles.
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

    /// Adds the box between two corners.
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

    /// The triangles of one surface.
    pub(crate) fn faces(&self, surface: u32) -> impl Iterator<Item = [Vec3; 3]> + '_ {
        let own = self.triangles.iter().filter(move |one| one.material == surface);
        own.map(|one| one.corners.map(|corner| self.vertices[corner as usize].into()))
    }
}
