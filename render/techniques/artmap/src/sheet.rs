//! Sheets: one picture shows all samples of a set side by side. A texel takes whole pixels, or a
//! pixel whole texels.

use graphics::field::Field;
use graphics::picture::Picture;

use crate::relief::{raked, raking_tangent, slopes};
use crate::sample::{Sample, SampleSet};

/// Linear grey of the sheet. Both dark and light samples stand out on this.
const GROUND: [f32; 3] = [0.45; 3];

const MARGIN: usize = 24;

const GAP: usize = 16;

/// Beyond this width the next sample begins a new line. Seven samples fit into one.
const LINE: usize = 2 * MARGIN + 6 * GAP + 7 * 330;

type Shown = Vec<Field<Option<[f32; 3]>>>;

/// Shows all samples side by side, in their order, from dark to light.
///
/// Where height and size are known, you see below each sample the relief of its paint under a
/// raking light from the upper left. If the paint of the set is flatter, this light stands lower,
/// from 40 down to 2 degrees.
///
/// The picture is in linear sRGB, like the samples. All samples have one scale, a whole number of
/// pixels per texel or of texels per pixel. Texels beyond a passage show the grey of the sheet.
#[must_use]
pub fn sheet(set: &SampleSet) -> Picture {
    let largest = set.samples.iter().map(|sample| sample.size().0.max(sample.size().1)).max();
    let scale = Scale::fitting(largest.unwrap_or(LARGEST_PX));
    let reliefs: Vec<Option<Field<[f32; 2]>>> = set.samples.iter().map(relief).collect();
    let tangent = raking_tangent(reliefs.iter().flatten());
    let shown = set.samples.iter().zip(&reliefs).map(|(sample, relief)| {
        let color = scale.scaled(&sample.color, &sample.mask);
        let relief = relief.as_ref().map(|slopes| raked(slopes, tangent));
        let relief = relief.map(|relief| scale.scaled(&relief, &sample.mask));
        std::iter::once(color).chain(relief).collect()
    });
    let shown: Vec<Shown> = shown.collect();
    let lines = lines(&shown);
    let width = lines.iter().map(|line| line_width(line)).max().unwrap_or(0);
    let heights: Vec<Vec<usize>> = lines.iter().map(|line| strip_heights(line)).collect();
    let strips = heights.iter().flatten();
    let height = strips.map(|height| height + GAP).sum::<usize>().saturating_sub(GAP);
    let mut sheet = Field::filled(width + 2 * MARGIN, height + 2 * MARGIN, GROUND);
    let mut y = MARGIN;
    for (line, heights) in lines.iter().zip(heights) {
        for (strip, height) in heights.into_iter().enumerate() {
            let mut x = MARGIN;
            for pictures in *line {
                if let Some(picture) = pictures.get(strip) {
                    place(&mut sheet, picture, (x, y));
                }
                x += pictures[0].width() + GAP;
            }
            y += height + GAP;
        }
    }
    sheet
}

fn relief(sample: &Sample) -> Option<Field<[f32; 2]>> {
    let (height, mm) = sample.height_mm.as_ref().zip(sample.mm_per_texel)?;
    Some(slopes(height, &sample.mask, mm))
}

fn lines(shown: &[Shown]) -> Vec<&[Shown]> {
    let mut lines = Vec::new();
    let mut first = 0;
    for last in 1..=shown.len() {
        let full = last < shown.len() && line_width(&shown[first..=last]) + 2 * MARGIN > LINE;
        if full || last == shown.len() {
            lines.push(&shown[first..last]);
            first = last;
        }
    }
    lines
}

fn line_width(line: &[Shown]) -> usize {
    line.iter().map(|pictures| pictures[0].width() + GAP).sum::<usize>() - GAP
}

fn strip_heights(line: &[Shown]) -> Vec<usize> {
    let strips = line.iter().map(Vec::len).max().unwrap_or(0);
    (0..strips)
        .map(|strip: usize| {
            let pictures = line.iter().filter_map(|pictures| pictures.get(strip));
            pictures.map(Field::height).max().unwrap_or(0)
        })
        .collect()
}

fn place(sheet: &mut Picture, picture: &Field<Option<[f32; 3]>>, (left, top): (usize, usize)) {
    for y in 0..picture.height() {
        let row = sheet.row_mut(top + y, left, picture.width());
        for (pixel, color) in row.iter_mut().zip(picture.row(y, 0, picture.width())) {
            *pixel = color.unwrap_or(*pixel);
        }
    }
}

const LARGEST_PX: usize = 480;

const MOST_UP: usize = 8;

/// Enlarges single texels, or reduces blocks of them. One of both numbers is 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Scale {
    up: usize,
    down: usize,
}

impl Scale {
    /// Scale at which `largest` texels fit into [`LARGEST_PX`].
    fn fitting(largest: usize) -> Self {
        Self {
            up: (LARGEST_PX / largest.max(1)).clamp(1, MOST_UP),
            down: largest.div_ceil(LARGEST_PX).max(1),
        }
    }

    fn pixels(self, texels: usize) -> usize {
        (texels * self.up).div_ceil(self.down)
    }

    /// The picture at this scale. A pixel is the mean of the texels of `mask` under it, `None`
    /// where there are none.
    fn scaled(self, picture: &Picture, mask: &Field<bool>) -> Field<Option<[f32; 3]>> {
        let width = self.pixels(picture.width());
        let height = self.pixels(picture.height());
        let under = |pixel: usize, texels: usize| {
            let first = pixel * self.down / self.up;
            first..(first + self.down).min(texels)
        };
        Field::from_values(
            width,
            height,
            (0..width * height)
                .map(|at: usize| {
                    let mut sum = [0.0; 3];
                    let mut count = 0.0;
                    for y in under(at / width, picture.height()) {
                        for x in under(at % width, picture.width()).filter(|&x| mask[(x, y)]) {
                            (0..3).for_each(|channel| sum[channel] += picture[(x, y)][channel]);
                            count += 1.0;
                        }
                    }
                    (count > 0.0).then(|| sum.map(|sum| sum / count))
                })
                .collect(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(value: f32, (width, height): (usize, usize), relief: bool) -> Sample {
        let mut mask = Field::filled(width, height, true);
        mask[(0, 0)] = false;
        Sample {
            name: format!("{value}"),
            color: Field::filled(width, height, [value; 3]),
            paint: None,
            height_mm: relief.then(|| Field::filled(width, height, 0.2)),
            mask,
            spacing: 8.0,
            mm_per_texel: Some(0.25),
            guessed_relief: false,
        }
    }

    fn set(samples: Vec<Sample>) -> SampleSet {
        SampleSet { samples, paint: None, provenance: String::new() }
    }

    #[test]
    fn samples_lie_from_left_to_right_with_their_relief_below() {
        let sheet = sheet(&set(vec![sample(0.1, (240, 100), true), sample(0.8, (60, 200), false)]));
        assert_eq!(sheet.width(), 2 * MARGIN + 480 + GAP + 120);
        assert_eq!(sheet.height(), 2 * MARGIN + 400 + GAP + 200);
        assert_eq!(sheet[(MARGIN + 1, MARGIN + 1)], GROUND, "beyond the passage");
        assert_eq!(sheet[(MARGIN + 2, MARGIN + 1)], [0.1; 3]);
        assert_eq!(sheet[(MARGIN + 480 + GAP + 119, MARGIN + 399)], [0.8; 3]);
        let relief = sheet[(MARGIN + 300, MARGIN + 400 + GAP + 100)];
        assert!((relief[0] - 0.25).abs() < 1e-6, "level relief: {relief:?}");
        assert_eq!(sheet[(MARGIN + 480 + GAP + 60, MARGIN + 400 + GAP + 100)], GROUND, "none");
    }

    #[test]
    fn many_samples_fill_several_lines() {
        let samples = (0..8).map(|number| sample(number as f32 / 8.0, (300, 50), true)).collect();
        let sheet = sheet(&set(samples));
        assert_eq!(sheet.width(), 2 * MARGIN + 7 * 300 + 6 * GAP);
        assert_eq!(sheet.height(), 2 * MARGIN + 4 * 50 + 3 * GAP);
        let last = sheet[(MARGIN + 5, MARGIN + 2 * (50 + GAP) + 5)];
        assert_eq!(last, [7.0 / 8.0; 3], "the eighth begins the second line");
    }

    #[test]
    fn a_set_without_samples_is_an_empty_sheet() {
        let sheet = sheet(&set(Vec::new()));
        assert_eq!((sheet.width(), sheet.height()), (2 * MARGIN, 2 * MARGIN));
    }

    #[test]
    fn small_samples_are_enlarged_and_large_ones_reduced_to_means_of_the_passage() {
        assert_eq!(Scale::fitting(0), Scale { up: 8, down: 1 });
        assert_eq!(Scale::fitting(100), Scale { up: 4, down: 1 });
        assert_eq!(Scale::fitting(480), Scale { up: 1, down: 1 });
        assert_eq!(Scale::fitting(481), Scale { up: 1, down: 2 });
        let picture = Field::from_values(3, 2, (0..6).map(|i| [i as f32; 3]).collect());
        let mut mask = Field::filled(3, 2, true);
        mask[(0, 0)] = false;
        let large = Scale { up: 2, down: 1 }.scaled(&picture, &mask);
        assert_eq!((large.width(), large.height()), (6, 4));
        assert_eq!(
            (large[(1, 1)], large[(2, 1)], large[(5, 3)]),
            (None, Some([1.0; 3]), Some([5.0; 3]))
        );
        let small = Scale { up: 1, down: 2 }.scaled(&picture, &mask);
        let mean = (1.0 + 3.0 + 4.0) / 3.0;
        assert_eq!(small.values(), [Some([mean; 3]), Some([3.5; 3])]);
    }
}
