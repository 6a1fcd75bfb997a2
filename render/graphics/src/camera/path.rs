//! Camera paths: keyframes from a TOML file, interpolated to one camera per frame.

use std::path::Path;

use documents::hint::Explain;
use documents::text::{Source, TextError, read_text};
use glam::Vec3;
use serde::Deserialize;

use super::perspective::Camera;

/// Most frames, and most keyframes, that a file may ask for.
const MOST_FRAMES: usize = 100_000;

/// Smallest sine of the angle between up and the viewing direction: below it, up does
/// not fix the camera's roll in f32.
const LEAST_SINE: f32 = 1e-3;

/// The way out where the parser knows none.
const KEYS: &str = "a path has `frames` and [[keyframe]] tables with `eye`, `target` and, if wanted, `up` \
    and `field_of_view_deg`";

/// A camera path through keyframes that are evenly spaced in time, read from a TOML file,
/// for example
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

/// One camera of a path; positions are in the model's unit.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Keyframe {
    /// Position of the eye.
    pub eye: [f32; 3],
    /// Point that appears in the centre of the picture.
    pub target: [f32; 3],
    /// Approximate up direction; +y by default.
    #[serde(default = "upwards")]
    pub up: [f32; 3],
    /// Vertical field of view in degrees, 0.1 to 170; 35 by default.
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
    /// First value from which no camera can be made: its key and the reason.
    #[must_use]
    pub fn fault(&self) -> Option<(&'static str, String)> {
        let Self { eye, target, up, field_of_view_deg } = *self;
        for (key, value) in [("eye", eye), ("target", target), ("up", up)] {
            if value.iter().any(|number| !number.is_finite()) {
                return Some((key, format!("`{value:?}` is not finite")));
            }
        }
        let [eye, target, up] = [eye, target, up].map(Vec3::from);
        if !(0.1..=170.0).contains(&field_of_view_deg) {
            let reason = format!("`{field_of_view_deg}` is not from 0.1 to 170 degrees");
            return Some(("field_of_view_deg", reason));
        }
        let Some(forward) = (target - eye).try_normalize() else {
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
        /// Key of the value; keyframes count from 1.
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

    /// Parses a camera path from the text of a TOML file; `name` stands for the path in
    /// errors.
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

    /// First value that is out of range: its key and the reason.
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

    /// One camera per frame, by Catmull-Rom splines (1974) through the keyframes. An open
    /// path starts at the first keyframe and ends at the last; a closed one returns to the
    /// first after its last frame. Zoom is interpolated as the logarithm of the tangent of
    /// half the field of view. The clipping planes enclose the bounding box `bounds` (see
    /// [`crate::mesh::Mesh::bounds`]).
    ///
    /// # Panics
    /// If there is no keyframe.
    #[must_use]
    pub fn cameras(&self, bounds: [Vec3; 2]) -> Vec<Camera> {
        let spans = if self.closed { self.keyframes.len() } else { self.keyframes.len() - 1 };
        let steps = if self.closed { self.frames } else { self.frames.max(2) - 1 };
        let at = |frame: usize| frame as f32 * spans as f32 / steps as f32;
        (0..self.frames).map(|frame| self.camera_at(at(frame), bounds)).collect()
    }

    /// Camera at `time`, counted in spans from the first keyframe.
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
            around.map(|at| at.eye.into()),
            around.map(|at| at.target.into()),
            around.map(|at| at.up.into()),
        ]
        .map(|values| spline(values, share));
        // Interpolated eye and target may coincide, and up may become parallel to the viewing
        // direction: then the last keyframe decides.
        let last = |of: fn(&Keyframe) -> [f32; 3]| Vec3::from(of(around[1]));
        let forward = (target - eye).try_normalize();
        let forward = forward.unwrap_or((last(|at| at.target) - last(|at| at.eye)).normalize());
        let target = if eye == target { eye + forward } else { target };
        let suitable = |up: &Vec3| up.normalize_or_zero().cross(forward).length() > LEAST_SINE;
        let up = [up, last(|at| at.up), Vec3::Y].into_iter().find(suitable).unwrap_or(Vec3::Z);
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

/// Catmull-Rom segment from the second point (share 0) to the third (share 1).
fn spline([a, b, c, d]: [Vec3; 4], share: f32) -> Vec3 {
    let square = share * share;
    let cube = share * share * share;
    let linear = (c - a) * share;
    let quadratic = (a * 2.0 - b * 5.0 + c * 4.0 - d) * square;
    let cubic = (b * 3.0 - a - c * 3.0 + d) * cube;
    b + (linear + quadratic + cubic) / 2.0
}
