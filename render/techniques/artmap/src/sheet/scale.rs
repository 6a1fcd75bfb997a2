//! Scale of a sheet: whole numbers of pixels a texel, or of texels a pixel.

use graphics::field::Field;
use graphics::picture::Picture;

/// Largest side of a picture on the sheet in pixels.
pub(super) const LARGEST_PX: usize = 480;

/// Most pixels along a texel.
const MOST_UP: usize = 8;

/// Enlargement of single texels, or reduction of blocks of them. One of both is 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Scale {
    up: usize,
    down: usize,
}

impl Scale {
    /// Scale at which `largest` texels fit into [`LARGEST_PX`].
    pub(super) fn fitting(largest: usize) -> Self {
        Self {
            up: (LARGEST_PX / largest.max(1)).clamp(1, MOST_UP),
            down: largest.div_ceil(LARGEST_PX).max(1),
        }
    }

    fn pixels(self, texels: usize) -> usize {
        (texels * self.up).div_ceil(self.down)
    }

    /// The picture at this scale: means of the texels of `mask` under each pixel; `None` where
    /// there are none.
    pub(super) fn scaled(self, picture: &Picture, mask: &Field<bool>) -> Field<Option<[f32; 3]>> {
        let width = self.pixels(picture.width());
        let height = self.pixels(picture.height());
        let under = |pixel: usize, texels: usize| {
            let first = pixel * self.down / self.up;
            first..(first + self.down).min(texels)
        };
        let pixel = |at: usize| {
            let mut sum = [0.0; 3];
            let mut count = 0.0;
            for y in under(at / width, picture.height()) {
                for x in under(at % width, picture.width()).filter(|&x| mask[(x, y)]) {
                    (0..3).for_each(|channel| sum[channel] += picture[(x, y)][channel]);
                    count += 1.0;
                }
            }
            (count > 0.0).then(|| sum.map(|sum| sum / count))
        };
        Field::from_values(width, height, (0..width * height).map(pixel).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
