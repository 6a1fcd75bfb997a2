//! Cameras placed so that a whole model fits into the picture.

use glam::Vec3;
use rayon::prelude::*;

use super::perspective::Camera;

/// Share of the picture's half width and half height that the model may fill; the rest is
/// margin (chosen by eye).
const FILLED: f32 = 0.92;

/// Viewing direction and picture shape, from which a camera is placed around a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Framing {
    /// Azimuth of the camera about the y axis, in degrees: 0 looks along -z, 90 along -x.
    pub azimuth_deg: f32,
    /// Elevation of the camera above the horizon, in degrees, -90 to 90.
    pub elevation_deg: f32,
    /// Vertical field of view in degrees, above 0 and below 180.
    pub field_of_view_deg: f32,
    /// Width of the picture by its height, above 0.
    pub aspect: f32,
}

impl Default for Framing {
    /// From the front and slightly above, with a portrait lens, in a square picture.
    fn default() -> Self {
        Self { azimuth_deg: 30.0, elevation_deg: 20.0, field_of_view_deg: 30.0, aspect: 1.0 }
    }
}

impl Framing {
    /// Nearest camera that sees a whole bounding box with a margin; it looks at the centre of
    /// the box. For `bounds` see [`crate::mesh::Mesh::bounds`].
    #[must_use]
    pub fn camera(&self, bounds: [Vec3; 2]) -> Camera {
        self.at(bounds, self.distance(bounds))
    }

    /// Cameras of one full turn around a bounding box in `frames` equal steps, all at the
    /// distance from which the box always fits.
    #[must_use]
    pub fn turntable(&self, bounds: [Vec3; 2], frames: usize) -> Vec<Camera> {
        let turned = |degrees| Self { azimuth_deg: self.azimuth_deg + degrees, ..*self };
        let distances = (0..360).map(|degrees| turned(degrees as f32).distance(bounds));
        let distance = distances.fold(0.0, f32::max);
        let step = 360.0 / frames.max(1) as f32;
        (0..frames).map(|frame| turned(frame as f32 * step).at(bounds, distance)).collect()
    }

    /// Nearest camera that sees all `positions` with a margin and centres them. It comes
    /// closer than [`Framing::camera`], which fits their bounding box.
    #[must_use]
    pub fn fit(&self, positions: &[[f32; 3]]) -> Camera {
        let bounds = bounds_of(positions);
        let reach = self.reach(positions, bounds);
        self.shifted(bounds, reach.distance(self.tangents()), reach.shift())
    }

    /// Cameras of one full turn around `positions` in `frames` equal steps, all at one
    /// distance and height from which they always fit.
    #[must_use]
    pub fn fit_turntable(&self, positions: &[[f32; 3]], frames: usize) -> Vec<Camera> {
        let bounds = bounds_of(positions);
        let turned = |degrees| Self { azimuth_deg: self.azimuth_deg + degrees, ..*self };
        let reaches = (0..120).map(|step| turned(step as f32 * 3.0).reach(positions, bounds));
        let Reach { right, up } = reaches.fold(Reach::default(), Reach::or);
        // The axis of rotation stays in the centre.
        let reach = Reach { right: [right[0].max(right[1]); 2], up };
        let distance = reach.distance(self.tangents());
        let shift = reach.shift();
        let step = 360.0 / frames.max(1) as f32;
        (0..frames)
            .map(|frame| turned(frame as f32 * step).shifted(bounds, distance, shift))
            .collect()
    }

    /// Half the width and height that fit into the picture at distance 1.
    fn tangents(&self) -> [f32; 2] {
        let high = (self.field_of_view_deg / 2.0).to_radians().tan() * FILLED;
        [high * self.aspect, high]
    }

    fn reach(&self, positions: &[[f32; 3]], bounds: [Vec3; 2]) -> Reach {
        let [back, up, right] = self.axes();
        let middle = (bounds[0] + bounds[1]) / 2.0;
        let [wide, high] = self.tangents();
        let reaches = positions.par_iter().with_min_len(1 << 12).map(|&position| {
            let from_middle = Vec3::from(position) - middle;
            let [x, y, z] = [right, up, back].map(|axis| from_middle.dot(axis));
            Reach { right: [x + wide * z, wide * z - x], up: [y + high * z, high * z - y] }
        });
        // A maximum does not depend on the order of reduction.
        reaches.reduce(Reach::default, Reach::or)
    }

    /// Camera at `distance`, moved by `x` to the right and `y` upwards.
    fn shifted(&self, bounds: [Vec3; 2], distance: f32, [x, y]: [f32; 2]) -> Camera {
        let [_, up, right] = self.axes();
        let shift = right * x + up * y;
        let camera = self.at(bounds, distance.max(half_size(bounds).length() * 1e-3));
        Camera {
            eye: camera.eye + shift,
            target: camera.target + shift,
            far: camera.far + shift.length(),
            ..camera
        }
    }

    /// The camera's backward, up and right axes as unit vectors.
    fn axes(&self) -> [Vec3; 3] {
        let (sin_a, cos_a) = self.azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = self.elevation_deg.to_radians().sin_cos();
        [
            Vec3::new(sin_a * cos_e, sin_e, cos_a * cos_e),
            Vec3::new(-sin_a * sin_e, cos_e, -cos_a * sin_e),
            Vec3::new(cos_a, 0.0, -sin_a),
        ]
    }

    /// Distance from the centre of the box to the eye.
    fn distance(&self, bounds: [Vec3; 2]) -> f32 {
        let [back, up, right] = self.axes();
        let half = half_size(bounds);
        let [wide, high] = self.tangents();
        let corners = (0..8).map(|corner| {
            let sign = |bit: i32| if corner & bit == 0 { 1.0 } else { -1.0 };
            half * Vec3::new(sign(1), sign(2), sign(4))
        });
        // A corner is visible if its height is at most `high` times its distance along the
        // viewing direction.
        let distances = corners.map(|corner| {
            let least = (corner.dot(up).abs() / high).max(corner.dot(right).abs() / wide);
            least + corner.dot(back)
        });
        distances.fold(half.length() * 1e-3, f32::max)
    }

    fn at(&self, bounds: [Vec3; 2], distance: f32) -> Camera {
        let [back, up, _] = self.axes();
        let target = (bounds[0] + bounds[1]) / 2.0;
        let radius = half_size(bounds).length();
        Camera {
            eye: target + back * distance,
            target,
            up,
            field_of_view_deg: self.field_of_view_deg,
            near: (0.9 * (distance - radius)).max(distance * 0.01),
            far: distance + radius * 1.1,
        }
    }
}

/// Extent of points in a picture. For each picture axis: the maximum of coordinate plus
/// edge tangent times depth towards the viewer, then the same for the negated coordinate.
#[derive(Debug, Clone, Copy)]
struct Reach {
    right: [f32; 2],
    up: [f32; 2],
}

impl Default for Reach {
    fn default() -> Self {
        Self { right: [f32::NEG_INFINITY; 2], up: [f32::NEG_INFINITY; 2] }
    }
}

impl Reach {
    fn or(self, other: Self) -> Self {
        let greater = |a: [f32; 2], b: [f32; 2]| [a[0].max(b[0]), a[1].max(b[1])];
        Self { right: greater(self.right, other.right), up: greater(self.up, other.up) }
    }

    /// Smallest distance at which both axes fit.
    fn distance(self, [wide, high]: [f32; 2]) -> f32 {
        let [right, up] = [self.right, self.up].map(|[a, b]| (a + b) / 2.0);
        (right / wide).max(up / high)
    }

    /// Shift that centres both axes.
    fn shift(self) -> [f32; 2] {
        [self.right, self.up].map(|[a, b]| if a.is_finite() { (a - b) / 2.0 } else { 0.0 })
    }
}

fn bounds_of(positions: &[[f32; 3]]) -> [Vec3; 2] {
    let mut positions = positions.iter().map(|&position| Vec3::from(position));
    let first = positions.next().unwrap_or_default();
    positions.fold([first; 2], |[low, high], position| [low.min(position), high.max(position)])
}

/// Vector from the centre of a box to its highest corner; a box of size 0 counts as one
/// of size 1.
fn half_size(bounds: [Vec3; 2]) -> Vec3 {
    let half = (bounds[1] - bounds[0]) / 2.0;
    if half.max_element() > 0.0 { half } else { Vec3::splat(0.5) }
}

impl Camera {
    /// Nearest camera that sees a whole bounding box in a picture at least as wide as high.
    /// See [`Framing`] for the angles and other picture shapes.
    #[must_use]
    pub fn framing(
        bounds: [Vec3; 2],
        azimuth_deg: f32,
        elevation_deg: f32,
        field_of_view_deg: f32,
    ) -> Self {
        let framing = Framing { azimuth_deg, elevation_deg, field_of_view_deg, aspect: 1.0 };
        framing.camera(bounds)
    }
}
