//! Faults of guides.

use documents::file::FileError;
use documents::hint::{Explain, Fault, Hint};
use documents::text::TextError;

/// Guides cannot be read, or do not fit their picture or model.
#[derive(Debug, thiserror::Error)]
pub enum GuidesError {
    /// The file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The text cannot be read.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The picture has no pixel, or too many.
    #[error("{file}, size_px: a picture of {} x {} pixels", found[0], found[1])]
    Size {
        /// Name of the file.
        file: String,
        /// Width and height.
        found: [u32; 2],
    },
    /// The camera is out of its range.
    #[error("{file}, camera: found `{found:?}`")]
    Camera {
        /// Name of the file.
        file: String,
        /// Degrees around the model, above the horizon, and of the field of view.
        found: [f32; 3],
    },
    /// There is no guide.
    #[error("{file}: there are no guides")]
    NoGuides {
        /// Name of the file.
        file: String,
    },
    /// A guide has a fault.
    #[error("{file}{}, guide {guide}: {fault}", line.map_or(String::new(), |at| format!(", line {at}")))]
    Guide {
        /// Name of the file.
        file: String,
        /// Line, counted from 1, where the guides were read from text.
        line: Option<usize>,
        /// Number of the guide, from 1.
        guide: usize,
        /// The fault.
        fault: GuideFault,
    },
}

/// Fault of one guide. Points count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GuideFault {
    /// There are fewer than two points.
    #[error("a line needs at least two points, found {found}")]
    FewPoints {
        /// Number of points.
        found: usize,
    },
    /// A number is infinite or none.
    #[error("point {point}: `{value}` is no place in a picture")]
    NotFinite {
        /// Number of the point.
        point: usize,
        /// The number found.
        value: f64,
    },
    /// A point lies outside of the picture.
    #[error("point {point}: [{}, {}] lies off the picture of {} x {} pixels", at[0], at[1], size_px[0], size_px[1])]
    OffPicture {
        /// Number of the point.
        point: usize,
        /// Column and row.
        at: [f64; 2],
        /// Width and height of the picture.
        size_px: [u32; 2],
    },
    /// All points are at one place.
    #[error("all points are at the same place")]
    NoLength,
    /// Nothing of the model is seen along the line.
    #[error("nothing of the model is seen along the line")]
    OffMesh,
}

impl GuideFault {
    /// Number of the point that has the fault, from 1.
    pub(super) fn point(&self) -> Option<usize> {
        match *self {
            Self::NotFinite { point, .. } | Self::OffPicture { point, .. } => Some(point),
            _ => None,
        }
    }

    fn way_out(&self) -> &'static str {
        match self {
            Self::FewPoints { .. } | Self::NoLength => {
                "draw the line from where strokes come to where they go"
            }
            Self::NotFinite { .. } | Self::OffPicture { .. } => {
                "places are [column, row] in pixels from the upper left corner of a picture of size_px"
            }
            Self::OffMesh => {
                "check camera and size_px: they must be those of the view that it was drawn on"
            }
        }
    }
}

impl Explain for GuidesError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::verbatim(match self {
            Self::File(error) => return error.hint(),
            Self::Text(error) => return error.hint(),
            Self::Size { .. } => {
                "write [800, 600] for a width and height of 1 to 16384, at most 67108864 pixels"
            }
            Self::Camera { .. } => {
                "write [30.0, 20.0, 30.0]: degrees around the model, above the horizon (-90 to 90), \
                 and of the field of view (1 to 170)"
            }
            Self::NoGuides { .. } => "add a [[guide]] with points = [[10, 20], [90, 60]]",
            Self::Guide { fault, .. } => fault.way_out(),
        }))
    }

    fn fault(&self) -> Fault {
        match self {
            Self::File(error) => error.fault(),
            Self::Text(error) => error.fault(),
            _ => Fault::Input,
        }
    }
}
