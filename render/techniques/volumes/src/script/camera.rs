//! The camera of a script.

use graphics::camera::{CameraPath, Framing, Keyframe};
use serde::{Deserialize, Serialize};

use super::rows::{MOST_FRAMES, Row, check_range};
use crate::toml_text::{Checked, Fault, KeyPath};

/// A path has at most this many keyframes.
const MOST_KEYFRAMES: usize = 10_000;

/// `[camera]`: either degrees of a camera that shows all of the subject, or keyframes. For a
/// photograph, degrees go to the right and upwards from straight before it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraTable {
    /// Degrees around the subject, -360 to 360. Without it, this is 30, and 0 for a photograph.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub azimuth_deg: Option<f64>,
    /// Degrees above the horizon, -90 to 90. Without it, this is 20, and 0 for a photograph.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elevation_deg: Option<f64>,
    /// Vertical field of view in degrees, 1 to 170. Without it, this is 30.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field_of_view_deg: Option<f64>,
    /// Number of frames of one turn around the subject, or of a swing before a photograph, 1 to
    /// 100,000. Without it, the camera stands still.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turntable: Option<u32>,
    /// Number of frames of a path, 1 to 100,000. Without it, a path is as long as the script.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<u32>,
    /// Whether a path leads from the last keyframe back to the first.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub closed: bool,
    /// Keyframes, evenly spaced over the duration of the script.
    #[serde(default, rename = "keyframe", skip_serializing_if = "Vec::is_empty")]
    pub keyframes: Vec<KeyframeTable>,
}

/// `[[camera.keyframe]]`: one camera of a path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeyframeTable {
    /// Place of the eye in the unit of the scene.
    pub eye: Row<3>,
    /// Place in the centre of the picture.
    pub target: Row<3>,
    /// Approximate upward direction. Without it, this is +y.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub up: Option<Row<3>>,
    /// Vertical field of view in degrees, 0.1 to 170. Without it, this is 35.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field_of_view_deg: Option<f64>,
}

/// The camera of a script, ready for use.
#[derive(Debug, Clone, PartialEq)]
pub enum ScriptCamera {
    /// A camera that shows all of the subject, in a square picture.
    Framing(Framing),
    /// A path through keyframes.
    Path(CameraPath),
}

impl CameraTable {
    /// The camera of an animation. It has `frames` frames unless you gave the path its own number.
    /// For a turntable you get its first camera.
    #[must_use]
    pub fn camera(&self, frames: usize) -> ScriptCamera {
        if !self.keyframes.is_empty() {
            let keyframes = self.keyframes.iter().map(KeyframeTable::keyframe).collect();
            let frames = self.frames.map_or(frames, |frames| frames as usize);
            return ScriptCamera::Path(CameraPath { frames, closed: self.closed, keyframes });
        }
        let usual = Framing::default();
        fn or(given: Option<f64>, usual: f32) -> f32 {
            given.map_or(usual, |value| value as f32)
        }
        ScriptCamera::Framing(Framing {
            azimuth_deg: or(self.azimuth_deg, usual.azimuth_deg),
            elevation_deg: or(self.elevation_deg, usual.elevation_deg),
            field_of_view_deg: or(self.field_of_view_deg, usual.field_of_view_deg),
            ..usual
        })
    }

    pub(super) fn check(&self) -> Checked {
        let base = KeyPath::of("camera");
        let degrees = [
            ("azimuth_deg", self.azimuth_deg, [-360.0, 360.0]),
            ("elevation_deg", self.elevation_deg, [-90.0, 90.0]),
            ("field_of_view_deg", self.field_of_view_deg, [1.0, 170.0]),
            ("turntable", self.turntable.map(f64::from), [1.0, MOST_FRAMES as f64]),
        ];
        for (key, value, range) in degrees {
            let Some(value) = value else { continue };
            let key = base.key(key);
            if !self.keyframes.is_empty() {
                let hint = "leave it out, or leave the keyframes out";
                return Err(Fault::new(&key, "no value beside keyframes", value, hint));
            }
            check_range(&key, value, range)?;
        }
        for (key, given) in [("closed", self.closed), ("frames", self.frames.is_some())] {
            if given && self.keyframes.is_empty() {
                let hint = "add [[camera.keyframe]] tables, or leave it out";
                return Err(Fault::new(&base.key(key), "keyframes beside it", "none", hint));
            }
        }
        if let Some(frames) = self.frames {
            check_range(&base.key("frames"), frames.into(), [1.0, MOST_FRAMES as f64])?;
        }
        let base = base.key("keyframe");
        if self.keyframes.len() > MOST_KEYFRAMES {
            let hint = format!("the first {MOST_KEYFRAMES} fit");
            let key = base.index(MOST_KEYFRAMES);
            let wanted = format!("at most {MOST_KEYFRAMES} keyframes");
            return Err(Fault::new(&key, wanted, self.keyframes.len(), hint));
        }
        for (index, keyframe) in self.keyframes.iter().enumerate() {
            if let Some((key, reason)) = keyframe.keyframe().fault() {
                let hint = "a keyframe has an eye, a target elsewhere, and up across the view";
                let key = base.index(index).key(key);
                return Err(Fault::new(&key, "a camera that can be made", reason, hint));
            }
        }
        Ok(())
    }
}

impl KeyframeTable {
    fn keyframe(&self) -> Keyframe {
        Keyframe {
            eye: self.eye.0,
            target: self.target.0,
            up: self.up.map_or([0.0, 1.0, 0.0], |up| up.0.map(|value| value as f32)),
            field_of_view_deg: self.field_of_view_deg.map_or(35.0, |degrees| degrees as f32),
        }
    }
}
