//! A camera with the picture it takes.

use glam::{Mat4, Vec3, Vec4};

use crate::camera::Camera;
use crate::field::Field;
use crate::surface::Visible;

/// Where places of the model come to lie in a picture, and the way back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    pub(super) camera: Camera,
    pub(super) width: usize,
    pub(super) height: usize,
    clip_from_model: Mat4,
    model_from_clip: Mat4,
    /// To the right and upwards in the picture.
    axes: [Vec3; 2],
    /// Pixels of what is one unit long, one unit in front of the eye.
    pub(super) focal_px: f32,
}

/// A place of the model in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Projected {
    /// To the right and downwards from the upper left corner, in pixels.
    pub(super) x: f32,
    pub(super) y: f32,
    /// 0 (near) to 1 (far).
    pub(super) depth: f32,
    /// In front of the eye, in the unit of the model.
    pub(super) distance: f32,
}

/// A place in the picture, brought before the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Beyond {
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) distance: f32,
    /// How far in front of the eye it is indeed; negative behind it.
    pub(super) along: f32,
}

impl Sight {
    /// What `camera` takes in `width` x `height` pixels.
    #[must_use]
    pub fn new(camera: &Camera, width: usize, height: usize) -> Self {
        let clip_from_model = camera.clip_from_model(width as f32 / height.max(1) as f32);
        let right = (camera.target - camera.eye).cross(camera.up).normalize_or_zero();
        let up = right.cross(camera.target - camera.eye).normalize_or_zero();
        let half = (camera.field_of_view_deg / 2.0).to_radians().tan();
        Self {
            camera: *camera,
            width,
            height,
            clip_from_model,
            model_from_clip: clip_from_model.inverse(),
            axes: [right, up],
            focal_px: height as f32 / 2.0 / half,
        }
    }

    /// Where `place` lies; none if it is not beyond the near plane.
    pub(super) fn project(&self, place: Vec3) -> Option<Projected> {
        let clip = self.clip_from_model * place.extend(1.0);
        (clip.w >= self.camera.near && clip.w.is_finite()).then(|| self.screen(clip))
    }

    /// The same, and where it is not, as if it lay on the near plane.
    pub(super) fn beyond_near(&self, place: Vec3) -> Beyond {
        let mut clip = self.clip_from_model * place.extend(1.0);
        let along = clip.w;
        clip.w = clip.w.max(self.camera.near);
        let Projected { x, y, distance, .. } = self.screen(clip);
        Beyond { x, y, distance, along }
    }

    fn screen(&self, clip: Vec4) -> Projected {
        Projected {
            x: (clip.x / clip.w + 1.0) / 2.0 * self.width as f32,
            y: (1.0 - clip.y / clip.w) / 2.0 * self.height as f32,
            depth: clip.z / clip.w,
            distance: clip.w,
        }
    }

    /// The place of the model that the middle of a pixel sees at `depth`.
    #[must_use]
    pub fn place(&self, (x, y): (usize, usize), depth: f32) -> Vec3 {
        let row = self.row(y);
        let model = row
            + self.model_from_clip.x_axis * self.column(x)
            + self.model_from_clip.z_axis * depth;
        model.truncate() / model.w
    }

    /// What a row of pixels adds to places, before the division.
    pub(super) fn row(&self, y: usize) -> Vec4 {
        let up = 1.0 - (2 * y + 1) as f32 / self.height as f32;
        self.model_from_clip.w_axis + self.model_from_clip.y_axis * up
    }

    /// The middle of a column, from -1 to 1.
    pub(super) fn column(&self, x: usize) -> f32 {
        (2 * x + 1) as f32 / self.width as f32 - 1.0
    }

    /// From clip coordinates to the model's.
    pub(super) fn model_from_clip(&self) -> Mat4 {
        self.model_from_clip
    }

    /// The place in the picture of what is seen at `place`, as (x, y, depth): for
    /// following it from frame to frame. None behind the near plane.
    #[must_use]
    pub fn seen_at(&self, place: Vec3) -> Option<Vec3> {
        self.project(place).map(|at| Vec3::new(at.x, at.y, at.depth))
    }

    /// `near far / (far - near)`: depth is a constant less this by distance.
    pub(super) fn depth_scale(&self) -> f32 {
        let Camera { near, far, .. } = self.camera;
        near * far / (far - near)
    }

    /// By how much depth grows to the right and downwards, per pixel, on the plane
    /// through `place`; `towards` is its normal times what leads from the eye to
    /// it.
    pub(super) fn slope(&self, normal: Vec3, towards: f32) -> [f32; 2] {
        let [right, up] = self.axes;
        let scale = -self.depth_scale() / (towards * self.focal_px);
        [scale * normal.dot(right), -scale * normal.dot(up)]
    }
}

/// The depth of every pixel, 1 where nothing is seen.
#[must_use]
pub fn depth_of(visible: &Visible) -> Field<f32> {
    let depths = visible.values().iter().map(|seen| seen.depth);
    Field::from_values(visible.width(), visible.height(), depths.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::surface::{NOTHING, position_at, visible};

    #[test]
    fn places_from_depth_are_those_of_the_mesh_and_slopes_are_those_of_the_picture() {
        let mesh = Mesh::sphere(500);
        let camera = Camera::framing(mesh.bounds(), 40.0, 25.0, 30.0);
        let sight = Sight::new(&camera, 90, 60);
        let visible = visible(&mesh, &camera, 90, 60);
        let mut slopes = 0;
        for y in 0..59 {
            for x in 0..89 {
                let seen = visible[(x, y)];
                if seen.triangle == NOTHING {
                    continue;
                }
                let place = position_at(&mesh, seen);
                assert!(place.distance(sight.place((x, y), seen.depth)) < 1e-3, "{x} {y}");
                let at = sight.project(place).unwrap();
                assert!((at.x - x as f32 - 0.5).abs() < 0.05, "{x}: {at:?}");
                assert!((at.y - y as f32 - 0.5).abs() < 0.05, "{y}: {at:?}");
                let corners = mesh.triangles[seen.triangle as usize].corners;
                let [a, b, c] = corners.map(|i| Vec3::from(mesh.positions[i as usize]));
                let normal = (b - a).cross(c - a).normalize();
                let slope = sight.slope(normal, normal.dot(place - camera.eye));
                for (beside, slope) in [((x + 1, y), slope[0]), ((x, y + 1), slope[1])] {
                    if visible[beside].triangle == seen.triangle {
                        let found = visible[beside].depth - seen.depth;
                        let error = (found - slope).abs();
                        assert!(error < 0.02 * found.abs() + 1e-5, "{found}, {slope}");
                        slopes += 1;
                    }
                }
            }
        }
        assert!(slopes > 600, "{slopes}");
    }
}
