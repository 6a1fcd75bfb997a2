//! Taking samples: from a picture and its marks to upright samples of one spacing.

use graphics::field::Field;

use super::direction::StrokeDirection;
use super::error::PassageError;
use super::frame::Frame;
use super::joining::passages;
use super::marks::{DrawnArea, Mark, Marks};
use super::over::{check_colors, over_segmented};
use super::perceived::{gradient_of, intensity_of, luv_of};
use super::regions::Regions;
use super::report::{PassageReport, SpacingSource, StrokesSeen};
use super::settings::{Density, PassageSettings};
use super::source::SourcePicture;
use super::spacing::{Estimate, estimated};
use super::upright::upright;
use crate::sample::{Sample, SampleSet};

/// Least width of a passage in distances of strokes.
const LEAST_SPACINGS: f64 = 4.0;

/// Largest factor by which a sample is resized.
const MOST_SCALE: f64 = 8.0;

/// The marked samples of a picture, upright, of one spacing, dark to light, and a report of each.
///
/// Direction and distance of strokes are measured in the lightness and, where the picture has a true
/// relief, in the height of the paint; the clearer of both counts.
///
/// The spacing is that of the sample of median spacing; of an even number, of the smaller one in
/// the middle. With [`Density::Width`], `mm_per_texel` is the geometric mean of both directions.
///
/// # Errors
/// [`PassageError`]. If spacings cannot be estimated, it names all such samples.
pub fn samples_of_picture(
    picture: &SourcePicture,
    marks: &Marks,
    settings: &PassageSettings,
) -> Result<(SampleSet, Vec<PassageReport>), PassageError> {
    settings.check()?;
    if let Some((channel, found)) = picture.odd_channel() {
        return Err(PassageError::ChannelSize { channel, found, wanted: picture.size() });
    }
    check_colors(&picture.color)?;
    let areas = marks.drawn(picture.size().0, picture.size().1)?;
    let seen = Seen::of(picture);
    let masks = masks(picture, &seen, areas, settings)?;
    let mut reports = Vec::new();
    let mut without = Vec::new();
    for (mark, (mask, regions_under)) in marks.samples.iter().zip(masks) {
        match report(mark, mask, regions_under, &seen, settings.spacing)? {
            Some(report) => reports.push(report),
            None => without.push(mark.name.clone()),
        }
    }
    if !without.is_empty() {
        return Err(PassageError::NoSpacing { samples: without });
    }
    let spacing = level(&mut reports, settings.density)?;
    reports.sort_by(|one, other| one.lightness.total_cmp(&other.lightness));
    let samples = reports.iter().map(|report| sample(picture, report, spacing)).collect();
    let paint = picture.paint.as_ref().map(|(_, paint)| paint.clone());
    Ok((SampleSet { samples, paint, provenance: picture.provenance.clone() }, reports))
}

/// Tones and relief of the picture, by which passages are found and measured.
struct Seen {
    intensity: Field<f32>,
    gradient: Field<[f32; 2]>,
    luv: Field<[f32; 3]>,
    /// Heights in mm and their gradient.
    relief: Option<(Field<f32>, Field<[f32; 2]>)>,
}

impl Seen {
    fn of(picture: &SourcePicture) -> Self {
        let intensity = intensity_of(&picture.color);
        let gradient = gradient_of(&intensity);
        let height = picture.height_mm.as_ref().filter(|_| !picture.guessed_relief);
        let relief = height.map(|height| (height.clone(), gradient_of(height)));
        Self { intensity, gradient, luv: luv_of(&picture.color), relief }
    }

    /// Direction of the strokes of a passage, in the channel where it is clearest.
    fn direction(&self, pixels: &[u32], depth: &Field<u32>) -> (StrokeDirection, StrokesSeen) {
        let color = StrokeDirection::of(pixels, depth, &self.intensity, &self.gradient);
        let relief = self.relief.as_ref();
        let relief =
            relief.map(|(height, slope)| StrokeDirection::of(pixels, depth, height, slope));
        match relief {
            Some(relief) if relief.coherence > color.coherence => (relief, StrokesSeen::Relief),
            _ => (color, StrokesSeen::Color),
        }
    }

    /// Distance of the strokes of a passage, in the channel where it is clearest.
    fn spacing(
        &self,
        mask: &Field<bool>,
        direction: &StrokeDirection,
    ) -> Option<(Estimate, StrokesSeen)> {
        let of = |values| estimated(values, mask, direction.along(), direction.turned);
        let color = of(&self.intensity).map(|found| (found, StrokesSeen::Color));
        let relief = self.relief.as_ref().and_then(|(height, _)| of(height));
        match relief.map(|found| (found, StrokesSeen::Relief)) {
            Some(relief) if color.is_none_or(|(c, _)| relief.0.sharpness > c.sharpness) => {
                Some(relief)
            }
            _ => color,
        }
    }
}

/// The mask of each sample, and the number of regions under its scribble.
fn masks(
    picture: &SourcePicture,
    seen: &Seen,
    areas: Vec<DrawnArea>,
    settings: &PassageSettings,
) -> Result<Vec<(Field<bool>, usize)>, PassageError> {
    let lines = areas.iter().filter_map(|area| match area {
        DrawnArea::Line(pixels) => Some(pixels.clone()),
        DrawnArea::Whole(_) => None,
    });
    let scribbles: Vec<Vec<u32>> = lines.collect();
    let mut grown = Vec::new();
    if !scribbles.is_empty() {
        let regions = over_segmented(&picture.color, settings)?;
        grown = passages(&regions, &scribbles, &seen.intensity, &seen.gradient, settings.reach);
    }
    let (width, height) = picture.size();
    let mask = |pixels: &[u32]| {
        let mut mask = Field::filled(width, height, false);
        pixels.iter().for_each(|&pixel| mask.values_mut()[pixel as usize] = true);
        mask
    };
    let mut grown = grown.into_iter();
    let masks = areas.into_iter().map(|area| match area {
        DrawnArea::Whole(pixels) => (mask(&pixels), 0),
        DrawnArea::Line(line) => grown
            .next()
            .map_or((mask(&line), 0), |found| (mask(&found.pixels), found.regions_under)),
    });
    Ok(masks.collect())
}

/// Direction and spacing of one passage; `None` if its spacing cannot be estimated.
fn report(
    mark: &Mark,
    mask: Field<bool>,
    regions_under: usize,
    seen: &Seen,
    usual_px: Option<f64>,
) -> Result<Option<PassageReport>, PassageError> {
    let labels = mask.values().iter().map(|&inside| u32::from(!inside)).collect();
    let labels = Field::from_values(mask.width(), mask.height(), labels);
    let depth = Regions { labels, count: 2 }.depths();
    let pixels: Vec<u32> =
        (0..).zip(mask.values()).filter(|(_, inside)| **inside).map(|(pixel, _)| pixel).collect();
    let (direction, direction_seen) = seen.direction(&pixels, &depth);
    let found = match (mark.spacing_px(), usual_px) {
        (Some(spacing_px), _) => Some((spacing_px, SpacingSource::Marked)),
        (None, Some(spacing_px)) => Some((spacing_px, SpacingSource::Set)),
        (None, None) => seen.spacing(&mask, &direction).map(|(found, seen)| {
            let source = SpacingSource::Estimated { sharpness: found.sharpness, seen };
            (found.spacing_px, source)
        }),
    };
    let Some((spacing_px, spacing_source)) = found else { return Ok(None) };
    let width_px = Frame::around(&mask, direction.along(), [1.0; 2]).size[0] as f64;
    if width_px < LEAST_SPACINGS * spacing_px {
        return Err(PassageError::Narrow { sample: mark.name.clone(), width_px, spacing_px });
    }
    let lightness = pixels.iter().map(|&pixel| f64::from(seen.luv.values()[pixel as usize][0]));
    let lightness = lightness.sum::<f64>() / pixels.len() as f64;
    Ok(Some(PassageReport {
        name: mark.name.clone(),
        mask,
        regions_under,
        direction,
        direction_seen,
        spacing_px,
        spacing_source,
        scale: [1.0; 2],
        lightness,
    }))
}

/// Sets the scale of each sample so that all have the median spacing. Returns it.
fn level(reports: &mut [PassageReport], density: Density) -> Result<f64, PassageError> {
    let mut order: Vec<usize> = (0..reports.len()).collect();
    order.sort_by(|&one, &other| reports[one].spacing_px.total_cmp(&reports[other].spacing_px));
    let median = &reports[order[(order.len() - 1) / 2]];
    let reference = median.name.clone();
    let reference_px = median.spacing_px;
    for report in reports {
        let scale = reference_px / report.spacing_px;
        if !(1.0 / MOST_SCALE..=MOST_SCALE).contains(&scale) {
            let sample = report.name.clone();
            let spacing_px = report.spacing_px;
            return Err(PassageError::Unlike { sample, spacing_px, reference, reference_px });
        }
        report.scale = match density {
            Density::Uniform => [scale; 2],
            Density::Width => [scale, 1.0],
        };
    }
    Ok(reference_px)
}

fn sample(picture: &SourcePicture, report: &PassageReport, spacing: f64) -> Sample {
    let frame = Frame::around(&report.mask, report.direction.along(), report.scale);
    let found = upright(picture, &report.mask, &frame);
    let scale = (report.scale[0] * report.scale[1]).sqrt();
    Sample {
        name: report.name.clone(),
        color: found.color,
        paint: found.paint,
        height_mm: found.height_mm,
        mask: found.mask,
        spacing,
        mm_per_texel: picture.mm_per_pixel.map(|mm| mm / scale),
        guessed_relief: picture.guessed_relief,
    }
}
