//! Gaussian blur of lines, which keeps the mean.

use rayon::prelude::*;

/// Half the width of the blur, in standard deviations.
const REACH: f64 = 3.5;

/// A Gaussian blur. Beyond the edges the picture is mirrored, so that its mean stays.
#[derive(Debug, Clone, PartialEq)]
pub struct Blur {
    /// Weights from the middle on, whose sum over both sides is 1.
    weights: Vec<f64>,
}

impl Blur {
    /// A blur with the standard deviation `pixels`; 0 leaves everything as it is.
    #[must_use]
    pub fn new(pixels: f64) -> Self {
        if !(pixels > 0.0 && pixels.is_finite()) {
            return Self { weights: vec![1.0] };
        }
        let reach = (REACH * pixels).ceil() as usize;
        let weight = |at: usize| (-0.5 * (at as f64 / pixels).powi(2)).exp();
        let mut weights: Vec<f64> = (0..=reach).map(weight).collect();
        let sum = 2.0 * weights.iter().sum::<f64>() - weights[0];
        weights.iter_mut().for_each(|weight| *weight /= sum);
        Self { weights }
    }

    /// Distance in pixels up to which a neighbour counts.
    #[must_use]
    pub fn reach(&self) -> usize {
        self.weights.len() - 1
    }

    /// Lines that the blurred lines `rows` of a picture of `lines` lines depend on, in rising order.
    #[must_use]
    pub fn needed(&self, rows: &std::ops::Range<usize>, lines: usize) -> Vec<usize> {
        let reach = self.reach() as i64;
        let first = rows.start as i64 - reach;
        let end = rows.end as i64 + reach;
        let mut needed: Vec<usize> = (first..end).map(|line| mirrored(line, lines)).collect();
        needed.sort_unstable();
        needed.dedup();
        needed
    }

    /// The blurred line `line` of a picture of `lines` lines and `samples` columns. `of(line)` gives the
    /// numbers of a line, those of one pixel after another.
    pub fn line<'l>(
        &self,
        line: usize,
        (lines, samples): (usize, usize),
        of: impl Fn(usize) -> &'l [f64],
    ) -> Vec<f64> {
        let whole = of(line);
        let numbers = whole.len() / samples.max(1);
        let mut down: Vec<f64> = whole.iter().map(|value| self.weights[0] * value).collect();
        for (distance, weight) in self.weights.iter().enumerate().skip(1) {
            let at = |offset: i64| of(mirrored(line as i64 + offset, lines));
            let above = at(-(distance as i64));
            let below = at(distance as i64);
            for ((sum, a), b) in down.iter_mut().zip(above).zip(below) {
                *sum += weight * (a + b);
            }
        }
        let mut both = vec![0.0; down.len()];
        both.par_chunks_mut(numbers.max(1)).enumerate().for_each(|(sample, pixel)| {
            let at = |offset: i64| {
                let place = mirrored(sample as i64 + offset, samples) * numbers;
                &down[place..place + numbers]
            };
            pixel.iter_mut().zip(at(0)).for_each(|(sum, v)| *sum = self.weights[0] * v);
            for (distance, weight) in self.weights.iter().enumerate().skip(1) {
                let left = at(-(distance as i64));
                let right = at(distance as i64);
                for ((sum, a), b) in pixel.iter_mut().zip(left).zip(right) {
                    *sum += weight * (a + b);
                }
            }
        });
        both
    }
}

/// Place within 0 to `count` of a place that may lie outside: the edge is a mirror between pixels.
fn mirrored(at: i64, count: usize) -> usize {
    let count = count.max(1) as i64;
    let inside = at.rem_euclid(2 * count);
    (if inside < count { inside } else { 2 * count - 1 - inside }) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blurred(blur: &Blur, picture: &[Vec<f64>], samples: usize) -> Vec<Vec<f64>> {
        let size = (picture.len(), samples);
        (0..picture.len()).map(|line| blur.line(line, size, |line| &picture[line])).collect()
    }

    #[test]
    fn the_mean_of_each_number_stays_also_in_pictures_smaller_than_the_blur() {
        let blur = Blur::new(1.5);
        for (lines, samples) in [(9, 13), (2, 3), (1, 1)] {
            let value = |line: usize, at: usize| ((line * 31 + at * 17) % 23) as f64;
            let picture: Vec<Vec<f64>> = (0..lines)
                .map(|line| (0..samples * 2).map(|at| value(line, at)).collect())
                .collect();
            let found = blurred(&blur, &picture, samples);
            for number in 0..2 {
                let sum = |all: &[Vec<f64>]| -> f64 {
                    all.iter().flat_map(|line| line.iter().skip(number).step_by(2)).sum()
                };
                let before = sum(&picture);
                let after = sum(&found);
                assert!((before - after).abs() < 1e-9 * before.max(1.0), "{before} {after}");
            }
        }
    }

    #[test]
    fn a_point_becomes_a_gaussian_of_the_width_that_was_asked_for() {
        let mut picture = vec![vec![0.0; 41]; 41];
        picture[20][20] = 1.0;
        let found = blurred(&Blur::new(1.5), &picture, 41);
        let variance = |weight: &dyn Fn(usize, usize) -> f64| -> f64 {
            let places = (0..41).flat_map(|y| (0..41).map(move |x| (y, x)));
            places.map(|(y, x)| weight(y, x) * found[y][x]).sum()
        };
        let across = variance(&|_, x| (x as f64 - 20.0).powi(2));
        let down = variance(&|y, _| (y as f64 - 20.0).powi(2));
        assert!((across - 2.25).abs() < 0.03 && (down - 2.25).abs() < 0.03, "{across} {down}");
        assert_eq!(blurred(&Blur::new(0.0), &picture, 41), picture, "no blur");
    }

    #[test]
    fn the_lines_that_are_needed_lie_inside() {
        let blur = Blur::new(1.0);
        assert_eq!(blur.reach(), 4);
        assert_eq!(blur.needed(&(0..2), 100), [0, 1, 2, 3, 4, 5]);
        assert_eq!(blur.needed(&(50..51), 100), [46, 47, 48, 49, 50, 51, 52, 53, 54]);
        assert_eq!(blur.needed(&(0..2), 3), [0, 1, 2]);
    }
}
