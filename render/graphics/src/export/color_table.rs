//! A palette of 255 colours for a whole animation.
//!
//! All frames share one table, so that still pixels keep their index and do not flicker.
//! Boxes of colours are cut at their median (Heckbert 1982), the box with the greatest
//! error first; then each colour moves to the mean of the pixels nearest to it (Lloyd
//! 1982).

use rayon::prelude::*;

use super::frame::Frame;

/// Most colours of a table. One more index of the GIF is left for pixels that do not
/// change.
pub(super) const COLORS: usize = 255;
/// Bits per channel by which colours are distinguished: 32,768 bins.
const BITS: usize = 5;
const SIDE: usize = 1 << BITS;
const ROUNDS: usize = 4;

/// Up to 255 colours, and a lookup of the nearest one for every colour.
#[derive(Debug, Clone)]
pub struct ColorTable {
    colors: Vec<[u8; 3]>,
    /// Index of the nearest colour, for each bin of the upper bits of red, green and blue.
    nearest: Vec<u8>,
}

/// Histogram of the frames' colours, of fixed size.
#[derive(Debug, Clone)]
pub(super) struct Census {
    /// Sums of red, green, blue and count for each bin.
    cells: Vec<[u64; 4]>,
}

fn cell([r, g, b]: [u8; 3]) -> usize {
    let upper = |value: u8| usize::from(value) >> (8 - BITS);
    (upper(r) * SIDE + upper(g)) * SIDE + upper(b)
}

impl Census {
    pub(super) fn new() -> Self {
        Self { cells: vec![[0; 4]; SIDE.pow(3)] }
    }

    pub(super) fn count(&mut self, frame: &Frame) {
        for &pixel in frame.values() {
            let sums = &mut self.cells[cell(pixel)];
            for (sum, value) in sums.iter_mut().zip(pixel) {
                *sum += u64::from(value);
            }
            sums[3] += 1;
        }
    }
}

impl ColorTable {
    /// Makes the table for `frames`, which are read once, one at a time.
    ///
    /// # Errors
    /// The first error that `frames` yields.
    pub fn of<E>(frames: impl IntoIterator<Item = Result<Frame, E>>) -> Result<Self, E> {
        let mut census = Census::new();
        for frame in frames {
            census.count(&frame?);
        }
        Ok(Self::from_census(&census))
    }

    fn from_census(census: &Census) -> Self {
        let mut found: Vec<([f32; 3], f32)> = census
            .cells
            .iter()
            .filter(|sums| sums[3] > 0)
            .map(|sums| {
                let count = sums[3] as f32;
                ([0, 1, 2].map(|i| sums[i] as f32 / count), count)
            })
            .collect();
        let mut colors = boxes(&mut found);
        for _ in 0..ROUNDS {
            let nearest: Vec<usize> =
                found.par_iter().map(|(color, _)| nearest(&colors, *color)).collect();
            let mut sums = vec![[0.0f64; 4]; colors.len()];
            for ((color, count), index) in found.iter().zip(nearest) {
                let count = f64::from(*count);
                for (sum, value) in sums[index].iter_mut().zip(color) {
                    *sum += f64::from(*value) * count;
                }
                sums[index][3] += count;
            }
            for (color, sums) in colors.iter_mut().zip(sums) {
                if sums[3] > 0.0 {
                    *color = [0, 1, 2].map(|i| (sums[i] / sums[3]) as f32);
                }
            }
        }
        let bytes: Vec<[u8; 3]> =
            colors.iter().map(|color| color.map(|value| value.round() as u8)).collect();
        let middle = |i: usize| ((i % SIDE) << (8 - BITS)) as f32 + 3.5;
        let nearest = (0..SIDE.pow(3))
            .into_par_iter()
            .map(|i| nearest(&colors, [middle(i / SIDE / SIDE), middle(i / SIDE), middle(i)]) as u8)
            .collect();
        Self { colors: bytes, nearest }
    }

    /// The colours of the table, encoded sRGB.
    #[must_use]
    pub fn colors(&self) -> &[[u8; 3]] {
        &self.colors
    }

    /// Index of the table's colour nearest to `pixel`.
    #[must_use]
    pub fn index(&self, pixel: [u8; 3]) -> u8 {
        self.nearest[cell(pixel)]
    }
}

/// Squared distance with channels weighted by about their share of lightness.
fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    [2.0, 4.0, 1.0].iter().zip(a).zip(b).map(|((weight, a), b)| weight * (a - b) * (a - b)).sum()
}

fn nearest(colors: &[[f32; 3]], wanted: [f32; 3]) -> usize {
    let distances = colors.iter().map(|&color| distance(color, wanted));
    distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index)
}

/// Mean colours of up to [`COLORS`] boxes.
fn boxes(found: &mut [([f32; 3], f32)]) -> Vec<[f32; 3]> {
    let mut open: Vec<&mut [([f32; 3], f32)]> = vec![found];
    while open.len() < COLORS {
        let widest = open.iter().enumerate().map(|(i, colors)| (i, spread(colors)));
        let Some((index, (channel, spread))) = widest.max_by(|a, b| a.1.1.total_cmp(&b.1.1)) else {
            break;
        };
        if spread <= 0.0 {
            break;
        }
        let colors = open.swap_remove(index);
        colors.sort_by(|a, b| a.0[channel].total_cmp(&b.0[channel]));
        let half = colors.iter().map(|color| color.1).sum::<f32>() / 2.0;
        let mut before = 0.0;
        let cut = colors.iter().position(|color| {
            before += color.1;
            before >= half
        });
        let cut = cut.unwrap_or(0).clamp(1, colors.len() - 1);
        let (lower, upper) = colors.split_at_mut(cut);
        open.extend([lower, upper]);
    }
    let means = open.iter().filter(|colors| !colors.is_empty()).map(|colors| mean(colors));
    means.collect()
}

fn mean(colors: &[([f32; 3], f32)]) -> [f32; 3] {
    let count: f32 = colors.iter().map(|color| color.1).sum();
    [0, 1, 2].map(|i| colors.iter().map(|color| color.0[i] * color.1).sum::<f32>() / count)
}

/// Channel with the greatest squared error within a box, and that error; 0 for a box that
/// cannot be cut.
fn spread(colors: &[([f32; 3], f32)]) -> (usize, f32) {
    if colors.len() < 2 {
        return (0, 0.0);
    }
    let mean = mean(colors);
    let errors = [0, 1, 2].map(|i| {
        let squares = colors.iter().map(|(color, count)| count * (color[i] - mean[i]).powi(2));
        squares.sum::<f32>() * [2.0, 4.0, 1.0][i]
    });
    let widest = (0..3).max_by(|&a, &b| errors[a].total_cmp(&errors[b])).unwrap_or(0);
    (widest, errors[widest])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::Field;

    fn table(pixels: Vec<[u8; 3]>) -> ColorTable {
        let frame = Field::from_values(pixels.len(), 1, pixels);
        ColorTable::of::<()>([Ok(frame)]).unwrap()
    }

    #[test]
    fn few_colors_are_kept_as_they_are() {
        let few = vec![[0, 0, 0], [255, 255, 255], [200, 10, 30], [200, 10, 30], [7, 90, 250]];
        let table = table(few.clone());
        assert_eq!(table.colors().len(), 4);
        for pixel in few {
            assert_eq!(table.colors()[usize::from(table.index(pixel))], pixel);
        }
    }

    #[test]
    fn many_colors_are_near_their_own() {
        let many: Vec<[u8; 3]> = (0..10_000u32)
            .map(|i| [(i % 100) as u8 + 100, (i / 100) as u8 + 60, (i % 37) as u8 + 20])
            .collect();
        let table = table(many.clone());
        assert_eq!(table.colors().len(), COLORS);
        let rms = (many
            .iter()
            .map(|pixel: &[u8; 3]| {
                let found = table.colors()[usize::from(table.index(*pixel))];
                (0..3).map(|i| f64::from(found[i].abs_diff(pixel[i])).powi(2)).sum::<f64>()
            })
            .sum::<f64>()
            / 30_000.0)
            .sqrt();
        // Measured: 3.9 of 255.
        assert!(rms < 4.5, "{rms}");
    }
}
