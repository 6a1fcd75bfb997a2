//! Takes upright samples of one spacing from a picture and its marks. It can also propose marks:
//! large, textured passages that differ most.

use graphics::field::Field;
use graphics::picture::Picture;

use super::joining::{RegionTraits, joined_alike, passages};
use super::marks::{DrawnArea, Mark, MarkedArea, Marks};
use super::over_segmentation::{check_colors, over_segmented};
use super::regions::{Regions, gradient_of, intensity_of, luv_of};
use super::report::{PassageReport, SpacingSource, StrokesSeen};
use super::settings::{Density, PassageError, PassageSettings, SourcePicture};
use super::upright::{Estimate, Frame, StrokeDirection, estimated, upright};
use crate::sample::{Sample, SampleSet};

/// A passage must be this many distances of strokes wide.
const LEAST_SPACINGS: f64 = 4.0;

/// We resize a sample by at most this factor.
const MOST_SCALE: f64 = 8.0;

/// Takes the marked samples of a picture. They are upright, have one spacing, and go from dark to
/// light. You also get a report of each.
///
/// We measure the direction of strokes and the distance between them in the lightness and, if the
/// picture has a true relief, in the height of the paint. We use the clearer of the two.
///
/// The spacing is the median of the samples' spacings. If their number is even, this is the
/// smaller one in the middle. With [`Density::Width`], `mm_per_texel` is the geometric mean of
/// both directions.
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
        return Err(PassageError::NoSpacing(without));
    }
    let spacing = level(&mut reports, settings.density)?;
    reports.sort_by(|one, other| one.lightness.total_cmp(&other.lightness));
    let samples = reports.iter().map(|report| sample(picture, report, spacing)).collect();
    let paint = picture.paint.as_ref().map(|(_, paint)| paint.clone());
    Ok((SampleSet { samples, paint, provenance: picture.provenance.clone() }, reports))
}

/// Tones and relief of the picture. We find and measure passages in these.
struct Seen {
    intensity: Field<f32>,
    gradient: Field<[f32; 2]>,
    luv: Field<[f32; 3]>,
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
    fn mask(pixels: &[u32], height: usize, width: usize) -> Field<bool> {
        let mut mask = Field::filled(width, height, false);
        pixels.iter().for_each(|&pixel| mask.values_mut()[pixel as usize] = true);
        mask
    }
    let mut grown = grown.into_iter();
    let masks = areas.into_iter().map(|area| match area {
        DrawnArea::Whole(pixels) => (mask(&pixels, height, width), 0),
        DrawnArea::Line(line) => grown.next().map_or((mask(&line, height, width), 0), |found| {
            (mask(&found.pixels, height, width), found.regions_under)
        }),
    });
    Ok(masks.collect())
}

/// Direction and spacing of one passage. `None` if we cannot estimate its spacing.
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

/// Sets the scale of each sample so that all have the median spacing. Returns this spacing.
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

/// A passage has at least this share of the picture.
const LEAST_SHARE: f64 = 0.01;

/// A passage with strokes has at least this deviation of the intensity, 0 to 1.
const LEAST_DEVIATION: f64 = 0.01;

/// Beyond this unlikeness, passages count as equally unlike.
const MOST_APART: f64 = 4.0;

/// We try lines through the middle of a passage in this many directions.
const DIRECTIONS: usize = 16;

/// Proposes marks for at most `count` samples of a picture in linear sRGB. These are scribbles
/// inside passages that are large, have strokes, and differ most in tone, contrast and direction.
/// You get the names `passage 1` and so on. The first passage is the largest.
///
/// # Errors
/// [`PassageError`] if a setting or a colour is out of its range, or no passage has strokes.
pub fn propose_marks(
    picture: &Picture,
    count: usize,
    settings: &PassageSettings,
) -> Result<Marks, PassageError> {
    if picture.values().is_empty() {
        return Err(PassageError::NothingToPropose);
    }
    let over = over_segmented(picture, settings)?;
    let intensity = intensity_of(picture);
    let (regions, traits) =
        joined_alike(&over, &intensity, &gradient_of(&intensity), settings.reach);
    let depths = depths(&regions);
    let pixels = regions.pixels();
    let chosen = chosen(&traits, picture.values().len(), count);
    let samples = (1..).zip(chosen).map(|(number, label)| Mark {
        name: format!("passage {number}"),
        area: MarkedArea::Scribble(scribble(&regions, label, &pixels[label], &depths)),
        spacing: None,
    });
    let samples: Vec<Mark> = samples.collect();
    if samples.is_empty() {
        return Err(PassageError::NothingToPropose);
    }
    Ok(Marks { file: "proposed marks".to_owned(), painting: None, samples })
}

/// Labels of the chosen regions. The largest comes first. Then we always take the one with the
/// largest product of extent and unlikeness to those before.
fn chosen(traits: &[RegionTraits], picture_px: usize, count: usize) -> Vec<usize> {
    let least = LEAST_SHARE * picture_px as f64;
    let mut left: Vec<usize> = (0..traits.len())
        .filter(|label: &usize| {
            traits[*label].pixels >= least && traits[*label].deviation() >= LEAST_DEVIATION
        })
        .collect();
    let mut chosen: Vec<usize> = Vec::new();
    while chosen.len() < count {
        fn worth(label: usize, chosen: &[usize], traits: &[RegionTraits]) -> f64 {
            let apart = chosen.iter().map(|&other| traits[label].apart(&traits[other]));
            apart.fold(MOST_APART, f64::min) * traits[label].pixels.sqrt()
        }
        // Among equal ones this takes the first.
        let best = (0..left.len()).rev().max_by(|&one, &other| {
            worth(left[one], &chosen, traits).total_cmp(&worth(left[other], &chosen, traits))
        });
        let Some(best) = best else { break };
        chosen.push(left.remove(best));
    }
    chosen
}

fn depths(regions: &Regions) -> Field<u32> {
    let mut depths = regions.depths();
    let width = depths.width();
    let height = depths.height();
    for y in 0..height {
        for x in 0..width {
            let edge = (x + 1).min(y + 1).min(width - x).min(height - y);
            let depth = &mut depths[(x, y)];
            *depth = (*depth).min(edge as u32);
        }
    }
    depths
}

/// Tries several lines through the deepest pixel that stay inside the region, and returns the
/// longest.
fn scribble(regions: &Regions, label: usize, pixels: &[u32], depths: &Field<u32>) -> Vec<[f64; 2]> {
    let width = regions.labels.width();
    fn depth(pixel: u32, depths: &Field<u32>) -> u32 {
        depths.values()[pixel as usize]
    }
    let deepest =
        pixels.iter().rev().copied().max_by_key(|&pixel| depth(pixel, depths)).unwrap_or(0);
    let middle = [f64::from(deepest % width as u32), f64::from(deepest / width as u32)];
    let least = (depth(deepest, depths) / 4).max(1);
    let inside = |[x, y]: [f64; 2]| {
        let x = x.round();
        let y = y.round();
        let within = x >= 0.0 && y >= 0.0 && x < width as f64 && y < depths.height() as f64;
        within && {
            let at = (x as usize, y as usize);
            regions.labels[at] as usize == label && depths[at] >= least
        }
    };
    let lines = (0..DIRECTIONS).map(|number| {
        let angle = std::f64::consts::PI * number as f64 / DIRECTIONS as f64;
        let (sin, cos) = angle.sin_cos();
        [[-cos, -sin], [cos, sin]].map(|[dx, dy]| {
            let steps = (0..).map(f64::from);
            let places = steps.map(|step| [middle[0] + step * dx, middle[1] + step * dy]);
            let end = places.take_while(|&place| inside(place)).last().unwrap_or(middle);
            end.map(f64::round)
        })
    });
    fn length([from, to]: &[[f64; 2]; 2]) -> f64 {
        (to[0] - from[0]).hypot(to[1] - from[1])
    }
    let longest =
        lines.reduce(|best, line| if length(&line) > length(&best) { line } else { best });
    longest.map_or(vec![middle], |line| line.to_vec())
}

#[cfg(test)]
mod tests {
    use super::super::joining::traits_of;
    use super::super::made_up::{Painting, textured};
    use super::*;

    #[test]
    fn each_texture_of_a_painting_gets_a_scribble() {
        for painting in [Painting::stripes(), Painting::quarters()] {
            let picture = painting.picture();
            let textures = painting.textures.len();
            let marks = propose_marks(&picture, textures, &PassageSettings::default()).unwrap();
            assert_eq!(marks.samples.len(), textures);
            let mut seen = Vec::new();
            for mark in &marks.samples {
                let MarkedArea::Scribble(points) = &mark.area else { panic!("a scribble") };
                let own: Vec<usize> = points
                    .iter()
                    .map(|point: &[f64; 2]| {
                        painting.texture_at(point[0] as usize, point[1] as usize)
                    })
                    .collect();
                assert!(own.iter().all(|texture| *texture == own[0]), "{own:?}");
                seen.push(own[0]);
            }
            seen.sort_unstable();
            assert_eq!(seen, (0..textures).collect::<Vec<_>>());
            assert!(marks.drawn(picture.width(), picture.height()).is_ok(), "lines do not cross");
        }
    }

    #[test]
    fn an_unlike_passage_comes_before_a_larger_like_one() {
        // Strips of 50, 40 and 10 columns, all with waves. The first two are nearly alike.
        fn strip(x: usize) -> usize {
            usize::from(x >= 50) + usize::from(x >= 90)
        }
        let intensity = Field::from_values(
            100,
            40,
            (0..4000)
                .map(|i: usize| [0.5, 0.52, 0.8][strip(i % 100)] + 0.05 * ((i / 100) as f32).sin())
                .collect(),
        );
        let labels = (0..4000).map(|i| strip(i % 100) as u32).collect();
        let regions = Regions { labels: Field::from_values(100, 40, labels), count: 3 };
        let traits = traits_of(&regions, &intensity, &gradient_of(&intensity));
        assert_eq!(chosen(&traits, 4000, 2), [0, 2]);
        assert_eq!(chosen(&traits, 4000, 9), [0, 2, 1], "no more than there are");
        assert!(chosen(&traits, 500_000, 2).is_empty(), "too small a share of the picture");
    }

    #[test]
    fn a_flat_picture_has_nothing_to_propose() {
        let flat = Field::filled(60, 40, [0.3; 3]);
        let error = propose_marks(&flat, 3, &PassageSettings::default()).unwrap_err();
        assert!(matches!(error, PassageError::NothingToPropose), "{error}");
        let picture = textured(60, 40, 1, &[Default::default()], |_, _| 0);
        assert!(propose_marks(&picture, 0, &PassageSettings::default()).is_err(), "none asked for");
    }
}
