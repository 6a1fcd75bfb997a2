//! Drift of the white, and the noise of a detector.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// A detector with noise, and a white that changes along the scan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// Standard deviation of the shot noise at a reflectance of 1.
    pub shot_noise: f64,
    /// Standard deviation of the noise of reading.
    pub read_noise: f64,
    /// Relative change of the values from the first to the last line.
    pub drift: f64,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Sensor {
    /// Factor on the values of a line: 1 in the first of `lines`, 1 + drift in the last.
    #[must_use]
    pub fn gain(&self, line: usize, lines: usize) -> f64 {
        1.0 + self.drift * line as f64 / (lines.max(2) - 1) as f64
    }

    /// Variance of the noise of a value.
    #[must_use]
    pub fn variance(&self, value: f64) -> f64 {
        self.read_noise.powi(2) + self.shot_noise.powi(2) * value.max(0.0)
    }

    /// Values of the line `line` of `lines` as the detector tells them.
    #[must_use]
    pub fn told(&self, values: &[f64], line: usize, lines: usize) -> Vec<f32> {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(line as u64);
        let gain = self.gain(line, lines);
        let told = values.iter().map(|value| {
            let normal: f64 = StandardNormal.sample(&mut random);
            let value = gain * value;
            (value + self.variance(value).sqrt() * normal) as f32
        });
        told.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SENSOR: Sensor = Sensor { shot_noise: 0.02, read_noise: 0.01, drift: 0.1, seed: 3 };

    #[test]
    fn the_noise_has_the_variance_that_was_asked_for() {
        for (value, expected) in [(0.0, 0.0001_f64), (0.25, 0.0002), (1.0, 0.0005)] {
            let told = SENSOR.told(&[value; 40_000], 0, 9);
            let mean = told.iter().map(|v| f64::from(*v)).sum::<f64>() / told.len() as f64;
            let squares = told.iter().map(|v| (f64::from(*v) - value).powi(2));
            let variance = squares.sum::<f64>() / told.len() as f64;
            assert!((mean - value).abs() < 4.0 * (expected / 40_000.0).sqrt(), "{mean}");
            assert!((variance / expected - 1.0).abs() < 0.03, "{variance}, not {expected}");
        }
    }

    #[test]
    fn the_white_drifts_evenly_along_the_scan() {
        let quiet = Sensor { shot_noise: 0.0, read_noise: 0.0, ..SENSOR };
        for (line, expected) in [(0, 0.5), (50, 0.525), (100, 0.55)] {
            let told = quiet.told(&[0.5], line, 101);
            assert!((f64::from(told[0]) - expected).abs() < 1e-6, "line {line}: {told:?}");
        }
        assert_eq!(quiet.gain(0, 1), 1.0, "a single line");
    }

    #[test]
    fn lines_have_noise_of_their_own_and_the_same_again() {
        let line = |line| SENSOR.told(&[0.5; 8], line, 9);
        assert_eq!(line(4), line(4));
        let other = Sensor { seed: 4, drift: 0.0, ..SENSOR };
        let own = Sensor { drift: 0.0, ..SENSOR };
        assert_ne!(own.told(&[0.5; 8], 4, 9), own.told(&[0.5; 8], 5, 9));
        assert_ne!(own.told(&[0.5; 8], 4, 9), other.told(&[0.5; 8], 4, 9));
    }
}
