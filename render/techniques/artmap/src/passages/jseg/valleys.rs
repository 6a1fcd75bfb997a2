//! Valleys of J: the connected pixels of a region with small J, from which regions grow.

use graphics::field::Field;

use crate::passages::regions::beside;

/// Offsets of the threshold from the mean of J, in standard deviations (Deng and Manjunath 2001,
/// section IV A).
const OFFSETS: [f64; 7] = [-0.7, -0.6, -0.4, -0.2, 0.0, 0.2, 0.4];

/// The valleys of the region `label` with at least `least_px` pixels.
///
/// `pixels` are those of the region. Of all thresholds the lowest is taken that gives most
/// valleys.
pub(super) fn valleys(
    labels: &Field<u32>,
    label: u32,
    pixels: &[u32],
    j: &Field<f32>,
    least_px: usize,
) -> Vec<Vec<u32>> {
    let count = pixels.len() as f64;
    let value = |pixel: u32| f64::from(j.values()[pixel as usize]);
    let mean = pixels.iter().map(|&pixel| value(pixel)).sum::<f64>() / count;
    let squares = pixels.iter().map(|&pixel| (value(pixel) - mean).powi(2)).sum::<f64>();
    let deviation = (squares / count).sqrt();
    let mut found: Vec<Vec<u32>> = Vec::new();
    for offset in OFFSETS {
        let threshold = mean + offset * deviation;
        let parts = components(pixels, (labels.width(), labels.height()), |pixel: u32| {
            labels.values()[pixel as usize] == label && value(pixel) < threshold
        });
        let large: Vec<_> = parts.into_iter().filter(|part| part.len() >= least_px).collect();
        if large.len() > found.len() {
            found = large;
        }
    }
    found
}

/// The connected parts of those `pixels` that are `inside`, by rows and columns.
pub(super) fn components(
    pixels: &[u32],
    (width, height): (usize, usize),
    inside: impl Fn(u32) -> bool,
) -> Vec<Vec<u32>> {
    let Some((&first, &last)) = pixels.first().zip(pixels.last()) else { return Vec::new() };
    // Pixels are in rising order, so the seen ones need no field of the picture's size.
    let mut seen = vec![false; (last - first) as usize + 1];
    let mut parts = Vec::new();
    for &pixel in pixels {
        if seen[(pixel - first) as usize] || !inside(pixel) {
            continue;
        }
        seen[(pixel - first) as usize] = true;
        let mut part = vec![pixel];
        let mut next = 0;
        while next < part.len() {
            for other in beside(part[next], width, height) {
                if (first..=last).contains(&other)
                    && !seen[(other - first) as usize]
                    && inside(other)
                {
                    seen[(other - first) as usize] = true;
                    part.push(other);
                }
            }
            next += 1;
        }
        parts.push(part);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn valleys_are_the_large_parts_of_small_j() {
        // Two basins of 8 x 10 pixels with a ridge of 4 between them, and a pit of 4 pixels.
        let mut j = Field::filled(20, 10, 0.1);
        for y in 0..10 {
            for x in 8..12 {
                j[(x, y)] = 1.0;
            }
        }
        for (x, y) in [(9, 4), (10, 4), (9, 5), (10, 5)] {
            j[(x, y)] = 0.05;
        }
        let labels = Field::filled(20, 10, 0);
        let pixels: Vec<u32> = (0..200).collect();
        let found = valleys(&labels, 0, &pixels, &j, 32);
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [80, 80]);
        let found = valleys(&labels, 0, &pixels, &j, 4);
        assert_eq!(found.len(), 3, "the pit is large enough");
        assert!(valleys(&labels, 0, &pixels, &j, 100).is_empty(), "none is so large");
    }

    #[test]
    fn only_pixels_of_the_region_are_looked_at() {
        let labels = Field::from_values(4, 1, vec![1, 0, 1, 1]);
        let j = Field::from_values(4, 1, vec![0.0, 0.0, 0.0, 9.0]);
        assert_eq!(valleys(&labels, 1, &[0, 2, 3], &j, 1), [vec![0], vec![2]]);
    }
}
