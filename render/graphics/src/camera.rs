//! Perspective cameras. You can place one yourself, let it frame a model or a picture, or move it
//! through the keyframes of a TOML file.

use std::path::Path;

use documents::hint::Explain;
use documents::text::{Source, TextError, read_text};
use glam::camera::rh::proj::directx::{perspective, perspective_infinite};
use glam::camera::rh::view::look_at_mat4;
use glam::{DVec3, Mat4, Vec2, Vec3};
use rayon::prelude::*;
use serde::Deserialize;

/// A perspective camera. Positions are in the model's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Position of the eye.
    pub eye: Vec3,
    /// Point that appears in the centre of the picture.
    pub target: Vec3,
    /// Approximate up direction. Must not be parallel to the viewing direction.
    pub up: Vec3,
    /// Vertical field of view in degrees, above 0 and below 180.
    pub field_of_view_deg: f32,
    /// Distance of the near clipping plane, above 0.
    pub near: f32,
    /// Distance of the far clipping plane, above `near`.
    pub far: f32,
}

impl Camera {
    /// The camera's right, up and backward axes as unit vectors.
    #[must_use]
    pub fn axes(&self) -> [Vec3; 3] {
        let back = (self.eye - self.target).normalize();
        let right = self.up.cross(back).normalize();
        [right, back.cross(right), back]
    }

    /// Matrix from model coordinates to clip coordinates as WebGPU defines them: x right, y
    /// up, z from 0 (near) to w (far). `aspect` is width divided by height.
    #[must_use]
    pub fn clip_from_model(&self, aspect: f32) -> Mat4 {
        let view = look_at_mat4(self.eye, self.target, self.up);
        let field = self.field_of_view_deg.to_radians();
        perspective(field, aspect, self.near, self.far) * view
    }

    /// Like [`Self::clip_from_model`], but without a far plane. Multiply the depth that this matrix
    /// gives by [`Self::depth_scale`] to get the depth of this camera. The product is above 1
    /// beyond the far plane.
    #[must_use]
    pub fn endless_clip_from_model(&self, aspect: f32) -> Mat4 {
        let view = look_at_mat4(self.eye, self.target, self.up);
        let field = self.field_of_view_deg.to_radians();
        perspective_infinite(field, aspect, self.near) * view
    }

    /// This camera's depth divided by the depth of the same camera without a far plane, above 1.
    #[must_use]
    pub fn depth_scale(&self) -> f32 {
        self.far / (self.far - self.near)
    }
}

/// Share of the picture's half width and half height that the model may fill. The rest is margin
/// (chosen by eye).
const FILLED: f32 = 0.92;

/// Viewing direction and picture shape. Use this to place a camera around a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Framing {
    /// Azimuth of the camera about the y axis, in degrees: 0 looks along -z, 90 along -x.
    pub azimuth_deg: f32,
    /// Elevation of the camera above the horizon, in degrees, -90 to 90.
    pub elevation_deg: f32,
    /// Vertical field of view in degrees, above 0 and below 180.
    pub field_of_view_deg: f32,
    /// Width of the picture divided by its height, above 0.
    pub aspect: f32,
}

impl Default for Framing {
    /// A portrait lens looks from the front and slightly above, in a square picture.
    fn default() -> Self {
        Self { azimuth_deg: 30.0, elevation_deg: 20.0, field_of_view_deg: 30.0, aspect: 1.0 }
    }
}

impl Framing {
    /// Nearest camera that sees a whole bounding box with a margin. It looks at the centre of the
    /// box. For `bounds` see [`crate::mesh::Mesh::bounds`].
    #[must_use]
    pub fn camera(&self, bounds: [Vec3; 2]) -> Camera {
        self.at(bounds, self.distance(bounds))
    }

    /// Cameras of one full turn around a bounding box in `frames` equal steps, all at a distance
    /// from which the box always fits.
    #[must_use]
    pub fn turntable(&self, bounds: [Vec3; 2], frames: usize) -> Vec<Camera> {
        let distances = (0..360).map(|degrees| self.rotated(degrees as f32).distance(bounds));
        let distance = distances.fold(0.0, f32::max);
        let step = 360.0 / frames.max(1) as f32;
        (0..frames).map(|frame| self.rotated(frame as f32 * step).at(bounds, distance)).collect()
    }

    fn rotated(&self, degrees: f32) -> Self {
        Self { azimuth_deg: self.azimuth_deg + degrees, ..*self }
    }

    /// Nearest camera that sees all `positions` with a margin and centres them. This camera comes
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
        let reaches = (0..120).map(|step| self.rotated(step as f32 * 3.0).reach(positions, bounds));
        let Reach { right, up } = reaches.fold(Reach::default(), Reach::or);
        // The axis of rotation stays in the centre.
        let reach = Reach { right: [right[0].max(right[1]); 2], up };
        let distance = reach.distance(self.tangents());
        let shift = reach.shift();
        let step = 360.0 / frames.max(1) as f32;
        (0..frames)
            .map(|frame| self.rotated(frame as f32 * step).shifted(bounds, distance, shift))
            .collect()
    }

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

    fn axes(&self) -> [Vec3; 3] {
        let (sin_a, cos_a) = self.azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = self.elevation_deg.to_radians().sin_cos();
        [
            Vec3::new(sin_a * cos_e, sin_e, cos_a * cos_e),
            Vec3::new(-sin_a * sin_e, cos_e, -cos_a * sin_e),
            Vec3::new(cos_a, 0.0, -sin_a),
        ]
    }

    fn distance(&self, bounds: [Vec3; 2]) -> f32 {
        let [back, up, right] = self.axes();
        let half = half_size(bounds);
        let [wide, high] = self.tangents();
        let corners = (0..8).map(|corner| {
            let signs = [1, 2, 4].map(|bit: i32| if corner & bit == 0 { 1.0_f32 } else { -1.0 });
            half * Vec3::from(signs)
        });
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

/// How much room all points need on each side of their middle, in the plane through it. A point
/// at `x` along an axis and `z` towards the viewer needs `t z + x` on the positive side and
/// `t z - x` on the negative one, where t is the tangent of half the angle that they may fill.
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
        fn greater(a: [f32; 2], b: [f32; 2]) -> [f32; 2] {
            [a[0].max(b[0]), a[1].max(b[1])]
        }
        Self { right: greater(self.right, other.right), up: greater(self.up, other.up) }
    }

    fn distance(self, [wide, high]: [f32; 2]) -> f32 {
        let [right, up] = [self.right, self.up].map(|[a, b]| (a + b) / 2.0);
        (right / wide).max(up / high)
    }

    fn shift(self) -> [f32; 2] {
        [self.right, self.up].map(|[a, b]| if a.is_finite() { (a - b) / 2.0 } else { 0.0 })
    }
}

fn bounds_of(positions: &[[f32; 3]]) -> [Vec3; 2] {
    let mut positions = positions.iter().map(|&position| Vec3::from(position));
    let first = positions.next().unwrap_or_default();
    positions.fold([first; 2], |[low, high], position| [low.min(position), high.max(position)])
}

/// Vector from the centre of a box to its highest corner. A box of size 0 counts as one of size 1.
fn half_size(bounds: [Vec3; 2]) -> Vec3 {
    let half = (bounds[1] - bounds[0]) / 2.0;
    if half.max_element() > 0.0 { half } else { Vec3::splat(0.5) }
}

impl Camera {
    /// Nearest camera that sees a whole bounding box in a picture at least as wide as high. Use
    /// [`Framing`] for other picture shapes.
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

const VIEW_DEG: f32 = 25.0;

/// Places cameras that look at a picture. The picture lies in the plane z = 0 around the origin,
/// and its relief extends to both sides of this plane. Its longer side is 1 unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PictureView {
    sides: Vec2,
}

impl PictureView {
    /// Takes the width and height of the picture in pixels, at least one each.
    #[must_use]
    pub fn of((width, height): (usize, usize)) -> Self {
        let longer = width.max(height).max(1) as f32;
        Self { sides: Vec2::new(width.max(1) as f32, height.max(1) as f32) / longer }
    }

    /// The camera that sees exactly this picture, when you render in the picture's shape.
    #[must_use]
    pub fn camera(&self) -> Camera {
        self.turned(0.0, 0.0)
    }

    /// Moves this camera around the middle of the picture: in degrees to the right and upwards,
    /// -80 to 80. Use this to show the relief of a picture with depth.
    #[must_use]
    pub fn turned(&self, right_deg: f32, up_deg: f32) -> Camera {
        let distance = self.distance();
        let [right, up] = [right_deg, up_deg].map(f32::to_radians);
        let eye = Vec3::new(right.sin() * up.cos(), up.sin(), right.cos() * up.cos());
        Camera {
            eye: eye * distance,
            target: Vec3::ZERO,
            up: Vec3::Y,
            field_of_view_deg: VIEW_DEG,
            near: 0.3 * distance,
            far: 2.0 * distance,
        }
    }

    /// Width and height in units. The longer is 1.
    #[must_use]
    pub fn sides(&self) -> Vec2 {
        self.sides
    }

    /// Distance of the eye from the plane.
    #[must_use]
    pub fn distance(&self) -> f32 {
        0.5 * self.sides.y / (0.5 * VIEW_DEG).to_radians().tan()
    }
}

/// A file may ask for at most this many frames, and this many keyframes.
const MOST_FRAMES: usize = 100_000;

/// Smallest sine of the angle between up and the viewing direction. Below this, up does not fix
/// the camera's roll in f32.
const LEAST_SINE: f32 = 1e-3;

/// The hint for a fault that the parser has no hint for.
const KEYS: &str = "a path has `frames` and [[keyframe]] tables with `eye`, `target` and, if wanted, `up` \
    and `field_of_view_deg`";

/// A camera path through keyframes that are evenly spaced in time, read from a TOML file. For
/// example:
///
/// ```toml
/// frames = 120
/// closed = false            # whether the last keyframe leads back to the first
///
/// [[keyframe]]
/// eye = [4.0, 2.0, 6.0]
/// target = [0.0, 1.0, 0.0]
/// field_of_view_deg = 30.0  # 35 where it is left out
///
/// [[keyframe]]
/// eye = [6.0, 3.0, 2.0]
/// target = [0.0, 1.0, 0.0]
/// up = [0.0, 1.0, 0.0]      # y where it is left out
/// ```
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraPath {
    /// Number of frames along the whole path, 1 to 100,000.
    pub frames: usize,
    /// Whether the path returns from the last keyframe to the first.
    #[serde(default)]
    pub closed: bool,
    /// Keyframes, at least one.
    #[serde(rename = "keyframe", default)]
    pub keyframes: Vec<Keyframe>,
}

/// One camera of a path. Positions are in the model's unit.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Keyframe {
    /// Position of the eye.
    pub eye: [f64; 3],
    /// Point that appears in the centre of the picture.
    pub target: [f64; 3],
    /// Approximate up direction, +y by default.
    #[serde(default = "upwards")]
    pub up: [f32; 3],
    /// Vertical field of view in degrees, 0.1 to 170, 35 by default.
    #[serde(default = "normal_lens")]
    pub field_of_view_deg: f32,
}

fn upwards() -> [f32; 3] {
    Vec3::Y.into()
}

fn normal_lens() -> f32 {
    35.0
}

impl Keyframe {
    /// First value that makes a camera impossible, if there is one: its key and the reason.
    #[must_use]
    pub fn fault(&self) -> Option<(&'static str, String)> {
        let Self { eye, target, up, field_of_view_deg } = *self;
        for (key, value) in [("eye", eye), ("target", target), ("up", up.map(f64::from))] {
            if value.iter().any(|number| !(*number as f32).is_finite()) {
                return Some((key, format!("`{value:?}` is not finite")));
            }
        }
        let up = Vec3::from(up);
        let [eye, target] = [eye, target].map(DVec3::from);
        if !(0.1..=170.0).contains(&field_of_view_deg) {
            let reason = format!("`{field_of_view_deg}` is not from 0.1 to 170 degrees");
            return Some(("field_of_view_deg", reason));
        }
        let Some(forward) = (target - eye).as_vec3().try_normalize() else {
            return Some(("target", format!("`{target}` is where the eye is")));
        };
        if !up.try_normalize().is_some_and(|up| up.cross(forward).length() > LEAST_SINE) {
            return Some(("up", format!("`{up}` is parallel to the viewing direction, or zero")));
        }
        None
    }
}

/// A camera path could not be read. Every message starts with the file's path.
#[derive(Debug, thiserror::Error, Explain)]
pub enum CameraPathError {
    /// The file cannot be read, is not TOML, or has a missing or unknown key.
    #[error(transparent)]
    Text(#[from] TextError),
    /// A value is out of its range.
    #[error("{name}: `{key}`: {reason}")]
    #[hint(verbatim, "{KEYS}")]
    OutOfRange {
        /// Path of the file.
        name: String,
        /// Key of the value. Keyframes count from 1.
        key: String,
        /// Reason, with the value.
        reason: String,
    },
}

impl CameraPath {
    /// Reads a camera path from a TOML file.
    ///
    /// # Errors
    /// [`CameraPathError`] with the path and the line or key.
    pub fn open(path: &Path) -> Result<Self, CameraPathError> {
        Self::from_text(&path.display().to_string(), &read_text(path)?)
    }

    /// Parses a camera path from the text of a TOML file. `name` stands for the path in errors.
    ///
    /// # Errors
    /// [`CameraPathError`] with the line or key.
    pub fn from_text(name: &str, text: &str) -> Result<Self, CameraPathError> {
        let path: Self = Source::toml_with_hint(name, text, KEYS)?.typed()?;
        match path.fault() {
            None => Ok(path),
            Some((key, reason)) => {
                Err(CameraPathError::OutOfRange { name: name.to_owned(), key, reason })
            }
        }
    }

    /// Moves the path into the coordinates of a model that was moved. `origin` is the place of the
    /// model's origin in the coordinates of this path, see [`crate::mesh::ModelFile`].
    #[must_use]
    pub fn relative_to(mut self, origin: [f64; 3]) -> Self {
        for keyframe in &mut self.keyframes {
            for place in [&mut keyframe.eye, &mut keyframe.target] {
                *place = [0, 1, 2].map(|axis| place[axis] - origin[axis]);
            }
        }
        self
    }

    fn fault(&self) -> Option<(String, String)> {
        for (key, count) in [("frames", self.frames), ("keyframe", self.keyframes.len())] {
            if !(1..=MOST_FRAMES).contains(&count) {
                return Some((key.to_owned(), format!("{count}, not 1 to {MOST_FRAMES}")));
            }
        }
        for (keyframe, number) in self.keyframes.iter().zip(1..) {
            if let Some((key, reason)) = keyframe.fault() {
                return Some((format!("keyframe {number}: {key}"), reason));
            }
        }
        None
    }

    /// One camera per frame, by Catmull-Rom splines (1974) through the keyframes. An open path
    /// starts at the first keyframe and ends at the last. A closed one returns to the first after
    /// its last frame. Zoom is interpolated as the logarithm of the tangent of half the field of
    /// view. The clipping planes enclose the bounding box `bounds` (see
    /// [`crate::mesh::Mesh::bounds`]).
    ///
    /// # Panics
    /// If there is no keyframe.
    #[must_use]
    pub fn cameras(&self, bounds: [Vec3; 2]) -> Vec<Camera> {
        let spans = if self.closed { self.keyframes.len() } else { self.keyframes.len() - 1 };
        let steps = if self.closed { self.frames } else { self.frames.max(2) - 1 };
        (0..self.frames)
            .map(|frame| self.camera_at(frame as f32 * spans as f32 / steps as f32, bounds))
            .collect()
    }

    fn camera_at(&self, time: f32, bounds: [Vec3; 2]) -> Camera {
        let count = self.keyframes.len() as i64;
        let first = (time.floor() as i64).min(if self.closed { count } else { (count - 2).max(0) });
        let share = time - first as f32;
        let around = [-1, 0, 1, 2].map(|offset: i64| {
            let at = first + offset;
            let at = if self.closed { at.rem_euclid(count) } else { at.clamp(0, count - 1) };
            &self.keyframes[at as usize]
        });
        let [eye, target, up] = [
            around.map(|at| rounded(at.eye)),
            around.map(|at| rounded(at.target)),
            around.map(|at| at.up.into()),
        ]
        .map(|values| spline(values, share));
        // Interpolated eye and target may coincide, and up may become parallel to the viewing
        // direction. This falls back to the last keyframe.
        let last = around[1];
        let forward = (target - eye).try_normalize();
        let forward = forward.unwrap_or_else(|| {
            (DVec3::from(last.target) - DVec3::from(last.eye)).as_vec3().normalize()
        });
        let target = if eye == target { eye + forward } else { target };
        let up = [up, last.up.into(), Vec3::Y]
            .into_iter()
            .find(|up: &Vec3| up.normalize_or_zero().cross(forward).length() > LEAST_SINE)
            .unwrap_or(Vec3::Z);
        let zooms =
            around.map(|at| Vec3::splat((at.field_of_view_deg / 2.0).to_radians().tan().ln()));
        let zoom = spline(zooms, share).x.exp();
        let middle = (bounds[0] + bounds[1]) / 2.0;
        let radius = bounds[1].distance(bounds[0]) / 2.0;
        let away = eye.distance(middle);
        let far = (away + radius).max(1e-6) * 1.01;
        Camera {
            eye,
            target,
            up,
            field_of_view_deg: 2.0 * zoom.atan().to_degrees(),
            near: ((away - radius) * 0.99).max(far * 1e-3),
            far,
        }
    }
}

/// A place in 32-bit numbers.
fn rounded(place: [f64; 3]) -> Vec3 {
    DVec3::from(place).as_vec3()
}

fn spline([a, b, c, d]: [Vec3; 4], share: f32) -> Vec3 {
    let square = share * share;
    let cube = share * share * share;
    let linear = (c - a) * share;
    let quadratic = (a * 2.0 - b * 5.0 + c * 4.0 - d) * square;
    let cubic = (b * 3.0 - a - c * 3.0 + d) * cube;
    b + (linear + quadratic + cubic) / 2.0
}
