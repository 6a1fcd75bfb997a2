//! A picture and its halves, for the screen.
//!
//! Each level has half the cells of the one below, rounded up; a cell is the mean
//! of the two by two below it, in linear light, so that a picture seen from afar
//! is as bright as its paint is. Only what changed is averaged again.

use std::sync::LazyLock;

use eframe::egui::{Color32, ColorImage};
use palette::{LinSrgb, Srgb};
use render::tile::Rect;

/// Steps of linear light that the encoding tells apart: 2.5 for the smallest
/// step of 8-bit sRGB.
const STEPS: usize = 8192;

/// A level this small in both directions has none above it.
const SMALLEST: usize = 128;

/// One level.
#[derive(Debug, Clone)]
struct Level {
    width: usize,
    height: usize,
    pixels: Vec<Color32>,
}

/// A picture and its halves; level 0 is the picture.
#[derive(Debug, Clone)]
pub(super) struct Levels {
    levels: Vec<Level>,
}

impl Levels {
    /// A picture of so many cells, all of one colour.
    pub(super) fn new(width: usize, height: usize, color: Color32) -> Self {
        let mut levels = Vec::new();
        let (mut width, mut height) = (width.max(1), height.max(1));
        loop {
            levels.push(Level { width, height, pixels: vec![color; width * height] });
            if width.max(height) <= SMALLEST {
                return Self { levels };
            }
            (width, height) = (width.div_ceil(2), height.div_ceil(2));
        }
    }

    /// How many levels there are; at least 1.
    pub(super) fn count(&self) -> usize {
        self.levels.len()
    }

    /// All cells of a level.
    pub(super) fn bounds(&self, level: usize) -> Rect {
        let Level { width, height, .. } = self.levels[level];
        Rect { x: 0, y: 0, width, height }
    }

    /// Writes part of the picture, row by row, and its halves. What lies outside
    /// the picture is left out.
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
            changed = halved(changed);
            let (below, above) = self.levels.split_at_mut(level);
            above[0].average(&below[level - 1], changed);
        }
    }

    /// Part of a level.
    pub(super) fn cut(&self, level: usize, rect: Rect) -> ColorImage {
        let Level { width, pixels, .. } = &self.levels[level];
        let rows = (rect.y..rect.y + rect.height).map(|y| y * width + rect.x);
        let pixels = rows.flat_map(|from| &pixels[from..from + rect.width]).copied().collect();
        ColorImage::new([rect.width, rect.height], pixels)
    }
}

/// The cells of the level above that a change of `rect` reaches.
pub(super) fn halved(rect: Rect) -> Rect {
    let (x, y) = (rect.x / 2, rect.y / 2);
    let right = (rect.x + rect.width).div_ceil(2);
    let bottom = (rect.y + rect.height).div_ceil(2);
    Rect { x, y, width: right - x, height: bottom - y }
}

impl Level {
    fn average(&mut self, below: &Self, changed: Rect) {
        for y in changed.y..changed.y + changed.height {
            for x in changed.x..changed.x + changed.width {
                let mut sum = [0.0_f32; 3];
                let mut cells = 0.0;
                for row in 2 * y..(2 * y + 2).min(below.height) {
                    for column in 2 * x..(2 * x + 2).min(below.width) {
                        let cell = below.pixels[row * below.width + column];
                        sum[0] += DECODED[usize::from(cell.r())];
                        sum[1] += DECODED[usize::from(cell.g())];
                        sum[2] += DECODED[usize::from(cell.b())];
                        cells += 1.0;
                    }
                }
                let [red, green, blue] = sum.map(|sum| encoded(sum / cells));
                self.pixels[y * self.width + x] = Color32::from_rgb(red, green, blue);
            }
        }
    }
}

/// Linear light of the 8-bit values of sRGB (IEC 61966-2-1).
static DECODED: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|value| {
        let value = value as u8;
        Srgb::new(value, value, value).into_linear::<f32>().red
    })
});

/// The 8-bit value nearest to each step of linear light.
static ENCODED: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let step = |step| step as f32 / (STEPS - 1) as f32;
    let nearest = |linear| Srgb::<u8>::from_linear(LinSrgb::new(linear, linear, linear)).red;
    (0..STEPS).map(|at| nearest(step(at))).collect()
});

fn encoded(linear: f32) -> u8 {
    let step = (linear * (STEPS - 1) as f32).round() as usize;
    ENCODED[step.min(STEPS - 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(value: u8) -> [u8; 4] {
        [value, value, value, 255]
    }

    /// A level of greys: all three channels are one value.
    fn whole(levels: &Levels, level: usize) -> Vec<u8> {
        let value = |pixel: &Color32| {
            let [red, green, blue, _] = pixel.to_array();
            assert!(red == green && green == blue, "{pixel:?} of greys");
            green
        };
        levels.cut(level, levels.bounds(level)).pixels.iter().map(value).collect()
    }

    #[test]
    fn an_even_color_is_the_same_at_every_level() {
        for value in 0..=255 {
            let mut levels = Levels::new(300, 2, Color32::BLACK);
            levels.write(levels.bounds(0), &[grey(value); 600]);
            for level in 0..levels.count() {
                assert!(whole(&levels, level).iter().all(|&is| is == value), "{value} {level}");
            }
        }
    }

    #[test]
    fn black_beside_white_is_half_the_light_from_afar() {
        let mut levels = Levels::new(200, 200, Color32::BLACK);
        let cells: Vec<[u8; 4]> = (0..40_000).map(|at| grey(255 * (at % 2) as u8)).collect();
        levels.write(levels.bounds(0), &cells);
        // Half of the light is 188 in sRGB, not 128.
        assert!(whole(&levels, 1).iter().all(|&is| is == 188), "{:?}", &whole(&levels, 1)[..4]);
    }

    #[test]
    fn writing_in_pieces_is_writing_at_once() {
        // Odd sizes, and pieces that cut the squares of two by two.
        let (width, height) = (333, 257);
        let value = |x: usize, y: usize| ((x * 31 + y * 17 + x * y) % 256) as u8;
        let cells = |rect: Rect| -> Vec<[u8; 4]> {
            (rect.y..rect.y + rect.height)
                .flat_map(|y| (rect.x..rect.x + rect.width).map(move |x| grey(value(x, y))))
                .collect()
        };
        let mut at_once = Levels::new(width, height, Color32::BLACK);
        at_once.write(at_once.bounds(0), &cells(at_once.bounds(0)));
        let mut pieces = Levels::new(width, height, Color32::WHITE);
        for y in (0..height).step_by(41) {
            for x in (0..width).step_by(37) {
                // Over the edge: what lies outside is left out.
                let rect = Rect { x, y, width: 37, height: 41 };
                pieces.write(rect, &cells(rect));
            }
        }
        for level in 0..at_once.count() {
            assert_eq!(whole(&at_once, level), whole(&pieces, level), "level {level}");
        }
    }

    #[test]
    fn levels_end_where_they_are_small() {
        let sizes = |width, height| {
            let levels = Levels::new(width, height, Color32::BLACK);
            (0..levels.count()).map(|level| levels.bounds(level).width).collect::<Vec<_>>()
        };
        assert_eq!(sizes(1920, 1080), [1920, 960, 480, 240, 120]);
        assert_eq!(sizes(100, 30), [100]);
    }
}
