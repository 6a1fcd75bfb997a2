//! Samples taken from a painting or photograph by marks.
//!
//! ```text
//! picture -> over-segmentation (jseg) -> traits -> joining <- marks (scribbles, rectangles)
//!                                                    |
//!                        SampleSet <- upright <- spacing <- direction of each passage
//! ```
//!
//! After Yan, Chi, Lee and Lin (2008, section 4.1): the painter draws one line over each passage;
//! regions are joined to passages; each passage is turned until its strokes run along y, and
//! resized until all have one spacing of strokes.

mod settings;
mod source;
mod perceived;
mod regions;
mod marks;
mod error;
mod jseg;
mod over;
mod traits;
mod gaps;
mod joining;
mod direction;
mod frame;
mod spacing;
mod upright;
mod report;
mod shown;
mod taking;
mod propose;

#[cfg(test)]
mod made_up;

#[cfg(test)]
mod tests;

pub use direction::StrokeDirection;
pub use error::PassageError;
pub use marks::{Mark, MarkFault, MarkedArea, Marks, MarksError};
pub use over::over_segmented;
pub use propose::propose_marks;
pub use regions::Regions;
pub use report::{PassageReport, SpacingSource, StrokesSeen};
pub use settings::{Density, OverSegmentation, PassageSettings};
pub use shown::{color_of_mark, drawn_in, marked_picture};
pub use source::SourcePicture;
pub use taking::samples_of_picture;
