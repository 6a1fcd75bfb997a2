//! Settings of how samples are taken from a picture.

use serde::{Deserialize, Serialize};

/// Method that divides the picture into the small regions of which passages are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OverSegmentation {
    /// By colour and texture (Deng and Manjunath 2001).
    #[default]
    Jseg,
    /// By colour and place (Comaniciu and Meer 2002). Suits scans with fine cracks.
    MeanShift,
}

/// Direction in which samples are resized until their spacings agree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Density {
    /// Both directions alike: strokes keep their shape.
    #[default]
    Uniform,
    /// Across the strokes only, as Yan, Chi, Lee and Lin (2008, section 7) do.
    Width,
}

/// Settings of [`samples_of_picture`](super::samples_of_picture).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassageSettings {
    /// Method of over-segmentation.
    pub over: OverSegmentation,
    /// Number of colour classes of JSEG, 10 to 20.
    pub color_classes: usize,
    /// How unlike regions may be that are still joined, 0 to 10; 1 is usual.
    pub reach: f64,
    /// Direction in which samples are resized.
    pub density: Density,
    /// Distance of neighbouring strokes in pixels where the marks give none, 1 to 1000; `None`
    /// estimates it.
    pub spacing: Option<f64>,
}

impl Default for PassageSettings {
    /// JSEG with 16 classes, reach 1, both directions alike, spacings estimated.
    fn default() -> Self {
        Self {
            over: OverSegmentation::Jseg,
            color_classes: 16,
            reach: 1.0,
            density: Density::Uniform,
            spacing: None,
        }
    }
}
