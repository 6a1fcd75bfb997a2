//! The frame of an upright sample: which place of the picture each of its texels shows.

use graphics::field::Field;
use rayon::prelude::*;

/// Axes and size of an upright sample.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Frame {
    /// Place of the texel (0, 0) in the picture, in pixels from the first pixel's middle.
    origin: [f64; 2],
    /// Unit vector across the strokes: x of the sample.
    across: [f64; 2],
    /// Unit vector along the strokes: y of the sample.
    along: [f64; 2],
    /// Texels per pixel, across and along.
    scale: [f64; 2],
    /// Width and height in texels.
    pub(super) size: [usize; 2],
}

/// A pixel that contributes to a texel, and its weight.
pub(super) type Tap = (usize, f32);

impl Frame {
    /// The frame that holds all true pixels of `mask`, which has at least one.
    ///
    /// A frame along y of scale 1 shows the pixels as they are.
    pub(super) fn around(mask: &Field<bool>, along: [f64; 2], scale: [f64; 2]) -> Self {
        let across = [along[1], -along[0]];
        let mut least = [f64::INFINITY; 2];
        let mut most = [f64::NEG_INFINITY; 2];
        for (pixel, _) in mask.values().iter().enumerate().filter(|(_, inside)| **inside) {
            let place = [(pixel % mask.width()) as f64, (pixel / mask.width()) as f64];
            for (axis, direction) in [across, along].into_iter().enumerate() {
                let length = dot(place, direction);
                least[axis] = least[axis].min(length);
                most[axis] = most[axis].max(length);
            }
        }
        let size = [0, 1].map(|axis| {
            let texels = (most[axis] - least[axis]) * scale[axis];
            // Rounding must not add a row.
            (texels - 1e-9).ceil().max(0.0) as usize + 1
        });
        let origin = [0, 1].map(|i| least[0] * across[i] + least[1] * along[i]);
        Self { origin, across, along, scale, size }
    }

    /// The field of `gather` for each texel that lies in the mask by at least half; `None`
    /// elsewhere. Weights are above 0 and sum to 1 over pixels inside of the mask, so that nothing
    /// from outside bleeds in.
    pub(super) fn resampled<T: Send + Sync>(
        &self,
        mask: &Field<bool>,
        gather: impl Fn(&[Tap]) -> T + Sync,
    ) -> Field<Option<T>> {
        let [width, height] = self.size;
        let texels = (0..width * height).into_par_iter().with_min_len(256).map_init(
            Vec::new,
            |taps, texel| {
                let place = [(texel % width) as f64, (texel / width) as f64];
                self.taps(mask, place, taps).then(|| gather(taps))
            },
        );
        Field::from_values(width, height, texels.collect())
    }

    /// Fills `taps` for the texel at `place`; false if it lies outside of the mask.
    ///
    /// A texel is a tent over the sample's axes: one texel to each side, or one pixel where pixels
    /// are larger.
    fn taps(&self, mask: &Field<bool>, place: [f64; 2], taps: &mut Vec<Tap>) -> bool {
        taps.clear();
        let lengths = [0, 1].map(|axis| place[axis] / self.scale[axis]);
        let middle = [0, 1]
            .map(|i| self.origin[i] + lengths[0] * self.across[i] + lengths[1] * self.along[i]);
        // Half widths of the tent in pixels along its axes.
        let half = self.scale.map(|scale| (1.0 / scale).max(1.0));
        let reach = [0, 1].map(|i| half[0] * self.across[i].abs() + half[1] * self.along[i].abs());
        let range =
            |i: usize| (middle[i] - reach[i]).ceil() as i64..=(middle[i] + reach[i]).floor() as i64;
        let mut inside = 0.0;
        let mut all = 0.0;
        for y in range(1) {
            for x in range(0) {
                let off = [x as f64 - middle[0], y as f64 - middle[1]];
                let tent = |direction, half: f64| (1.0 - dot(off, direction).abs() / half).max(0.0);
                let weight = tent(self.across, half[0]) * tent(self.along, half[1]);
                // Below that, pixels beyond the tent would count by rounding alone.
                if weight < 1e-9 {
                    continue;
                }
                all += weight;
                let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) else { continue };
                if x < mask.width() && y < mask.height() && mask[(x, y)] {
                    inside += weight;
                    taps.push((y * mask.width() + x, weight as f32));
                }
            }
        }
        taps.iter_mut().for_each(|(_, weight)| *weight /= inside as f32);
        inside > 0.0 && inside >= 0.5 * all
    }
}

fn dot(one: [f64; 2], other: [f64; 2]) -> f64 {
    one[0] * other[0] + one[1] * other[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_along_y_of_scale_1_shows_the_pixels_as_they_are() {
        let mut mask = Field::filled(12, 9, true);
        (0..12).for_each(|x| mask[(x, 0)] = false);
        mask[(5, 4)] = false;
        let frame = Frame::around(&mask, [0.0, 1.0], [1.0; 2]);
        assert_eq!(frame.size, [12, 8]);
        let found = frame.resampled(&mask, |taps| taps.to_vec());
        for y in 0..8 {
            for x in 0..12 {
                let wanted = mask[(x, y + 1)].then(|| vec![((y + 1) * 12 + x, 1.0)]);
                assert_eq!(found[(x, y)], wanted, "{x} {y}");
            }
        }
    }

    #[test]
    fn a_turned_frame_runs_along_the_strokes() {
        // Values grow along 30 degrees: along y of the frame.
        let mask = Field::filled(60, 50, true);
        let (sin, cos) = 30f64.to_radians().sin_cos();
        let frame = Frame::around(&mask, [cos, sin], [1.0, 2.0]);
        let value = |pixel: usize| (pixel % 60) as f64 * cos + (pixel / 60) as f64 * sin;
        let found = frame.resampled(&mask, |taps: &[Tap]| -> f64 {
            taps.iter().map(|&(pixel, weight)| f64::from(weight) * value(pixel)).sum()
        });
        let x = frame.size[0] / 2;
        let y = frame.size[1] / 2;
        let at = |x: usize, y: usize| found[(x, y)].unwrap();
        assert!((at(x, y + 8) - at(x, y) - 4.0).abs() < 0.15, "two texels a pixel along y");
        assert!((at(x + 5, y) - at(x, y)).abs() < 0.15, "and even across");
    }

    #[test]
    fn a_smaller_sample_takes_means() {
        let mask = Field::filled(40, 40, true);
        let frame = Frame::around(&mask, [0.0, 1.0], [0.25; 2]);
        let check = |pixel: usize| ((pixel % 40 + pixel / 40) % 2) as f32;
        let found = frame.resampled(&mask, |taps| {
            taps.iter().map(|&(p, weight)| weight * check(p)).sum::<f32>()
        });
        let middle = found[(5, 5)].unwrap();
        assert!((middle - 0.5).abs() < 0.05, "{middle}");
    }
}
