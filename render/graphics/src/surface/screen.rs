//! Vertices projected to the picture, and triangles clipped where they leave the view.

use glam::{Mat4, Vec4};
use rayon::prelude::*;

use super::packed::Positioned;

/// Vertices are rounded to this many steps per pixel, as graphics devices do (8 bits of
/// sub-pixel precision), so that edge functions are exact in integers.
pub(super) const STEPS: i32 = 256;

/// Size of the guard band: triangles are clipped where they reach further than this from
/// the centre of the picture, in halves of its size. Keeps edge functions within 64 bits.
const GUARD: f32 = 16.0;

/// A vertex projected to the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    /// Distance from the left edge, in [`STEPS`] of a pixel.
    pub(super) x: i32,
    /// Distance from the upper edge, in [`STEPS`] of a pixel.
    pub(super) y: i32,
    /// Depth, 0 (near plane) to 1 (far plane).
    pub(super) depth: f32,
    /// 1 / w of the clip coordinates. 0 outside the guard band; `x` then has one bit for
    /// each plane of [`PLANES`] that the vertex is beyond.
    pub(super) inverse_w: f32,
}

/// The transform from model coordinates to pixels of a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Screen {
    clip_from_model: Mat4,
    half_width: f32,
    half_height: f32,
    planes: [Vec4; 6],
}

/// A corner of a clipped triangle.
#[derive(Debug, Clone, Copy)]
struct ClippedCorner {
    clip: Vec4,
    /// Barycentric weights of the triangle's second and third corner.
    weights: [f32; 2],
}

impl Screen {
    pub(super) fn new(clip_from_model: Mat4, width: usize, height: usize) -> Self {
        let [half_width, half_height] = [width, height].map(|cells| cells as f32 / 2.0);
        Self { clip_from_model, half_width, half_height, planes: PLANES }
    }

    /// This transform without a far plane: nothing is too far away, and depth may exceed 1.
    pub(super) fn without_far_plane(mut self) -> Self {
        self.planes[FAR] = BEFORE_EYE;
        self
    }

    /// Projects one position of the model.
    fn corner(&self, position: [f32; 3]) -> Corner {
        let clip = self.clip(position);
        let beyond = |plane: &Vec4| i32::from(plane.dot(clip) < 0.0 || clip.is_nan());
        match self.planes.iter().fold(0, |bits, plane| bits << 1 | beyond(plane)) {
            0 => self.project(clip),
            x => Corner { x, y: 0, depth: 0.0, inverse_w: 0.0 },
        }
    }

    fn clip(&self, [x, y, z]: [f32; 3]) -> Vec4 {
        self.clip_from_model * Vec4::new(x, y, z, 1.0)
    }

    fn project(&self, clip: Vec4) -> Corner {
        let inverse_w = 1.0 / clip.w;
        let steps = |at: f32, half: f32| ((1.0 + at) * (half * STEPS as f32)).round() as i32;
        Corner {
            x: steps(clip.x * inverse_w, self.half_width),
            y: steps(-clip.y * inverse_w, self.half_height),
            depth: clip.z * inverse_w,
            inverse_w,
        }
    }

    /// Projects many positions of the model into `corners`, which is overwritten.
    pub(super) fn corners(&self, positions: &[impl Positioned], corners: &mut Vec<Corner>) {
        let each = positions.par_iter().with_min_len(1 << 11).map(|at| self.corner(at.position()));
        each.collect_into_vec(corners);
    }

    /// Clips a triangle to the view frustum plus guard band. Returns a convex polygon of 0
    /// or 3 to 9 projected corners, each with the barycentric weights of the triangle's
    /// second and third corner.
    pub(super) fn clip_triangle(&self, positions: [[f32; 3]; 3]) -> Vec<(Corner, [f32; 2])> {
        let weights = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let clips = positions.map(|position| self.clip(position));
        let mut polygon: Vec<ClippedCorner> = clips
            .into_iter()
            .zip(weights)
            .map(|(clip, weights)| ClippedCorner { clip, weights })
            .collect();
        for plane in self.planes {
            let sides: Vec<f32> = polygon.iter().map(|at| plane.dot(at.clip)).collect();
            let mut left = Vec::with_capacity(polygon.len() + 1);
            for (i, &here) in polygon.iter().enumerate() {
                let next = (i + 1) % polygon.len();
                if sides[i] >= 0.0 {
                    left.push(here);
                }
                // Always interpolated from the inside outwards, so that two triangles that
                // share the edge are clipped at the same point.
                if sides[i] >= 0.0 && sides[next] < 0.0 {
                    left.push(between(here, polygon[next], sides[i] / (sides[i] - sides[next])));
                } else if sides[i] < 0.0 && sides[next] >= 0.0 {
                    left.push(between(polygon[next], here, sides[next] / (sides[next] - sides[i])));
                }
            }
            polygon = left;
        }
        polygon.iter().map(|at| (self.project(at.clip), at.weights)).collect()
    }
}

/// Position of the far plane in [`PLANES`].
const FAR: usize = 1;

/// The plane through the eye along the picture: everything beyond the near plane is inside.
const BEFORE_EYE: Vec4 = Vec4::W;

/// Near and far plane, then the four planes of the guard band. A point is inside where the
/// dot product with its clip coordinates is not negative.
const PLANES: [Vec4; 6] = [
    Vec4::new(0.0, 0.0, 1.0, 0.0),
    Vec4::new(0.0, 0.0, -1.0, 1.0),
    Vec4::new(1.0, 0.0, 0.0, GUARD),
    Vec4::new(-1.0, 0.0, 0.0, GUARD),
    Vec4::new(0.0, 1.0, 0.0, GUARD),
    Vec4::new(0.0, -1.0, 0.0, GUARD),
];

fn between(from: ClippedCorner, to: ClippedCorner, share: f32) -> ClippedCorner {
    let weights =
        std::array::from_fn(|i| from.weights[i] + (to.weights[i] - from.weights[i]) * share);
    ClippedCorner { clip: from.clip + (to.clip - from.clip) * share, weights }
}

/// The pixels, out of `count` in a row or column, whose centres lie from `low` to `high`,
/// both in [`STEPS`] of a pixel.
pub(super) fn pixel_range(low: i32, high: i32, count: usize) -> std::ops::Range<usize> {
    let first = (low + STEPS / 2 - 1).div_euclid(STEPS).max(0) as usize;
    let after = ((high + STEPS / 2).div_euclid(STEPS).max(0) as usize).min(count);
    first..after.max(first)
}
