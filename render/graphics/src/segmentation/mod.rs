//! Photographs to flat regions by mean shift.
//!
//! After Comaniciu and Meer, "Mean shift: a robust approach toward feature space
//! analysis" (IEEE PAMI 24, 2002), section 4.2: every pixel, a point of place and
//! colour, climbs to a mode of the density of such points; pixels whose modes are near
//! make a region; regions too small join a neighbour.

mod luv;

mod mean_shift;

mod climb;

mod regions;

mod region_graph;

mod pruning;

mod tones;

mod segment;

pub use segment::{Segmentation, SegmentationError, SegmentationSettings, segment};
