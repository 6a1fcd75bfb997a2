//! Faults of marks.

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};
use documents::text::TextError;
use graphics::picture::PhotographError;

/// Marks cannot be read, or do not fit the picture.
#[derive(Debug, thiserror::Error)]
pub enum MarksError {
    /// The file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text cannot be read.
    #[error(transparent)]
    Text(#[from] TextError),
    /// There is no sample.
    #[error("{file}: there are no samples")]
    NoSamples {
        /// Name of the file.
        file: String,
    },
    /// A sample has a fault.
    #[error("{file}, sample `{sample}`, {key}: {fault}")]
    Sample {
        /// Name of the file.
        file: String,
        /// Name of the sample.
        sample: String,
        /// Key that holds the fault.
        key: &'static str,
        /// The fault.
        fault: MarkFault,
    },
    /// The picture of lines cannot be read.
    #[error(transparent)]
    Overlay(#[from] PhotographError),
    /// The picture of lines has another size than the painting.
    #[error(
        "{file}: {} x {} pixels, but the painting has {} x {}",
        found.0, found.1, wanted.0, wanted.1
    )]
    OverlaySize {
        /// Name of the picture of lines.
        file: String,
        /// Its width and height.
        found: (usize, usize),
        /// Width and height of the painting.
        wanted: (usize, usize),
    },
    /// The picture of lines is opaque everywhere, or has very many colours.
    #[error("{file}: {colors} opaque colours, expected a line of one colour for each sample")]
    OverlayColors {
        /// Name of the picture of lines.
        file: String,
        /// Number of different opaque colours.
        colors: usize,
    },
}

/// Fault of one sample.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MarkFault {
    /// The name is empty.
    #[error("a sample needs a name")]
    NoName,
    /// Two samples have one name.
    #[error("another sample has this name")]
    RepeatedName,
    /// The sample has no area, or more than one.
    #[error("a sample has one of scribble, rectangle and pixels, found {found}")]
    Areas {
        /// Number of areas.
        found: usize,
    },
    /// A line has no points.
    #[error("a line needs at least one point")]
    NoPoints,
    /// A number is infinite or none.
    #[error("`{value}` is no place in a picture")]
    NotFinite {
        /// The number.
        value: f64,
    },
    /// A rectangle has no pixels or broken ones.
    #[error("[x, y, width, height] are whole numbers of pixels, width and height at least 1")]
    Rectangle,
    /// Both points of the spacing are one.
    #[error("both points are at the same place")]
    NoDistance,
    /// A place lies outside of the picture.
    #[error("[{x}, {y}] lies off the picture of {width} x {height} pixels")]
    OffPicture {
        /// Column.
        x: f64,
        /// Row.
        y: f64,
        /// Columns of the picture.
        width: usize,
        /// Rows of the picture.
        height: usize,
    },
    /// Lines of two samples share a pixel.
    #[error("crosses the line of sample `{other}` at [{x}, {y}]")]
    Crossing {
        /// Name of the other sample.
        other: String,
        /// Column.
        x: usize,
        /// Row.
        y: usize,
    },
}

impl Explain for MarksError {
    fn hint(&self) -> Option<Hint> {
        let words = match self {
            Self::File(error) => return error.hint(),
            Self::Text(error) => return error.hint(),
            Self::Overlay(error) => return error.hint(),
            Self::NoSamples { .. } => {
                "add a sample with a name and a scribble, or let marks be proposed with [propose]"
            }
            Self::Sample { fault, .. } => fault.way_out(),
            Self::OverlaySize { .. } => {
                "draw the lines on a transparent layer over the painting and save that layer alone"
            }
            Self::OverlayColors { .. } => {
                "leave the rest transparent, and draw with a hard brush, one colour a sample"
            }
        };
        Some(Hint::new(words))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            Self::Text(error) => error.fault(),
            Self::Overlay(error) => error.fault(),
            _ => Fault::Input,
        }
    }
}

impl MarkFault {
    fn way_out(&self) -> &'static str {
        match self {
            Self::NoName | Self::RepeatedName => "give each sample a name of its own",
            Self::Areas { .. } => "a scribble grows to its passage, a rectangle is used as it is",
            Self::NoPoints => "draw the line over the middle of the passage",
            Self::NotFinite { .. } | Self::OffPicture { .. } => {
                "places are [column, row] in pixels from the upper left corner"
            }
            Self::Rectangle => {
                "write [20, 300, 120, 90] for 120 x 90 pixels from column 20, row 300"
            }
            Self::NoDistance => {
                "mark the middles of two neighbouring strokes, or leave spacing out"
            }
            Self::Crossing { .. } => "shorten one of the lines, or make both one sample",
        }
    }
}
