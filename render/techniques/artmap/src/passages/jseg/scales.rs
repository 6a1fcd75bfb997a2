//! The scales of JSEG, from the largest window to the smallest.

use graphics::field::Field;

use super::growing::grow;
use super::j_values::j_values;
use super::merging::merged;
use super::quantised::quantised;
use super::valleys::valleys;
use crate::passages::regions::Regions;

/// A size of the window.
struct Scale {
    /// Distance of the pixels that are looked at; the window is 8 times as wide, and 1.
    step: usize,
    /// Least size of a valley in pixels.
    least_px: usize,
    /// The picture's shorter side must be longer, in pixels.
    above_px: usize,
}

/// Windows of 65, 33, 17 and 9 pixels (Deng and Manjunath 2001, table I).
const SCALES: [Scale; 4] = [
    Scale { step: 8, least_px: 2048, above_px: 512 },
    Scale { step: 4, least_px: 512, above_px: 256 },
    Scale { step: 2, least_px: 128, above_px: 128 },
    Scale { step: 1, least_px: 32, above_px: 0 },
];

/// Regions of a CIELUV picture, quantised to `color_classes` classes at most.
///
/// All scales down to the finest are used, and only neighbours of nearly equal histograms are
/// merged: an over-segmentation.
pub(crate) fn jseg(luv: &Field<[f32; 3]>, color_classes: usize) -> Regions {
    if luv.values().is_empty() {
        return Regions { labels: Field::filled(luv.width(), luv.height(), 0), count: 0 };
    }
    let classes = quantised(luv, color_classes);
    let shorter = luv.width().min(luv.height());
    let scales: Vec<&Scale> = SCALES.iter().filter(|scale| shorter > scale.above_px).collect();
    let j: Vec<Field<f32>> = scales.iter().map(|scale| j_values(&classes, scale.step)).collect();
    let whole = Field::filled(luv.width(), luv.height(), 0);
    let mut regions = Regions { labels: whole, count: 1 };
    for (place, scale) in scales.iter().enumerate() {
        regions = divided(&regions, scale, &j[place..]);
    }
    merged(&regions, &classes)
}

/// The regions divided by their valleys at one scale. `j` starts with that scale.
fn divided(regions: &Regions, scale: &Scale, j: &[Field<f32>]) -> Regions {
    let mut labels = regions.labels.clone();
    let mut next = regions.count as u32;
    for (label, pixels) in (0..).zip(regions.pixels()) {
        let found = valleys(&labels, label, &pixels, &j[0], scale.least_px);
        if found.len() > 1 {
            grow(&mut labels, label, &pixels, &found, j, next);
            next += found.len() as u32 - 1;
        }
    }
    Regions::numbered(labels, next as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two mixtures of the same mean: columns and rows of two colours, and a plain one.
    fn mixtures() -> Field<[f32; 3]> {
        let color = |x: usize, y: usize| -> [f32; 3] {
            match (x < 80, y < 60) {
                (true, _) => {
                    [if (x / 3 + y / 5).is_multiple_of(2) { 30.0 } else { 45.0 }, 0.0, 10.0]
                }
                (false, true) => {
                    [if (y / 3 + x / 7).is_multiple_of(2) { 62.0 } else { 80.0 }, 20.0, 0.0]
                }
                (false, false) => [55.0, -30.0, -20.0],
            }
        };
        let values = (0..160 * 130).map(|i| color(i % 160, i / 160)).collect();
        Field::from_values(160, 130, values)
    }

    #[test]
    fn no_region_spans_two_textures() {
        let regions = jseg(&mixtures(), 16);
        let texture = |pixel: usize| match (pixel % 160 < 80, pixel / 160 < 60) {
            (true, _) => 0,
            (false, true) => 1,
            (false, false) => 2,
        };
        let mut strays = 0;
        for pixels in regions.pixels() {
            let mut counts = [0; 3];
            pixels.iter().for_each(|&pixel| counts[texture(pixel as usize)] += 1);
            strays += pixels.len() - counts.iter().max().unwrap();
        }
        assert!(regions.count >= 3, "{} regions", regions.count);
        assert!(strays < 160 * 130 / 50, "{strays} pixels lie in a region of another texture");
    }

    #[test]
    fn regions_do_not_depend_on_threads() {
        let picture = mixtures();
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| jseg(&picture, 16))
        };
        assert!(with(1) == with(3));
    }

    #[test]
    fn pictures_of_any_size_have_regions() {
        for (width, height) in [(0, 0), (1, 1), (1, 40), (9, 2)] {
            let regions = jseg(&Field::filled(width, height, [50.0, 0.0, 0.0]), 10);
            assert_eq!(regions.count, usize::from(width > 0), "{width} x {height}");
        }
    }
}
