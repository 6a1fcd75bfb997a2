//! Marks proposed for a picture: large, textured passages that differ most.

use graphics::field::Field;
use graphics::picture::Picture;

use super::error::PassageError;
use super::joining::joined_alike;
use super::marks::{Mark, MarkedArea, Marks};
use super::over::over_segmented;
use super::perceived::{gradient_of, intensity_of};
use super::regions::Regions;
use super::settings::PassageSettings;
use super::traits::RegionTraits;

/// Least share of the picture that a passage has.
const LEAST_SHARE: f64 = 0.01;

/// Least deviation of the intensity of a passage with strokes, 0 to 1.
const LEAST_DEVIATION: f64 = 0.01;

/// Unlikeness beyond which passages count as equally unlike.
const MOST_APART: f64 = 4.0;

/// Number of directions in which a line through the middle of a passage is tried.
const DIRECTIONS: usize = 16;

/// Marks for `count` samples at most of a picture in linear sRGB: scribbles inside passages that
/// are large, have strokes, and differ most in tone, contrast and direction. Names are `passage 1`
/// and so on; the first is the largest.
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

/// Labels of the chosen regions: the largest, then always the one with the largest product of
/// extent and unlikeness to those before.
fn chosen(traits: &[RegionTraits], picture_px: usize, count: usize) -> Vec<usize> {
    let least = LEAST_SHARE * picture_px as f64;
    let fits = |label: &usize| {
        traits[*label].pixels >= least && traits[*label].deviation() >= LEAST_DEVIATION
    };
    let mut left: Vec<usize> = (0..traits.len()).filter(fits).collect();
    let mut chosen: Vec<usize> = Vec::new();
    while chosen.len() < count {
        let worth = |label: usize| {
            let apart = chosen.iter().map(|&other| traits[label].apart(&traits[other]));
            apart.fold(MOST_APART, f64::min) * traits[label].pixels.sqrt()
        };
        // Of equal ones the first.
        let best = (0..left.len())
            .rev()
            .max_by(|&one, &other| worth(left[one]).total_cmp(&worth(left[other])));
        let Some(best) = best else { break };
        chosen.push(left.remove(best));
    }
    chosen
}

/// Distance of each pixel from the border of its region or of the picture.
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

/// The longest of several lines through the deepest pixel that stay inside of the region.
fn scribble(regions: &Regions, label: usize, pixels: &[u32], depths: &Field<u32>) -> Vec<[f64; 2]> {
    let width = regions.labels.width();
    let depth = |pixel: u32| depths.values()[pixel as usize];
    let deepest = pixels.iter().rev().copied().max_by_key(|&pixel| depth(pixel)).unwrap_or(0);
    let middle = [f64::from(deepest % width as u32), f64::from(deepest / width as u32)];
    let least = (depth(deepest) / 4).max(1);
    let inside = |[x, y]: [f64; 2]| {
        let x = x.round();
        let y = y.round();
        let within = x >= 0.0 && y >= 0.0 && x < width as f64 && y < depths.height() as f64;
        within && {
            let at = (x as usize, y as usize);
            regions.labels[at] as usize == label && depths[at] >= least
        }
    };
    let walked = |[dx, dy]: [f64; 2]| {
        let at = |step: f64| [middle[0] + step * dx, middle[1] + step * dy];
        let steps = (0..).map(f64::from).take_while(|&step| inside(at(step)));
        let end = at(steps.last().unwrap_or(0.0));
        end.map(f64::round)
    };
    let lines = (0..DIRECTIONS).map(|number| {
        let angle = std::f64::consts::PI * number as f64 / DIRECTIONS as f64;
        let (sin, cos) = angle.sin_cos();
        [walked([-cos, -sin]), walked([cos, sin])]
    });
    let length = |[from, to]: &[[f64; 2]; 2]| (to[0] - from[0]).hypot(to[1] - from[1]);
    let longest =
        lines.reduce(|best, line| if length(&line) > length(&best) { line } else { best });
    longest.map_or(vec![middle], |line| line.to_vec())
}

#[cfg(test)]
mod tests {
    use super::super::made_up::{Painting, textured};
    use super::super::traits::traits_of;
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
                let at =
                    |point: &[f64; 2]| painting.texture_at(point[0] as usize, point[1] as usize);
                let own: Vec<usize> = points.iter().map(at).collect();
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
        // Strips of 50, 40 and 10 columns, all with waves; the first two are nearly alike.
        let strip = |x: usize| usize::from(x >= 50) + usize::from(x >= 90);
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
