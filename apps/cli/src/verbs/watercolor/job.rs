//! Settings of one watercolor, and the summary of the result.

use watercolor::{GlazePainter, Settings};

use super::outputs::OpenOutputs;
use crate::animation::Animation;

/// Settings and outputs of one run.
pub(super) struct Job {
    pub(super) title: String,
    pub(super) settings: Settings,
    pub(super) glazes: Option<GlazePainter>,
    pub(super) outputs: OpenOutputs,
    pub(super) animation: Option<Animation>,
}

/// Summary of a finished run.
pub(super) struct Summary {
    /// Width and height in pixels.
    pub(super) size: (usize, usize),
    /// Name of the device.
    pub(super) backend: String,
    /// Number of regions of a photograph.
    pub(super) regions: Option<usize>,
    /// Number of frames of an animation, and the number of these that existed already.
    pub(super) frames: Option<(usize, usize)>,
    /// Names of the pigments; empty without a library.
    pub(super) pigments: Vec<String>,
}
