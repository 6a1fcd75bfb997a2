//! Marks as data.

/// The marks on one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Marks {
    /// Name of the file of the marks, for messages.
    pub file: String,
    /// File of the picture that they were drawn on, where it was given.
    pub painting: Option<String>,
    /// The samples, at least one.
    pub samples: Vec<Mark>,
}

/// The mark of one sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Name of the sample, different from all others.
    pub name: String,
    /// Place of the sample.
    pub area: MarkedArea,
    /// Two points one stroke apart, in pixels; `None` if their distance is to be estimated.
    pub spacing: Option<[[f64; 2]; 2]>,
}

/// Place of a sample in the picture, in pixels from its upper left corner.
#[derive(Debug, Clone, PartialEq)]
pub enum MarkedArea {
    /// A line of points over regions of the sample, which is grown from there.
    Scribble(Vec<[f64; 2]>),
    /// Columns and rows of the pixels of a line, which are used like a scribble.
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
    /// Marks of one sample: all of a picture of `width` x `height` pixels.
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
