//! Maps positions of a model to pixels of a camera's picture and back. It also measures popping,
//! which is how much noise changes between two frames at the same point of the object.

use glam::{Mat4, Vec3, Vec4};
use rayon::prelude::*;

use crate::camera::Camera;
use crate::field::Field;

/// The mapping of one camera and picture size. Use this to go from positions of the model to
/// pixels and depth, and back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projection {
    pub(super) camera: Camera,
    pub(super) width: usize,
    pub(super) height: usize,
    clip_from_model: Mat4,
    model_from_clip: Mat4,
    axes: [Vec3; 2],
    /// Length in pixels of one model unit at a distance of one unit in front of the eye.
    pub(super) focal_px: f32,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Projected {
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) depth: f32,
    pub(super) distance: f32,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ClampedProjected {
    pub(super) x: f32,
    pub(super) y: f32,
    /// Distance in front of the eye, at least the near plane's distance, in the unit of the model.
    pub(super) distance: f32,
    /// True distance in front of the eye, negative behind it.
    pub(super) along: f32,
}

impl Projection {
    /// The projection of `camera` to a picture of `width` x `height` pixels.
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

    /// Projects a position of the model. `None` if it is nearer than the near plane.
    pub(super) fn project(&self, position: Vec3) -> Option<Projected> {
        let clip = self.clip_from_model * position.extend(1.0);
        (clip.w >= self.camera.near && clip.w.is_finite()).then(|| self.screen(clip))
    }

    /// Projects a position of the model. This treats a position nearer than the near plane as if
    /// it lay on the plane.
    pub(super) fn project_clamped(&self, position: Vec3) -> ClampedProjected {
        let mut clip = self.clip_from_model * position.extend(1.0);
        let along = clip.w;
        clip.w = clip.w.max(self.camera.near);
        let Projected { x, y, distance, .. } = self.screen(clip);
        ClampedProjected { x, y, distance, along }
    }

    fn screen(&self, clip: Vec4) -> Projected {
        Projected {
            x: (clip.x / clip.w + 1.0) / 2.0 * self.width as f32,
            y: (1.0 - clip.y / clip.w) / 2.0 * self.height as f32,
            depth: clip.z / clip.w,
            distance: clip.w,
        }
    }

    /// The position of the model at the centre of a pixel and at `depth` (0 to 1).
    #[must_use]
    pub fn unproject(&self, (x, y): (usize, usize), depth: f32) -> Vec3 {
        let row = self.row(y);
        let model = row
            + self.model_from_clip.x_axis * self.column(x)
            + self.model_from_clip.z_axis * depth;
        model.truncate() / model.w
    }

    pub(super) fn axes(&self) -> [Vec3; 2] {
        self.axes
    }

    /// The term of [`Self::unproject`] that all pixels of row `y` share, before the division by w.
    pub(super) fn row(&self, y: usize) -> Vec4 {
        let up = 1.0 - (2 * y + 1) as f32 / self.height as f32;
        self.model_from_clip.w_axis + self.model_from_clip.y_axis * up
    }

    pub(super) fn column(&self, x: usize) -> f32 {
        (2 * x + 1) as f32 / self.width as f32 - 1.0
    }

    pub(super) fn model_from_clip(&self) -> Mat4 {
        self.model_from_clip
    }

    /// Length in pixels of one unit of the model across the viewing direction, at a distance of
    /// one unit in front of the eye.
    #[must_use]
    pub fn focal_px(&self) -> f32 {
        self.focal_px
    }

    /// The camera.
    #[must_use]
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// Width and height of the picture in pixels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// How far a point moves in the picture when the model moves along `direction`: pixels to the
    /// right and downwards, per unit of the model. The point is `distance` in front of the eye and
    /// at (`x`, `y`) in the picture.
    #[must_use]
    pub fn moved(&self, [x, y]: [f32; 2], distance: f32, direction: Vec3) -> [f32; 2] {
        let [right, up] = self.axes;
        let forward = up.cross(right);
        let away = direction.dot(forward);
        let from_x = x - self.width as f32 / 2.0;
        let from_y = y - self.height as f32 / 2.0;
        let [x, y] = [direction.dot(right), -direction.dot(up)];
        [
            (self.focal_px * x - from_x * away) / distance,
            (self.focal_px * y - from_y * away) / distance,
        ]
    }

    /// `near far / (far - near)`. If you divide this by a point's distance and subtract the result
    /// from a constant, you get the point's depth.
    #[must_use]
    pub fn depth_scale(&self) -> f32 {
        let Camera { near, far, .. } = self.camera;
        near * far / (far - near)
    }

    pub(super) fn depth_at(&self, distance: f32) -> f32 {
        let Camera { near, far, .. } = self.camera;
        far / (far - near) - self.depth_scale() / distance
    }

    /// How much depth grows per pixel to the right and downwards on a plane with this `normal`.
    /// `towards` is the dot product of the normal and a vector from the eye to the plane.
    #[must_use]
    pub fn slope(&self, normal: Vec3, towards: f32) -> [f32; 2] {
        let [right, up] = self.axes;
        let scale = -self.depth_scale() / (towards * self.focal_px);
        [scale * normal.dot(right), -scale * normal.dot(up)]
    }
}

/// One frame of noise, with the depth of the object under it.
#[derive(Debug, Clone, Copy)]
pub struct NoiseFrame<'a> {
    /// The camera and picture size of the frame.
    pub projection: &'a Projection,
    /// Depth of each pixel, 1 where the object is not seen.
    pub depth: &'a Field<f32>,
    /// Noise at each pixel.
    pub noise: &'a Field<f32>,
}

/// Differences of noise between frames. You can sum them over several pairs of frames.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Popping {
    /// Sum of squared differences.
    pub squares: f64,
    /// Number of pixels that could be compared.
    pub pixels: usize,
}

impl Popping {
    /// Compares each pixel of `after` with the noise of `before` at the same point of the object,
    /// interpolated between four pixels. This leaves out points that were hidden before or lie
    /// next to the edge of a surface.
    ///
    /// # Panics
    /// If a field does not have the size of its frame.
    #[must_use]
    pub fn between(before: NoiseFrame<'_>, after: NoiseFrame<'_>) -> Self {
        for frame in [before, after] {
            let size = (frame.projection.width, frame.projection.height);
            for field in [frame.depth, frame.noise] {
                assert_eq!(
                    (field.width(), field.height()),
                    size,
                    "depth and noise must have the size of the frame"
                );
            }
        }
        let rows = (0..after.projection.height).into_par_iter().map(|y| {
            let mut found = Self::default();
            for x in 0..after.projection.width {
                let depth = after.depth[(x, y)];
                if depth < 1.0
                    && let Some(noise) = noise_before(before, after.projection, (x, y), depth)
                {
                    found.squares += f64::from(after.noise[(x, y)] - noise).powi(2);
                    found.pixels += 1;
                }
            }
            found
        });
        let rows: Vec<Self> = rows.collect();
        rows.into_iter().fold(Self::default(), Self::merge)
    }

    /// The sum of two measurements.
    #[must_use]
    pub fn merge(self, other: Self) -> Self {
        Self { squares: self.squares + other.squares, pixels: self.pixels + other.pixels }
    }

    /// Root mean square difference, 0 if no pixel could be compared.
    #[must_use]
    pub fn rms(&self) -> f64 {
        (self.squares / self.pixels.max(1) as f64).sqrt()
    }
}

fn noise_before(
    before: NoiseFrame<'_>,
    projection: &Projection,
    pixel: (usize, usize),
    depth: f32,
) -> Option<f32> {
    let at = before.projection.project(projection.unproject(pixel, depth))?;
    let left = (at.x - 0.5).floor();
    let top = (at.y - 0.5).floor();
    fn inside(at: f32, size: usize) -> bool {
        at >= 0.0 && at < size as f32 - 1.0
    }
    if !inside(left, before.projection.width) || !inside(top, before.projection.height) {
        return None;
    }
    let x = left as usize;
    let y = top as usize;
    let right = at.x - 0.5 - left;
    let down = at.y - 0.5 - top;
    let [surface, noise] = [before.depth, before.noise].map(|field: &Field<f32>| {
        let [above, below] =
            [y, y + 1].map(|y| field[(x, y)] * (1.0 - right) + field[(x + 1, y)] * right);
        above * (1.0 - down) + below * down
    });
    let corners = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
    let all_seen = corners.iter().all(|&corner| before.depth[corner] < 1.0);
    // Tolerance in depth: about the change over three pixels of a slanted surface.
    let slack = 3.0 * before.projection.depth_scale() / (before.projection.focal_px * at.distance);
    let same = (surface - at.depth).abs() < slack;
    (all_seen && same).then_some(noise)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::surface::{NO_TRIANGLE, position_at, visible};

    #[test]
    fn places_from_depth_are_those_of_the_mesh_and_slopes_are_those_of_the_picture() {
        let mesh = Mesh::sphere(500);
        let camera = Camera::framing(mesh.bounds(), 40.0, 25.0, 30.0);
        let projection = Projection::new(&camera, 90, 60);
        let visible = visible(&mesh, &camera, 90, 60);
        let mut slopes = 0;
        for y in 0..59 {
            for x in 0..89 {
                let seen = visible[(x, y)];
                if seen.triangle == NO_TRIANGLE {
                    continue;
                }
                let place = position_at(&mesh, seen);
                assert!(place.distance(projection.unproject((x, y), seen.depth)) < 1e-3, "{x} {y}");
                let at = projection.project(place).unwrap();
                assert!((at.x - x as f32 - 0.5).abs() < 0.05, "{x}: {at:?}");
                assert!((at.y - y as f32 - 0.5).abs() < 0.05, "{y}: {at:?}");
                let corners = mesh.triangles[seen.triangle as usize].corners;
                let [a, b, c] = corners.map(|i| Vec3::from(mesh.positions[i as usize]));
                let normal = (b - a).cross(c - a).normalize();
                let slope = projection.slope(normal, normal.dot(place - camera.eye));
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

    #[test]
    fn a_direction_moves_a_point_as_its_projection_does() {
        let camera = Camera::framing(Mesh::sphere(100).bounds(), 40.0, 25.0, 50.0);
        let projection = Projection::new(&camera, 90, 60);
        for direction in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(0.3, -0.5, 0.8)] {
            let place = Vec3::new(0.5, -0.3, 0.4);
            let before = projection.project(place - direction * 1e-2).unwrap();
            let after = projection.project(place + direction * 1e-2).unwrap();
            let at = projection.project(place).unwrap();
            let [x, y] = projection.moved([at.x, at.y], at.distance, direction);
            assert!(((after.x - before.x) / 2e-2 - x).abs() < 0.05, "{direction}: {x}");
            assert!(((after.y - before.y) / 2e-2 - y).abs() < 0.05, "{direction}: {y}");
        }
    }
}
