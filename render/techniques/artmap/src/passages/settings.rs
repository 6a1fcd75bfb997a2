//! The picture from which samples are taken, the settings for this, and the errors.

use documents::hint::Explain;
use documents::name_list;
use graphics::field::Field;
use graphics::picture::Picture;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::marks::MarksError;
use crate::sample::{PaintOfSamples, TexelPaint, WholePainting};

/// Method that divides the picture into small regions, from which passages are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum OverSegmentation {
    /// By colour and texture (Deng and Manjunath 2001).
    #[default]
    Jseg,
    /// By colour and place (Comaniciu and Meer 2002). Suits scans with fine cracks.
    MeanShift,
}

/// Direction in which samples are resized until their spacings agree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
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
    /// Greatest unlikeness of regions that are joined, 0 to 10. 1 is usual.
    pub reach: f64,
    /// Direction in which samples are resized.
    pub density: Density,
    /// Distance between neighbouring strokes in pixels where the marks give none, 1 to 1000. `None`
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

/// A painting or photograph with all its channels, which have one size.
#[derive(Debug, Clone, PartialEq)]
pub struct SourcePicture {
    /// Colour of each pixel in linear sRGB with white at 1.
    pub color: Picture,
    /// Paint of each pixel, and its pigments, `None` for pictures without pigments.
    pub paint: Option<(Field<TexelPaint>, PaintOfSamples)>,
    /// Height of the surface above the ground in mm, `None` without relief.
    pub height_mm: Option<Field<f32>>,
    /// Side of a pixel in mm, where it is known.
    pub mm_per_pixel: Option<f64>,
    /// Whether the height was guessed from a photograph.
    pub guessed_relief: bool,
    /// Origin of the picture in words, for the file of the samples.
    pub provenance: String,
}

impl SourcePicture {
    /// A picture of colours alone.
    #[must_use]
    pub fn of_colors(color: Picture, provenance: impl Into<String>) -> Self {
        Self {
            color,
            paint: None,
            height_mm: None,
            mm_per_pixel: None,
            guessed_relief: false,
            provenance: provenance.into(),
        }
    }

    /// The picture of a painting of impasto, one pixel a cell, with its paint and relief.
    #[must_use]
    pub fn of_painting(painting: WholePainting) -> Self {
        let WholePainting { title, color, paint, height_mm, mm_per_texel, pigments, .. } = painting;
        Self {
            color,
            paint: Some((paint, pigments)),
            height_mm: Some(height_mm),
            mm_per_pixel: Some(mm_per_texel),
            guessed_relief: false,
            provenance: format!("painting `{title}`"),
        }
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.color.width(), self.color.height())
    }

    /// Name and size of a channel that is not as large as the colours.
    pub(super) fn odd_channel(&self) -> Option<(&'static str, (usize, usize))> {
        let paint = self.paint.as_ref().map(|(paint, _)| (paint.width(), paint.height()));
        let height = self.height_mm.as_ref().map(|height| (height.width(), height.height()));
        let channels = [("paint", paint), ("height", height)];
        let sizes = channels.into_iter().filter_map(|(name, size)| Some((name, size?)));
        sizes.into_iter().find(|&(_, size)| size != self.size())
    }
}

/// Most names that a message lists.
const MOST_NAMES: usize = 8;

/// Samples cannot be taken from a picture.
#[derive(Debug, thiserror::Error, Explain)]
pub enum PassageError {
    /// The marks do not fit the picture.
    #[error(transparent)]
    Marks(#[from] MarksError),
    /// A setting is out of its range.
    #[error("{key} takes {least} to {most}, found `{found}`")]
    #[hint(if *key == "reach", "1 is usual; more joins more unlike regions")]
    #[hint(if *key == "spacing", "leave [spacing] out to estimate it")]
    #[hint("16 classes are usual")]
    #[fault(Setting)]
    Setting {
        /// Name of the setting.
        key: &'static str,
        /// Least value.
        least: f64,
        /// Largest value.
        most: f64,
        /// Value that was set.
        found: f64,
    },
    /// A channel of the picture is not as large as its colours.
    #[error(
        "{channel} has {} x {} pixels, the colours have {} x {}",
        found.0, found.1, wanted.0, wanted.1
    )]
    #[hint("give all channels the size of the picture")]
    ChannelSize {
        /// Name of the channel.
        channel: &'static str,
        /// Its width and height.
        found: (usize, usize),
        /// Width and height of the colours.
        wanted: (usize, usize),
    },
    /// A colour of the picture is infinite or not a number.
    #[error("the picture has no colour at [{x}, {y}]")]
    #[hint("colours are finite numbers; repair or leave out that pixel")]
    NoColor {
        /// Column.
        x: usize,
        /// Row.
        y: usize,
    },
    /// The distance between strokes cannot be estimated.
    #[error("the distance between strokes cannot be seen in {}", name_list(.0, MOST_NAMES, ", "))]
    #[hint(
        "mark the middles of two neighbouring strokes: spacing = [[x, y], [x, y]], or give \
        one distance in pixels for all samples with [spacing]"
    )]
    NoSpacing(Vec<String>),
    /// A passage is too narrow for its spacing.
    #[error(
        "sample `{sample}` is {width_px:.0} px wide across its strokes, less than four times their \
         distance of {spacing_px:.1} px"
    )]
    #[hint(
        "mark a wider passage, let it grow further with a larger [reach], or mark a smaller \
        distance with spacing = [[x, y], [x, y]]"
    )]
    Narrow {
        /// Name of the sample.
        sample: String,
        /// Width across the strokes in pixels.
        width_px: f64,
        /// Distance between neighbouring strokes in pixels.
        spacing_px: f64,
    },
    /// The spacing of a sample is very unlike the median sample's.
    #[error(
        "the strokes of sample `{sample}` are {spacing_px:.1} px apart, those of `{reference}` \
         {reference_px:.1} px"
    )]
    #[hint("mark the distance with spacing = [[x, y], [x, y]], or leave this sample out")]
    Unlike {
        /// Name of the sample.
        sample: String,
        /// Distance between its strokes in pixels.
        spacing_px: f64,
        /// Name of the sample of median spacing.
        reference: String,
        /// Distance between its strokes in pixels.
        reference_px: f64,
    },
    /// No samples can be proposed.
    #[error("no passage of the picture has strokes that can be told from a flat colour")]
    #[hint("mark the samples yourself, or take a picture with more detail")]
    NothingToPropose,
}
