//! A picture with its mipmap levels.
//!
//! Each level has half the width and height of the one below, rounded up. A cell is the mean, in
//! linear light, of the two by two cells below it, so that a picture keeps its brightness when you
//! zoom out. We average only the changed part again.

use std::sync::LazyLock;

use eframe::egui::{Color32, ColorImage};
use graphics::tile::Rect;
use palette::{LinSrgb, Srgb};

/// Number of entries of the table that encodes linear light. The smallest step of 8-bit sRGB, 1 /
/// 255 / 12.92, is 2.5 entries wide.
const STEPS: usize = 8192;

/// A level is the last one if no side is longer than this, in cells.
const SMALLEST: usize = 128;

#[derive(Debug, Clone)]
struct MipLevel {
    width: usize,
    height: usize,
    pixels: Vec<Color32>,
}

/// All mipmap levels of a picture. Level 0 is the picture itself.
#[derive(Debug, Clone)]
pub(super) struct MipLevels {
    levels: Vec<MipLevel>,
}

impl MipLevels {
    /// A picture of `width` by `height` cells in one colour.
    pub(super) fn new(width: usize, height: usize, color: Color32) -> Self {
        let mut levels = Vec::new();
        let mut width = width.max(1);
        let mut height = height.max(1);
        loop {
            levels.push(MipLevel { width, height, pixels: vec![color; width * height] });
            if width.max(height) <= SMALLEST {
                return Self { levels };
            }
            (width, height) = (width.div_ceil(2), height.div_ceil(2));
        }
    }

    pub(super) fn count(&self) -> usize {
        self.levels.len()
    }

    /// The rectangle of all cells of a level.
    pub(super) fn bounds(&self, level: usize) -> Rect {
        let MipLevel { width, height, .. } = self.levels[level];
        Rect { x: 0, y: 0, width, height }
    }

    /// Writes a rectangle of the picture, row by row, and updates the other levels. This ignores
    /// pixels outside the picture.
    pub(super) fn write(&mut self, rect: Rect, pixels: &[[u8; 4]]) {
        let inside = rect.intersection(self.bounds(0));
        let base = &mut self.levels[0];
        for y in inside.y..inside.y + inside.height {
            let from = (y - rect.y) * rect.width + inside.x - rect.x;
            let to = y * base.width + inside.x;
            let row = &mut base.pixels[to..to + inside.width];
            for (cell, &[red, green, blue, _]) in row.iter_mut().zip(&pixels[from..]) {
                *cell = Color32::from_rgb(red, green, blue);
            }
        }
        let mut changed = inside;
        for level in 1..self.levels.len() {
            changed = next_level_rect(changed);
            let (below, above) = self.levels.split_at_mut(level);
            above[0].average(&below[level - 1], changed);
        }
    }

    /// Number of columns of a level, and its cells row by row.
    pub(super) fn cells(&self, level: usize) -> (usize, &[Color32]) {
        let MipLevel { width, pixels, .. } = &self.levels[level];
        (*width, pixels)
    }

    pub(super) fn region(&self, level: usize, rect: Rect) -> ColorImage {
        let MipLevel { width, pixels, .. } = &self.levels[level];
        let rows = (rect.y..rect.y + rect.height).map(|y| y * width + rect.x);
        let pixels = rows.flat_map(|from| &pixels[from..from + rect.width]).copied().collect();
        ColorImage::new([rect.width, rect.height], pixels)
    }
}

/// The cells of the next level that depend on the cells of `rect`.
pub(super) fn next_level_rect(rect: Rect) -> Rect {
    let x = rect.x / 2;
    let y = rect.y / 2;
    let right = (rect.x + rect.width).div_ceil(2);
    let bottom = (rect.y + rect.height).div_ceil(2);
    Rect { x, y, width: right - x, height: bottom - y }
}

impl MipLevel {
    fn average(&mut self, below: &Self, changed: Rect) {
        // We bind this once, because each access checks whether the tables exist.
        let decoded = &*DECODED;
        let encoded = &**ENCODED;
        for y in changed.y..changed.y + changed.height {
            for x in changed.x..changed.x + changed.width {
                let mut sum = [0.0_f32; 3];
                let mut cells = 0.0;
                for row in 2 * y..(2 * y + 2).min(below.height) {
                    for column in 2 * x..(2 * x + 2).min(below.width) {
                        let cell = below.pixels[row * below.width + column];
                        sum[0] += decoded[usize::from(cell.r())];
                        sum[1] += decoded[usize::from(cell.g())];
                        sum[2] += decoded[usize::from(cell.b())];
                        cells += 1.0;
                    }
                }
                let [red, green, blue] = sum.map(|sum| encoded[step(sum / cells)]);
                self.pixels[y * self.width + x] = Color32::from_rgb(red, green, blue);
            }
        }
    }
}

/// Linear light of each 8-bit value of sRGB (IEC 61966-2-1).
static DECODED: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|value| {
        let value = value as u8;
        Srgb::new(value, value, value).into_linear::<f32>().red
    })
});

/// The nearest 8-bit sRGB value of each step of linear light.
static ENCODED: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let steps = (0..STEPS).map(|step| step as f32 / (STEPS - 1) as f32);
    steps.map(|light| Srgb::<u8>::from_linear(LinSrgb::new(light, light, light)).red).collect()
});

/// The nearest step of linear light.
fn step(linear: f32) -> usize {
    let step = (linear * (STEPS - 1) as f32 + 0.5) as usize;
    step.min(STEPS - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(value: u8) -> [u8; 4] {
        [value, value, value, 255]
    }

    /// The values of a level of greys. This asserts that the channels are equal.
    fn greys_of(levels: &MipLevels, level: usize) -> Vec<u8> {
        levels
            .region(level, levels.bounds(level))
            .pixels
            .iter()
            .map(|pixel: &Color32| {
                let [red, green, blue, _] = pixel.to_array();
                assert!(red == green && green == blue, "{pixel:?} of greys");
                green
            })
            .collect()
    }

    #[test]
    fn a_flat_color_is_equal_at_every_level() {
        for value in 0..=255 {
            let mut levels = MipLevels::new(300, 2, Color32::BLACK);
            levels.write(levels.bounds(0), &[grey(value); 600]);
            for level in 0..levels.count() {
                assert!(greys_of(&levels, level).iter().all(|&is| is == value), "{value} {level}");
            }
        }
    }

    #[test]
    fn levels_average_in_linear_light() {
        let mut levels = MipLevels::new(200, 200, Color32::BLACK);
        let cells: Vec<[u8; 4]> = (0..40_000).map(|at| grey(255 * (at % 2) as u8)).collect();
        levels.write(levels.bounds(0), &cells);
        // Half of the light is 188 in sRGB, not 128.
        assert!(
            greys_of(&levels, 1).iter().all(|&is| is == 188),
            "{:?}",
            &greys_of(&levels, 1)[..4]
        );
    }

    /// Cells of a pattern of greys.
    fn cells(rect: Rect) -> Vec<[u8; 4]> {
        (rect.y..rect.y + rect.height)
            .flat_map(|y| {
                (rect.x..rect.x + rect.width)
                    .map(move |x| grey(((x * 31 + y * 17 + x * y) % 256) as u8))
            })
            .collect()
    }

    #[test]
    fn writing_in_pieces_equals_writing_at_once() {
        // We use odd sizes, and pieces with edges that do not fall on blocks of two by two.
        let width = 333;
        let height = 257;
        let mut at_once = MipLevels::new(width, height, Color32::BLACK);
        at_once.write(at_once.bounds(0), &cells(at_once.bounds(0)));
        let mut pieces = MipLevels::new(width, height, Color32::WHITE);
        for y in (0..height).step_by(41) {
            for x in (0..width).step_by(37) {
                // The last pieces reach beyond the picture.
                let rect = Rect { x, y, width: 37, height: 41 };
                pieces.write(rect, &cells(rect));
            }
        }
        for level in 0..at_once.count() {
            assert_eq!(greys_of(&at_once, level), greys_of(&pieces, level), "level {level}");
        }
    }

    #[test]
    fn the_last_level_has_at_most_the_smallest_size() {
        fn sizes(width: usize, height: usize) -> Vec<usize> {
            let levels = MipLevels::new(width, height, Color32::BLACK);
            (0..levels.count()).map(|level| levels.bounds(level).width).collect::<Vec<_>>()
        }
        assert_eq!(sizes(1920, 1080), [1920, 960, 480, 240, 120]);
        assert_eq!(sizes(100, 30), [100]);
    }
}
