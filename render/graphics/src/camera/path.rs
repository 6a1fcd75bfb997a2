//! The path of a camera through a scene, from a file.

use std::path::Path;

use glam::Vec3;
use serde::Deserialize;

use super::perspective::Camera;

/// The most frames and keyframes that a file may want.
const MOST_FRAMES: usize = 100_000;

/// A camera's way through some keyframes, even in time from each to the next; a
/// TOML file, for example
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
    /// Pictures along the whole path.
    pub frames: usize,
    /// Whether the last keyframe leads back to the first.
    #[serde(default)]
    pub closed: bool,
    /// One and up.
    #[serde(rename = "keyframe", default)]
    pub keyframes: Vec<Keyframe>,
}

/// A camera of a path; places in the model's unit.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Keyframe {
    /// Where it stands.
    pub eye: [f32; 3],
    /// What it looks at.
    pub target: [f32; 3],
    /// Roughly upwards.
    #[serde(default = "upwards")]
    pub up: [f32; 3],
    /// From the lower to the upper edge of the picture, in degrees.
    #[serde(default = "normal_lens")]
    pub field_of_view_deg: f32,
}

fn upwards() -> [f32; 3] {
    Vec3::Y.into()
}

fn normal_lens() -> f32 {
    35.0
}

/// Why a file is no camera path; the file is named in each.
#[derive(Debug, thiserror::Error)]
pub enum CameraPathError {
    /// The system does not let us.
    #[error("{name}: {error}")]
    Unreadable {
        /// The path.
        name: String,
        /// Why not.
        #[source]
        error: std::io::Error,
    },
    /// Not TOML, or not with our keys.
    #[error("{name}: line {line}: {reason}")]
    Malformed {
        /// The path.
        name: String,
        /// From 1 on.
        line: usize,
        /// What is wrong, with the key.
        reason: String,
    },
    /// A value that no camera can have.
    #[error("{name}: `{key}`: {reason}")]
    Impossible {
        /// The path.
        name: String,
        /// Which value; keyframes count from 1.
        key: String,
        /// Why not, with the value.
        reason: String,
    },
}

impl CameraPathError {
    /// What can be done.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Unreadable { .. } => "check the path",
            Self::Malformed { .. } | Self::Impossible { .. } => {
                "a path has `frames` and [[keyframe]] tables with `eye`, `target` and, if wanted, \
                 `up` and `field_of_view_deg`"
            }
        }
    }
}

impl CameraPath {
    /// Reads a file.
    ///
    /// # Errors
    /// [`CameraPathError`] with the path and the line or key.
    pub fn open(path: &Path) -> Result<Self, CameraPathError> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|error| CameraPathError::Unreadable { name: name.clone(), error })?;
        Self::from_text(&name, &text)
    }

    /// The same, of a file's text; `name` stands in errors.
    ///
    /// # Errors
    /// As [`CameraPath::open`].
    pub fn from_text(name: &str, text: &str) -> Result<Self, CameraPathError> {
        let path: Self = toml::from_str(text).map_err(|error| CameraPathError::Malformed {
            name: name.to_owned(),
            line: error.span().map_or(1, |span| {
                text.as_bytes()[..span.start].iter().filter(|byte| **byte == b'\n').count() + 1
            }),
            reason: error.message().split_whitespace().collect::<Vec<_>>().join(" "),
        })?;
        let impossible = |(key, reason)| {
            let name = name.to_owned();
            Err(CameraPathError::Impossible { name, key, reason })
        };
        path.fault().map_or(Ok(path), impossible)
    }

    /// A value that no camera can have: its key, and why not.
    fn fault(&self) -> Option<(String, String)> {
        for (key, count) in [("frames", self.frames), ("keyframe", self.keyframes.len())] {
            if !(1..=MOST_FRAMES).contains(&count) {
                return Some((key.to_owned(), format!("{count}, not 1 to {MOST_FRAMES}")));
            }
        }
        for (keyframe, number) in self.keyframes.iter().zip(1..) {
            let key = |name: &str| format!("keyframe {number}: {name}");
            let Keyframe { eye, target, up, field_of_view_deg } = *keyframe;
            for (name, value) in [("eye", eye), ("target", target), ("up", up)] {
                if value.iter().any(|number| !number.is_finite()) {
                    return Some((key(name), format!("`{value:?}` is not finite")));
                }
            }
            let [eye, target, up] = [eye, target, up].map(Vec3::from);
            if !(0.1..=170.0).contains(&field_of_view_deg) {
                let reason = format!("`{field_of_view_deg}` is not from 0.1 to 170 degrees");
                return Some((key("field_of_view_deg"), reason));
            }
            let Some(sight) = (target - eye).try_normalize() else {
                return Some((key("target"), format!("`{target}` is where the eye is")));
            };
            if !up.try_normalize().is_some_and(|up| up.cross(sight).length() > 1e-3) {
                return Some((key("up"), format!("`{up}` is along the sight, or nothing")));
            }
        }
        None
    }

    /// The cameras of all frames, by Catmull and Rom's splines (1974) through the
    /// keyframes: an open path starts at the first and ends at the last, a closed one
    /// comes back to the first after its last frame. Zoom is even: the logarithm of
    /// the tangent of half the field of view is interpolated. The near and far planes
    /// hold the box `bounds` (as of [`crate::mesh::Mesh::bounds`]).
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

    /// `time` in spans since the first keyframe.
    fn camera_at(&self, time: f32, bounds: [Vec3; 2]) -> Camera {
        let count = self.keyframes.len() as i64;
        let first = (time.floor() as i64).min(if self.closed { count } else { (count - 2).max(0) });
        let share = time - first as f32;
        let keyframe = |offset: i64| {
            let at = first + offset;
            let at = if self.closed { at.rem_euclid(count) } else { at.clamp(0, count - 1) };
            &self.keyframes[at as usize]
        };
        let around = [-1, 0, 1, 2].map(keyframe);
        let [eye, target, up] = [
            around.map(|at| at.eye.into()),
            around.map(|at| at.target.into()),
            around.map(|at| at.up.into()),
        ]
        .map(|values| spline(values, share));
        // Between keyframes eye and target may meet, and up may fall along the sight:
        // then it looks as at the last keyframe.
        let last = |of: fn(&Keyframe) -> [f32; 3]| Vec3::from(of(around[1]));
        let sight = (target - eye).try_normalize();
        let sight = sight.unwrap_or((last(|at| at.target) - last(|at| at.eye)).normalize());
        let target = if eye == target { eye + sight } else { target };
        let leans = |up: &Vec3| up.normalize_or_zero().cross(sight).length() > 1e-3;
        let up = [up, last(|at| at.up), Vec3::Y].into_iter().find(leans).unwrap_or(Vec3::Z);
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

/// From the second value (share 0) to the third (share 1).
fn spline([a, b, c, d]: [Vec3; 4], share: f32) -> Vec3 {
    let (square, cube) = (share * share, share * share * share);
    let linear = (c - a) * share;
    let quadratic = (a * 2.0 - b * 5.0 + c * 4.0 - d) * square;
    let cubic = (b * 3.0 - a - c * 3.0 + d) * cube;
    b + (linear + quadratic + cubic) / 2.0
}
