//! Division of photographs into flat regions by mean shift.
//!
//! After Comaniciu and Meer, "Mean shift: a robust approach toward feature space
//! analysis" (IEEE PAMI 24, 2002), section 4.2. Every pixel is a point in the joint domain
//! of position and colour, and is moved to a mode of the density of these points. Connected
//! pixels with nearby modes form a region. Small regions are merged into a neighbour.

mod luv;
mod mean_shift;
mod climb;
mod regions;
mod region_graph;
mod pruning;
mod tones;
mod segment;

pub use segment::{Segmentation, SegmentationError, SegmentationSettings, segment};
