//! Figures of how maps agree with each other, with themselves across their borders, and how often
//! they repeat a place of their sample.

use graphics::field::Field;

use super::texture::Texture;
use crate::tiling::blurred_tile;

/// Deviation, in texels, of the blur of the lightness that is compared.
const DETAIL: f64 = 2.0;

/// Correlation of the detail of L* of two maps that tile, -1 to 1: whether their strokes stand at
/// the same places. Detail is L* blurred by 2 texels, less L* blurred by `spacing`, the distance of
/// strokes.
///
/// # Panics
/// If the maps differ in size.
#[must_use]
pub fn coherence(first: &Texture, second: &Texture, spacing: f64) -> f64 {
    assert_eq!(first.size(), second.size(), "maps must be of one size");
    let first = detail(first.lightness(), spacing);
    let second = detail(second.lightness(), spacing);
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let squares = sum(&first, &first) * sum(&second, &second);
    if squares > 0.0 { sum(&first, &second) / squares.sqrt() } else { 0.0 }
}

/// Mean step of L* across the borders of a map that tiles, over the mean step within it: 1 where
/// no seam shows.
#[must_use]
pub fn wrap_ratio(map: &Texture) -> f64 {
    let (width, height) = map.size();
    let lightness = map.lightness();
    let mut across = (0.0, 0_u64);
    let mut inside = (0.0, 0_u64);
    let mut note = |wraps: bool, a: f32, b: f32| {
        let (sum, count) = if wraps { &mut across } else { &mut inside };
        *sum += f64::from((a - b).abs());
        *count += 1;
    };
    for y in 0..height {
        for x in 0..width {
            let right = (x + 1) % width;
            let below = (y + 1) % height;
            note(right == 0, lightness[(x, y)], lightness[(right, y)]);
            note(below == 0, lightness[(x, y)], lightness[(x, below)]);
        }
    }
    let mean = |(sum, count): (f64, u64)| sum / count.max(1) as f64;
    if mean(inside) > 0.0 { mean(across) / mean(inside) } else { 1.0 }
}

/// The figure of [`wrap_ratio`] that 95 of 100 places inside the map stay below: a column and a row
/// inside taken for the borders. A border above that stands out; strokes that happen to end at one
/// place raise both.
#[must_use]
pub fn usual_wrap_ratio(map: &Texture) -> f64 {
    let (width, height) = map.size();
    let lightness = map.lightness();
    let step =
        |a: (usize, usize), b: (usize, usize)| f64::from((lightness[a] - lightness[b]).abs());
    let column = |x: usize| (0..height).map(|y| step((x, y), (x + 1, y))).sum::<f64>();
    let row = |y: usize| (0..width).map(|x| step((x, y), (x, y + 1))).sum::<f64>();
    let columns: Vec<f64> = (0..width.saturating_sub(1)).map(column).collect();
    let rows: Vec<f64> = (0..height.saturating_sub(1)).map(row).collect();
    let inside: f64 = columns.iter().chain(&rows).sum();
    if inside <= 0.0 {
        return 1.0;
    }
    let mean = inside / (columns.len() * height + rows.len() * width) as f64;
    let pairs = columns.iter().zip(&rows);
    let mut ratios: Vec<f64> =
        pairs.map(|(x, y)| (x + y) / (width + height) as f64 / mean).collect();
    ratios.sort_by(f64::total_cmp);
    ratios.get(ratios.len() * 95 / 100).copied().unwrap_or(1.0)
}

/// Use of the most used part of a sample over the mean use of its parts, or over a single use where
/// the map is too small to show every part once: 1 where all are used alike. Parts are squares of
/// `block` texels that lie in the mask.
#[must_use]
pub fn most_used(sources: &Field<[u16; 2]>, mask: &Field<bool>, block: usize) -> f64 {
    let width = mask.width().div_ceil(block);
    let height = mask.height().div_ceil(block);
    let mut used = vec![0_u64; width * height];
    let mut inside = vec![0_u64; width * height];
    let part = |x: usize, y: usize| y / block * width + x / block;
    for &[x, y] in sources.values() {
        used[part(usize::from(x), usize::from(y))] += 1;
    }
    for (index, &is_inside) in mask.values().iter().enumerate() {
        inside[part(index % mask.width(), index / mask.width())] += u64::from(is_inside);
    }
    let all = inside.iter().sum::<u64>().max(1) as f64;
    let mean = (sources.values().len() as f64 / all).max(1.0);
    let uses = used
        .iter()
        .zip(&inside)
        .filter(|(_, inside): &(&u64, &u64)| **inside == (block * block) as u64);
    uses.map(|(&used, &inside)| used as f64 / inside as f64 / mean).fold(0.0, f64::max)
}

/// Detail of L* of a map that tiles, row by row.
fn detail(lightness: &Field<f32>, spacing: f64) -> Vec<f64> {
    let fine = blurred_tile(lightness, DETAIL);
    let coarse = blurred_tile(lightness, spacing.max(2.0 * DETAIL));
    let pairs = fine.values().iter().zip(coarse.values());
    pairs.map(|(fine, coarse)| f64::from(fine - coarse)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn waves(size: usize, period: f32, phase: f32, offset: f32) -> Texture {
        Texture::tiled(&Field::from_values(
            size,
            size,
            (0..size * size)
                .map(|index: usize| {
                    let angle = ((index % size) as f32 / period + phase) * std::f32::consts::TAU;
                    [offset + 0.2 * angle.sin(); 3]
                })
                .collect(),
        ))
    }

    #[test]
    fn strokes_at_the_same_places_are_coherent_whatever_their_tone() {
        let map = waves(96, 12.0, 0.0, 0.3);
        assert!(coherence(&map, &waves(96, 12.0, 0.0, 0.6), 12.0) > 0.95);
        assert!(coherence(&map, &waves(96, 12.0, 0.25, 0.3), 12.0).abs() < 0.1);
        assert!(coherence(&map, &waves(96, 12.0, 0.5, 0.3), 12.0) < -0.9);
    }

    #[test]
    fn a_border_that_does_not_fit_shows() {
        assert!(wrap_ratio(&waves(96, 12.0, 0.1, 0.3)) < 1.2);
        assert!(wrap_ratio(&waves(90, 12.0, 0.25, 0.3)) > 1.3);
    }

    #[test]
    fn places_inside_tell_what_is_usual() {
        // Waves along x: the steps down are 0, those across rise and fall with the waves, so that
        // the steepest columns have pi / 2 times the mean of columns.
        let map = waves(96, 12.0, 0.1, 0.3);
        let usual = usual_wrap_ratio(&map);
        assert!((usual - std::f64::consts::FRAC_PI_2).abs() < 0.1, "{usual}");
        let noise = |index: usize| [((index * 7919 % 4093) as f32 / 4093.0) * 0.5; 3];
        let noise = Field::from_values(64, 64, (0..64 * 64).map(noise).collect());
        let usual = usual_wrap_ratio(&Texture::tiled(&noise));
        assert!((1.0..1.3).contains(&usual), "{usual}");
        assert_eq!(usual_wrap_ratio(&Texture::tiled(&Field::filled(8, 8, [0.2; 3]))), 1.0);
    }

    #[test]
    fn a_place_used_for_everything_is_counted() {
        let mask = Field::filled(64, 64, true);
        let evenly = Field::from_values(
            64,
            64,
            (0..64 * 64).map(|index: usize| [(index % 64) as u16, (index / 64) as u16]).collect(),
        );
        assert!((most_used(&evenly, &mask, 16) - 1.0).abs() < 1e-9);
        let once = Field::filled(64, 64, [5, 5]);
        assert!((most_used(&once, &mask, 16) - 16.0).abs() < 1e-9);
    }
}
