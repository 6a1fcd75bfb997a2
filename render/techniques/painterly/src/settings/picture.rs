//! Settings of pictures with a depth.

use serde::{Deserialize, Serialize};

use super::figures::Figure;

/// How a picture of depth becomes a relief.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PictureSettings {
    /// How far white stands before black in a picture of depth, by the picture's longer side,
    /// 0..=1.
    pub relief: f32,
}

impl Default for PictureSettings {
    fn default() -> Self {
        Self { relief: 0.2 }
    }
}

impl PictureSettings {
    pub(super) fn figures(&self) -> Vec<Figure> {
        vec![Figure::new("picture.relief", self.relief, [0.0, 1.0])]
    }
}
