//! Rounding of pen samples.

use crate::pose::Sample;

/// Decimals to which the numbers of a sample are rounded.
///
/// A sample that was rounded to fewer decimals stays as it is when it is rounded to more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SampleDecimals {
    /// Decimals of `seconds`.
    pub seconds: u8,
    /// Decimals of `x_mm` and `y_mm`.
    pub place: u8,
    /// Decimals of `pressure`.
    pub pressure: u8,
    /// Decimals of tilt and twist in degrees.
    pub angle: u8,
}

impl SampleDecimals {
    /// Decimals of a recording: four of each number, so a tenth of a millisecond and a
    /// tenth of a micrometre.
    pub const RECORDING: Self = Self { seconds: 4, place: 4, pressure: 4, angle: 4 };

    /// Decimals as fine as a hand can hold a pen still: 0.1 ms, 0.001 mm, 0.0001 of full
    /// pressure and 0.01 degrees.
    pub const PEN: Self = Self { seconds: 4, place: 3, pressure: 4, angle: 2 };

    /// The sample with each number rounded, halves away from 0. No number is -0, which a
    /// file cannot tell from 0.
    #[must_use]
    pub fn round(&self, sample: &Sample) -> Sample {
        let round = |number: f64, decimals: u8| {
            let scale = 10_f64.powi(i32::from(decimals));
            (number * scale).round() / scale + 0.0
        };
        Sample {
            seconds: round(sample.seconds, self.seconds),
            x_mm: round(sample.x_mm, self.place),
            y_mm: round(sample.y_mm, self.place),
            pressure: round(sample.pressure, self.pressure),
            tilt_x_deg: round(sample.tilt_x_deg, self.angle),
            tilt_y_deg: round(sample.tilt_y_deg, self.angle),
            twist_deg: round(sample.twist_deg, self.angle),
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn rounding_to_more_decimals_changes_nothing() {
        let random = &mut ChaCha8Rng::seed_from_u64(1);
        for _ in 0..10_000 {
            let mut number = || random.random_range(-400.0..400.0);
            let sample = Sample {
                seconds: number(),
                x_mm: number(),
                y_mm: number(),
                pressure: number(),
                tilt_x_deg: number(),
                tilt_y_deg: number(),
                twist_deg: number(),
            };
            let rounded = SampleDecimals::PEN.round(&sample);
            assert_eq!(SampleDecimals::RECORDING.round(&rounded), rounded, "{sample:?}");
        }
    }
}
