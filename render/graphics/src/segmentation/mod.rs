//! Divides photographs into flat regions by mean shift.
//!
//! This follows Comaniciu and Meer, "Mean shift: a robust approach toward feature space analysis"
//! (IEEE PAMI 24, 2002), section 4.2. Every pixel is a point in the joint domain of position and
//! colour. We move it to a mode of the density of these points. Connected pixels with nearby modes
//! form a region. We merge small regions into a neighbour.

mod mean_shift;
mod regions;

use documents::hint::Explain;
use rayon::prelude::*;

use crate::field::Field;
use mean_shift::{Bandwidth, LuvPlanes, MEETING, MOST_LANES, modes};
use regions::{RegionGraph, cut, join_alike, join_small, linked};

/// Settings of segmentation. You choose how coarse the regions are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SegmentationSettings {
    /// Radius of the window in the picture, in pixels: 1 to
    /// [`SegmentationSettings::MAX_SPATIAL_PX`]. Larger details stay. The time is proportional to
    /// the square of this radius.
    pub spatial_radius_px: f32,
    /// Radius of the window in colour, a difference in CIELUV above 0 (black and white differ by
    /// 100). This flattens smaller contrasts.
    pub range_radius: f32,
    /// We merge a region below this area in pixels into a neighbour.
    pub least_region_px: u32,
    /// Step in CIELUV by which smooth gradients are divided into tones, 0 and up. If you pass 0,
    /// gradients stay whole.
    pub tone_step: f32,
}

impl SegmentationSettings {
    /// Largest spatial radius in pixels.
    pub const MAX_SPATIAL_PX: f32 = 128.0;
}

impl Default for SegmentationSettings {
    /// Suits a photograph of about 1 megapixel: 10 px, 8 in CIELUV, regions of 60 px and more,
    /// gradients not divided.
    fn default() -> Self {
        Self { spatial_radius_px: 10.0, range_radius: 8.0, least_region_px: 60, tone_step: 0.0 }
    }
}

/// The regions of a picture and their colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Segmentation {
    /// Region of each pixel, from 0 on without gaps, in the order in which regions first appear
    /// row by row. A region is connected by rows and columns.
    pub labels: Field<u32>,
    /// Mean of each region: encoded sRGB weighted by coverage, and coverage.
    pub colors: Vec<[f32; 4]>,
}

impl Segmentation {
    /// The picture with each region in its mean colour. Use this to show the regions.
    #[must_use]
    pub fn flat(&self) -> Field<[f32; 4]> {
        let values = self
            .labels
            .values()
            .par_iter()
            .with_min_len(4096)
            .map(|&label: &u32| self.colors[label as usize])
            .collect();
        Field::from_values(self.labels.width(), self.labels.height(), values)
    }
}

/// Finds the regions of `picture`, which is encoded sRGB with coverage.
///
/// We link pixels with close modes and merge regions that are too small into a neighbour. Then we
/// merge neighbours if their mean colours differ by at most the range radius, the nearest first.
/// The mean colour of a region is the mean over the modes of its pixels. If
/// [`SegmentationSettings::tone_step`] is above 0, we divide smooth gradients into tones.
///
/// Bare paper (coverage below 1/2) counts as white and never shares a region with paint, unless
/// one of them is too small. The result does not depend on the number of threads.
///
/// # Errors
/// [`SegmentationError`] if a setting is out of its range.
pub fn segment(
    picture: &Field<[f32; 4]>,
    settings: &SegmentationSettings,
) -> Result<Segmentation, SegmentationError> {
    let bandwidth = settings.bandwidth()?;
    if picture.values().is_empty() {
        let labels = Field::filled(picture.width(), picture.height(), 0);
        return Ok(Segmentation { labels, colors: Vec::new() });
    }
    let margin = bandwidth.spatial_px.ceil() as usize + MOST_LANES + 1;
    let planes = LuvPlanes::new(picture, margin);
    let modes = modes(&planes, bandwidth, MEETING);
    let painted = |pixel: usize| picture.values()[pixel][3] >= 0.5;
    let (mut labels, count) = linked(&modes, painted, bandwidth);
    let mut graph = RegionGraph::new(&labels, count, &modes, painted);
    join_small(&mut graph, settings.least_region_px);
    join_alike(&mut graph, bandwidth.range.into());
    let mut count = graph.relabel(&mut labels);
    if settings.tone_step > 0.0 {
        (labels, count) = cut(&labels, count, &modes, settings.tone_step);
        let mut graph = RegionGraph::new(&labels, count, &modes, painted);
        join_small(&mut graph, settings.least_region_px);
        count = graph.relabel(&mut labels);
    }
    let colors = means(picture, &labels, count);
    Ok(Segmentation { labels, colors })
}

/// The mean of every region, weighted by coverage. This is white if the region's coverage is 0.
fn means(picture: &Field<[f32; 4]>, labels: &Field<u32>, count: usize) -> Vec<[f32; 4]> {
    let mut sums = vec![([0.0f64; 4], 0u32); count];
    for (&label, &[r, g, b, coverage]) in labels.values().iter().zip(picture.values()) {
        let (sums, pixels) = &mut sums[label as usize];
        for (sum, value) in
            sums.iter_mut().zip([r * coverage, g * coverage, b * coverage, coverage])
        {
            *sum += f64::from(value);
        }
        *pixels += 1;
    }
    sums.into_iter()
        .map(|([r, g, b, coverage], pixels): ([f64; 4], u32)| {
            let color = [r, g, b].map(|sum| if coverage > 0.0 { sum / coverage } else { 1.0 });
            let [r, g, b] = color.map(|value| value as f32);
            [r, g, b, (coverage / f64::from(pixels)) as f32]
        })
        .collect()
}

impl SegmentationSettings {
    fn bandwidth(&self) -> Result<Bandwidth, SegmentationError> {
        let spatial_px = self.spatial_radius_px;
        let range = self.range_radius;
        if !(1.0..=Self::MAX_SPATIAL_PX).contains(&spatial_px) {
            return Err(SegmentationError::SpatialRadius(spatial_px));
        }
        let step = self.tone_step;
        if !(step >= 0.0 && step.is_finite()) {
            return Err(SegmentationError::ToneStep(step));
        }
        if !(range > 0.0 && range.is_finite()) {
            return Err(SegmentationError::RangeRadius(range));
        }
        Ok(Bandwidth { spatial_px, range })
    }
}

/// A setting of segmentation is out of its range.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error, Explain)]
pub enum SegmentationError {
    /// The radius of the window in the picture.
    #[error("a spatial radius is 1 to {} px, found `{found}`", SegmentationSettings::MAX_SPATIAL_PX, found = .0)]
    #[hint("about a hundredth of the picture's width is usual")]
    SpatialRadius(f32),
    /// The radius of the window in colour.
    #[error("a range radius is a number above 0, found `{0}`")]
    #[hint("8 keeps apart what the eye tells apart; more gives flatter regions")]
    RangeRadius(f32),
    /// The step between tones.
    #[error("a step of tone is a number of 0 and up, found `{0}`")]
    #[hint("25 divides a round form into a few tones; 0 divides nothing")]
    ToneStep(f32),
}
