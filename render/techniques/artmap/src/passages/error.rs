//! Faults of taking samples.

use documents::hint::{Explain, Fault, Hint};
use documents::name_list;

use super::marks::MarksError;

/// Most names that a message lists.
const MOST_NAMES: usize = 8;

/// Samples cannot be taken from a picture.
#[derive(Debug, thiserror::Error)]
pub enum PassageError {
    /// The marks do not fit the picture.
    #[error(transparent)]
    Marks(#[from] MarksError),
    /// A setting is out of its range.
    #[error("{key} takes {least} to {most}, found `{found}`")]
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
    NoColor {
        /// Column.
        x: usize,
        /// Row.
        y: usize,
    },
    /// The distance of strokes cannot be estimated.
    #[error("the distance of strokes cannot be seen in {}", name_list(samples, MOST_NAMES, ", "))]
    NoSpacing {
        /// Names of the samples.
        samples: Vec<String>,
    },
    /// A passage is too narrow for its spacing.
    #[error(
        "sample `{sample}` is {width_px:.0} px wide across its strokes, less than four times their \
         distance of {spacing_px:.1} px"
    )]
    Narrow {
        /// Name of the sample.
        sample: String,
        /// Width across the strokes in pixels.
        width_px: f64,
        /// Distance of neighbouring strokes in pixels.
        spacing_px: f64,
    },
    /// The spacing of a sample is very unlike that of the median sample.
    #[error(
        "the strokes of sample `{sample}` are {spacing_px:.1} px apart, those of `{reference}` \
         {reference_px:.1} px"
    )]
    Unlike {
        /// Name of the sample.
        sample: String,
        /// Its distance of strokes in pixels.
        spacing_px: f64,
        /// Name of the sample of median spacing.
        reference: String,
        /// Distance of its strokes in pixels.
        reference_px: f64,
    },
    /// No samples can be proposed.
    #[error("no passage of the picture has strokes that can be told from a flat colour")]
    NothingToPropose,
}

impl Explain for PassageError {
    fn hint(&self) -> Option<Hint> {
        let words = match self {
            Self::Marks(error) => return error.hint(),
            Self::Setting { key: "reach", .. } => "1 is usual; more joins more unlike regions",
            Self::Setting { key: "spacing", .. } => "leave [spacing] out to estimate it",
            Self::Setting { .. } => "16 classes are usual",
            Self::ChannelSize { .. } => "give all channels the size of the picture",
            Self::NoColor { .. } => "colours are finite numbers; repair or leave out that pixel",
            Self::NoSpacing { .. } => {
                "mark the middles of two neighbouring strokes: spacing = [[x, y], [x, y]], or give \
                 one distance in pixels for all samples with [spacing]"
            }
            Self::Narrow { .. } => {
                "mark a wider passage, let it grow further with a larger [reach], or mark a smaller \
                 distance with spacing = [[x, y], [x, y]]"
            }
            Self::Unlike { .. } => {
                "mark the distance with spacing = [[x, y], [x, y]], or leave this sample out"
            }
            Self::NothingToPropose => {
                "mark the samples yourself, or take a picture with more detail"
            }
        };
        Some(Hint::new(words))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::Marks(error) => error.fault(),
            Self::Setting { .. } => Fault::Setting,
            _ => Fault::Input,
        }
    }
}
