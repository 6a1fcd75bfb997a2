//! Over-segmentation of a picture. You can choose one of two methods.

use graphics::encoding::encoded_from_linear;
use graphics::field::Field;
use graphics::picture::Picture;
use graphics::segmentation::{SegmentationSettings, segment};

use super::jseg::jseg;
use super::regions::{Regions, luv_of};
use super::settings::{OverSegmentation, PassageError, PassageSettings};

/// If the longer side is above this, we divide the picture at a smaller size. The windows of both
/// methods suit pictures of 0.1 to 1 megapixel.
const LONGEST_PX: usize = 1024;

/// Divides a picture into small regions. Passages are then joined from these regions.
///
/// If a picture is longer than 1024 px, we divide it at a whole fraction of its size.
///
/// # Errors
/// [`PassageError::Setting`] if a setting is out of its range, [`PassageError::NoColor`] if a
/// colour is not finite.
pub fn over_segmented(
    color: &Picture,
    settings: &PassageSettings,
) -> Result<Regions, PassageError> {
    settings.check()?;
    check_colors(color)?;
    let width = color.width();
    let height = color.height();
    let factor = width.max(height).div_ceil(LONGEST_PX).max(1);
    if factor == 1 {
        return Ok(divided(color, settings));
    }
    let small = divided(&reduced(color, factor), settings);
    let last = (small.labels.width() - 1, small.labels.height() - 1);
    let labels = (0..width * height).map(|pixel| {
        let (x, y) = (pixel % width / factor, pixel / width / factor);
        small.labels[(x.min(last.0), y.min(last.1))]
    });
    Ok(Regions::numbered(Field::from_values(width, height, labels.collect()), small.count))
}

pub(super) fn check_colors(color: &Picture) -> Result<(), PassageError> {
    let odd = color.values().iter().position(|color| !color.iter().all(|value| value.is_finite()));
    match odd.map(|pixel: usize| (pixel % color.width(), pixel / color.width())) {
        Some((x, y)) => Err(PassageError::NoColor { x, y }),
        None => Ok(()),
    }
}

fn divided(color: &Picture, settings: &PassageSettings) -> Regions {
    match settings.over {
        OverSegmentation::Jseg => jseg(&luv_of(color), settings.color_classes),
        OverSegmentation::MeanShift => {
            let opaque = color.values().iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect();
            let opaque = Field::from_values(color.width(), color.height(), opaque);
            let settings = SegmentationSettings::default();
            let found = segment(&encoded_from_linear(&opaque), &settings);
            let found = found.expect("the default settings are within their ranges");
            let below = found.colors.len();
            Regions::numbered(found.labels, below)
        }
    }
}

/// Means of squares of `factor` x `factor` pixels, in linear light. This leaves out squares that
/// the right or lower edge cuts off, unless they are the only ones.
fn reduced(color: &Picture, factor: usize) -> Picture {
    fn size(pixels: usize, factor: usize) -> usize {
        (pixels / factor).max(1)
    }
    let width = size(color.width(), factor);
    let height = size(color.height(), factor);
    Field::from_values(
        width,
        height,
        (0..width * height)
            .map(|cell: usize| {
                let left = cell % width * factor;
                let top = cell / width * factor;
                let across = factor.min(color.width() - left);
                let rows = top..(top + factor).min(color.height());
                let mut sum = [0.0f64; 3];
                for pixel in rows.clone().flat_map(|y| color.row(y, left, across)) {
                    sum.iter_mut().zip(pixel).for_each(|(sum, &value)| *sum += f64::from(value));
                }
                sum.map(|sum| (sum / (across * rows.len()) as f64) as f32)
            })
            .collect(),
    )
}

impl PassageSettings {
    /// Checks that all settings are within their ranges.
    ///
    /// # Errors
    /// [`PassageError::Setting`].
    pub(super) fn check(&self) -> Result<(), PassageError> {
        let figures = [
            ("reach", self.reach, 0.0, 10.0),
            ("color_classes", self.color_classes as f64, 10.0, 20.0),
            ("spacing", self.spacing.unwrap_or(1.0), 1.0, 1000.0),
        ];
        match figures.into_iter().find(|(_, found, least, most)| !(least..=most).contains(&found)) {
            Some((key, found, least, most)) => {
                Err(PassageError::Setting { key, least, most, found })
            }
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_large_picture_is_divided_at_a_smaller_size() {
        let values = (0..2400 * 60)
            .map(|i| if (i % 2400) < 1500 { [0.1, 0.1, 0.4] } else { [0.6, 0.3, 0.1] })
            .collect();
        let picture = Field::from_values(2400, 60, values);
        for over in [OverSegmentation::Jseg, OverSegmentation::MeanShift] {
            let settings = PassageSettings { over, ..PassageSettings::default() };
            let regions = over_segmented(&picture, &settings).unwrap();
            assert_eq!((regions.labels.width(), regions.labels.height()), (2400, 60));
            let [left, right] = [700, 2000].map(|x| regions.labels[(x, 30)]);
            assert_ne!(left, right, "{over:?}");
            let strays = (0..2400).filter(|&x| {
                let label = regions.labels[(x, 30)];
                (x < 1480 && label == right) || (x > 1520 && label == left)
            });
            assert_eq!(strays.count(), 0, "{over:?}");
        }
    }

    #[test]
    fn settings_and_colors_out_of_range_are_refused() {
        let picture = Field::filled(4, 4, [0.5; 3]);
        for (reach, color_classes, message) in [
            (f64::NAN, 16, "reach takes 0 to 10, found `NaN`"),
            (1.0, 40, "color_classes takes 10 to 20, found `40`"),
        ] {
            let settings = PassageSettings { reach, color_classes, ..PassageSettings::default() };
            let error = over_segmented(&picture, &settings).unwrap_err();
            assert_eq!(error.to_string(), message);
        }
        let mut broken = picture;
        broken[(2, 3)][1] = f32::NAN;
        let error = over_segmented(&broken, &PassageSettings::default()).unwrap_err();
        assert_eq!(error.to_string(), "the picture has no colour at [2, 3]");
    }
}
