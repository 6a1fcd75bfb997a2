//! Vertices and triangles on the screen, cut where they leave the view.

use glam::{Mat4, Vec4};
use rayon::prelude::*;

use super::packed::Placed;

/// Steps in a pixel that vertices are moved to, as graphics devices do it: edges
/// are then exact.
pub(super) const STEPS: i32 = 256;

/// How far beyond the edge of the picture a triangle may reach uncut, in halves
/// of its size: whole numbers suffice for its edges.
const GUARD: f32 = 16.0;

/// A vertex in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    /// To the right and downwards, in steps.
    pub(super) x: i32,
    pub(super) y: i32,
    /// 0 (near) to 1 (far).
    pub(super) depth: f32,
    /// 1 / w of its clip coordinates; 0 where it is beyond the guard: then `x` has a
    /// bit for every plane that it is beyond.
    pub(super) inverse_w: f32,
}

/// From clip coordinates to a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Screen {
    clip_from_model: Mat4,
    half_width: f32,
    half_height: f32,
}

/// A corner of what is left of a cut triangle.
#[derive(Debug, Clone, Copy)]
struct Cut {
    clip: Vec4,
    /// Weights of the triangle's second and third corner there.
    weights: [f32; 2],
}

impl Screen {
    pub(super) fn new(clip_from_model: Mat4, width: usize, height: usize) -> Self {
        let [half_width, half_height] = [width, height].map(|cells| cells as f32 / 2.0);
        Self { clip_from_model, half_width, half_height }
    }

    /// The vertex at a place of the model.
    fn corner(&self, place: [f32; 3]) -> Corner {
        let clip = self.clip(place);
        let beyond = |plane: &Vec4| i32::from(plane.dot(clip) < 0.0 || clip.is_nan());
        match PLANES.iter().fold(0, |bits, plane| bits << 1 | beyond(plane)) {
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

    /// The same of many places, into `corners`.
    pub(super) fn corners(&self, places: &[impl Placed], corners: &mut Vec<Corner>) {
        let each = places.par_iter().with_min_len(1 << 11).map(|at| self.corner(at.place()));
        each.collect_into_vec(corners);
    }

    /// What of a triangle is within the view and the guard around it, as a convex
    /// polygon; less than three corners where nothing is.
    pub(super) fn cut(&self, places: [[f32; 3]; 3]) -> Vec<(Corner, [f32; 2])> {
        let weights = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let clips = places.map(|place| self.clip(place));
        let mut polygon: Vec<Cut> =
            clips.into_iter().zip(weights).map(|(clip, weights)| Cut { clip, weights }).collect();
        for plane in PLANES {
            let sides: Vec<f32> = polygon.iter().map(|at| plane.dot(at.clip)).collect();
            let mut left = Vec::with_capacity(polygon.len() + 1);
            for (i, &here) in polygon.iter().enumerate() {
                let next = (i + 1) % polygon.len();
                if sides[i] >= 0.0 {
                    left.push(here);
                }
                // Always from the inside outwards, so that two triangles that share
                // the edge are cut at the same place.
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

/// The near and the far plane, then the guard; inside is where the product with
/// clip coordinates is not negative.
const PLANES: [Vec4; 6] = [
    Vec4::new(0.0, 0.0, 1.0, 0.0),
    Vec4::new(0.0, 0.0, -1.0, 1.0),
    Vec4::new(1.0, 0.0, 0.0, GUARD),
    Vec4::new(-1.0, 0.0, 0.0, GUARD),
    Vec4::new(0.0, 1.0, 0.0, GUARD),
    Vec4::new(0.0, -1.0, 0.0, GUARD),
];

fn between(from: Cut, to: Cut, share: f32) -> Cut {
    let weights =
        std::array::from_fn(|i| from.weights[i] + (to.weights[i] - from.weights[i]) * share);
    Cut { clip: from.clip + (to.clip - from.clip) * share, weights }
}

/// The pixels, of `count`, whose middles are from `low` to `high`, which are in steps.
pub(super) fn middles(low: i32, high: i32, count: usize) -> std::ops::Range<usize> {
    let first = (low + STEPS / 2 - 1).div_euclid(STEPS).max(0) as usize;
    let after = ((high + STEPS / 2).div_euclid(STEPS).max(0) as usize).min(count);
    first..after.max(first)
}
