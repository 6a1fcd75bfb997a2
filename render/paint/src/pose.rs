//! Position and attitude of a brush: a pen's sample in mm, and a pose in cells. You can also round
//! pen samples, for example to record them.

/// Position and attitude of a brush at one moment, as a pen reports it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Seconds since the stroke began. Never less than in the sample before.
    pub seconds: f64,
    /// Distance in mm from the left edge of the canvas to the middle of
    /// what the brush touches.
    pub x_mm: f64,
    /// Distance in mm from the upper edge of the canvas to the middle of what the brush touches.
    pub y_mm: f64,
    /// Pressure from 0 (just above the canvas) to 1 (down as far as the head bends).
    pub pressure: f64,
    /// Tilt of the handle to the right, -90 to 90 degrees from upright.
    pub tilt_x_deg: f64,
    /// Tilt of the handle towards the lower edge, -90 to 90 degrees from upright.
    pub tilt_y_deg: f64,
    /// Rotation about the handle in degrees, clockwise seen from above. At 0 the broad
    /// side of a flat head runs along x.
    pub twist_deg: f64,
}

impl Sample {
    /// A sample of an upright brush.
    #[must_use]
    pub const fn upright(seconds: f64, x_mm: f64, y_mm: f64, pressure: f64) -> Self {
        let tilt_x_deg = 0.0;
        let tilt_y_deg = 0.0;
        let twist_deg = 0.0;
        Self { seconds, x_mm, y_mm, pressure, tilt_x_deg, tilt_y_deg, twist_deg }
    }
}

/// Position and attitude of a brush at one sub-step. Positions are in cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Distance in cells from the left edge of the canvas to the middle of
    /// what the brush touches.
    pub x: f64,
    /// Distance in cells from the upper edge of the canvas to the middle of what the brush touches.
    pub y: f64,
    /// Pressure from 0 (just above the canvas) to 1 (as far down as the head bends).
    pub pressure: f64,
    /// Tilt of the handle to the right, in degrees from upright.
    pub tilt_x_deg: f64,
    /// Tilt of the handle towards the lower edge, in degrees from upright.
    pub tilt_y_deg: f64,
    /// Rotation about the handle in degrees, clockwise seen from above.
    pub twist_deg: f64,
    /// Speed of the hand in mm/s. 0 if it rests or is unknown.
    pub speed_mm_s: f64,
}

impl Pose {
    /// Whether all numbers are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let numbers = [
            self.x,
            self.y,
            self.pressure,
            self.tilt_x_deg,
            self.tilt_y_deg,
            self.twist_deg,
            self.speed_mm_s,
        ];
        numbers.iter().all(|number| number.is_finite())
    }
}

impl Sample {
    /// Converts the position to cells that are `cell_mm` wide. One sample alone has no speed.
    #[must_use]
    pub fn pose(&self, cell_mm: f64) -> Pose {
        Pose {
            x: self.x_mm / cell_mm,
            y: self.y_mm / cell_mm,
            pressure: self.pressure,
            tilt_x_deg: self.tilt_x_deg,
            tilt_y_deg: self.tilt_y_deg,
            twist_deg: self.twist_deg,
            speed_mm_s: 0.0,
        }
    }
}

/// Number of decimals to which we round the numbers of a sample.
///
/// If you round a sample to fewer decimals and then to more, the second step changes nothing.
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
    /// Decimals of a recording: four of each number, so for example a tenth of a millisecond or a
    /// tenth of a micrometre.
    pub const RECORDING: Self = Self { seconds: 4, place: 4, pressure: 4, angle: 4 };

    /// Decimals as fine as a hand can hold a pen still: 0.1 ms, 0.001 mm, 0.0001 of full
    /// pressure and 0.01 degrees.
    pub const PEN: Self = Self { seconds: 4, place: 3, pressure: 4, angle: 2 };

    /// The sample with each number rounded, halves away from 0. This never gives -0, which a file
    /// cannot tell from 0.
    #[must_use]
    pub fn round(&self, sample: &Sample) -> Sample {
        Sample {
            seconds: rounded(sample.seconds, self.seconds),
            x_mm: rounded(sample.x_mm, self.place),
            y_mm: rounded(sample.y_mm, self.place),
            pressure: rounded(sample.pressure, self.pressure),
            tilt_x_deg: rounded(sample.tilt_x_deg, self.angle),
            tilt_y_deg: rounded(sample.tilt_y_deg, self.angle),
            twist_deg: rounded(sample.twist_deg, self.angle),
        }
    }
}

fn rounded(number: f64, decimals: u8) -> f64 {
    let scale = 10_f64.powi(i32::from(decimals));
    (number * scale).round() / scale + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

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
