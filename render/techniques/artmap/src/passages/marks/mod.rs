//! Marks: lines and rectangles by which you say where the samples of a picture are.
//!
//! You write them in a TOML file:
//!
//! ```toml
//! painting = "orchard.png"
//!
//! [[sample]]
//! name = "sky"
//! scribble = [[40, 32], [180, 60], [240, 58]]
//! spacing = [[90, 40], [92, 52]]
//!
//! [[sample]]
//! name = "grass"
//! rectangle = [20, 300, 120, 90]
//! ```
//!
//! Places are pixels from the upper left corner of the picture. You can use fractions. `spacing`
//! holds two points one stroke apart. You can also draw coloured lines in a picture over the
//! painting ([`Marks::from_overlay`]).
mod text;

use documents::file::FileError;
use documents::hint::Explain;
use documents::text::TextError;
use graphics::picture::PhotographError;

pub(super) use text::DrawnArea;

/// The marks on one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Marks {
    /// Name of the file of the marks. Messages show this.
    pub file: String,
    /// File of the picture that you drew them on, if you gave it.
    pub painting: Option<String>,
    /// The samples, at least one.
    pub samples: Vec<Mark>,
}

/// The mark of one sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Name of the sample. It must differ from all others.
    pub name: String,
    /// Place of the sample.
    pub area: MarkedArea,
    /// Two points one stroke apart, in pixels. If this is `None`, we estimate the distance.
    pub spacing: Option<[[f64; 2]; 2]>,
}

/// Place of a sample in the picture, in pixels from its upper left corner.
#[derive(Debug, Clone, PartialEq)]
pub enum MarkedArea {
    /// A line of points over regions of the sample. The sample grows from there.
    Scribble(Vec<[f64; 2]>),
    /// Columns and rows of the pixels of a line. This works like a scribble.
    Pixels(Vec<[u32; 2]>),
    /// Exactly these pixels.
    Rectangle {
        /// Leftmost column.
        x: u32,
        /// Topmost row.
        y: u32,
        /// Number of columns, at least 1.
        width: u32,
        /// Number of rows, at least 1.
        height: u32,
    },
}

impl Marks {
    /// One sample: all of a picture of `width` x `height` pixels.
    #[must_use]
    pub fn of_whole(name: &str, (width, height): (usize, usize)) -> Self {
        let [width, height] = [width, height].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
        let area = MarkedArea::Rectangle { x: 0, y: 0, width, height };
        let whole = Mark { name: name.to_owned(), area, spacing: None };
        Self { file: "the whole picture".to_owned(), painting: None, samples: vec![whole] }
    }
}

impl Mark {
    /// Distance of the two points of `spacing` in pixels.
    #[must_use]
    pub fn spacing_px(&self) -> Option<f64> {
        let [[x, y], [other_x, other_y]] = self.spacing?;
        Some((other_x - x).hypot(other_y - y))
    }
}

impl MarkedArea {
    /// Key of the area in a file of marks.
    #[must_use]
    pub fn key(&self) -> &'static str {
        match self {
            Self::Scribble(_) => "scribble",
            Self::Pixels(_) => "pixels",
            Self::Rectangle { .. } => "rectangle",
        }
    }
}

/// Marks cannot be read, or do not fit the picture.
#[derive(Debug, thiserror::Error, Explain)]
pub enum MarksError {
    /// The file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text cannot be read.
    #[error(transparent)]
    Text(#[from] TextError),
    /// There is no sample.
    #[error("{0}: there are no samples")]
    #[hint("add a sample with a name and a scribble, or let marks be proposed with [propose]")]
    NoSamples(String),
    /// A sample has a fault.
    #[error("{file}, sample `{sample}`, {key}: {fault}")]
    #[hint("{}", fault.way_out())]
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
    #[hint("draw the lines on a transparent layer over the painting and save that layer alone")]
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
    #[hint("leave the rest transparent, and draw with a hard brush, one colour a sample")]
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
    /// The name is empty, too long, or holds control characters.
    #[error("a sample needs a name of at most 200 letters, without control characters")]
    NoName,
    /// Two samples have the same name.
    #[error("another sample has this name")]
    RepeatedName,
    /// The sample has no area, or more than one.
    #[error("a sample has one of scribble, rectangle and pixels, found {0}")]
    Areas(usize),
    /// A line has no points.
    #[error("a line needs at least one point")]
    NoPoints,
    /// A number is infinite or NaN.
    #[error("`{0}` is not a place in a picture")]
    NotFinite(f64),
    /// A rectangle has no pixels, or its numbers are not whole.
    #[error("[x, y, width, height] are whole numbers of pixels, width and height at least 1")]
    Rectangle,
    /// Both points of the spacing are the same.
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

impl MarkFault {
    fn way_out(&self) -> &'static str {
        match self {
            Self::NoName | Self::RepeatedName => "give each sample a name of its own",
            Self::Areas(..) => "a scribble grows to its passage, a rectangle is used as it is",
            Self::NoPoints => "draw the line over the middle of the passage",
            Self::NotFinite(..) | Self::OffPicture { .. } => {
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
