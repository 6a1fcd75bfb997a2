//! The work that the options ask for, and its summary.

use render::watercolor::{GlazePainter, Settings};

use super::animation::Animation;
use super::outputs::OpenOutputs;

/// The pictures to make of a subject, and how.
pub(super) struct Job {
    pub(super) title: String,
    pub(super) settings: Settings,
    pub(super) glazes: Option<GlazePainter>,
    pub(super) outputs: OpenOutputs,
    pub(super) animation: Option<Animation>,
}

/// The result, for the summary.
pub(super) struct Made {
    pub(super) size: (usize, usize),
    pub(super) backend: String,
    /// Number of regions of a photograph.
    pub(super) regions: Option<usize>,
    /// Number of frames of an animation, and how many of them existed already.
    pub(super) frames: Option<(usize, usize)>,
    pub(super) pigments: Vec<String>,
}
