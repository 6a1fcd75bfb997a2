//! Hands that move evenly: samples of a pen along straight and turning paths.

use paint::Sample;

/// Pressure at which most strokes are painted.
pub const PRESSURE: f64 = 0.475;
/// Distance in mm from the left edge of a canvas to the start of a stroke.
pub const START_MM: f64 = 10.0;
/// Speed of most hands in mm/s.
const SPEED: f64 = 60.0;

/// Attitude of the hand.
#[derive(Debug, Clone, Copy)]
pub struct Hand {
    /// Pressure, 0 to 1.
    pub pressure: f64,
    /// Tilt of the handle to the right and towards the lower edge, in degrees.
    pub tilt_deg: (f64, f64),
    /// Rotation about the handle in degrees.
    pub twist_deg: f64,
}

impl Hand {
    /// An upright brush with its broad side across strokes along x.
    #[must_use]
    pub fn across(pressure: f64) -> Self {
        Self { pressure, tilt_deg: (0.0, 0.0), twist_deg: 90.0 }
    }

    /// Samples of a pen that moves evenly through `points` (in mm), one every mm.
    #[must_use]
    pub fn along(self, points: &[(f64, f64)]) -> Vec<Sample> {
        self.along_at(SPEED, points)
    }

    /// Samples like [`Hand::along`], of a hand that moves at `speed` mm/s.
    #[must_use]
    pub fn along_at(self, speed: f64, points: &[(f64, f64)]) -> Vec<Sample> {
        let mut samples = vec![self.at(0.0, points[0])];
        let mut seconds = 0.0;
        for pair in points.windows(2) {
            let [(x0, y0), (x1, y1)] = [pair[0], pair[1]];
            let length = (x1 - x0).hypot(y1 - y0);
            let steps = length.ceil().max(1.0) as usize;
            for step in 1..=steps {
                let share = step as f64 / steps as f64;
                let place = (x0 + share * (x1 - x0), y0 + share * (y1 - y0));
                samples.push(self.at(seconds + share * length / speed, place));
            }
            seconds += length / speed;
        }
        samples
    }

    fn at(self, seconds: f64, (x_mm, y_mm): (f64, f64)) -> Sample {
        let Self { pressure, tilt_deg: (tilt_x_deg, tilt_y_deg), twist_deg } = self;
        Sample { seconds, x_mm, y_mm, pressure, tilt_x_deg, tilt_y_deg, twist_deg }
    }
}

/// Turns the broad side of the brush across the path of `samples`.
#[must_use]
pub fn turning(mut samples: Vec<Sample>) -> Vec<Sample> {
    let places: Vec<(f64, f64)> = samples.iter().map(|s| (s.x_mm, s.y_mm)).collect();
    let last = places.len() - 1;
    let mut before = 0.0;
    for (index, sample) in samples.iter_mut().enumerate() {
        let (x0, y0) = places[index.saturating_sub(1)];
        let (x1, y1) = places[(index + 1).min(last)];
        let heading = (y1 - y0).atan2(x1 - x0).to_degrees() + 90.0;
        // The nearest equal angle, so that the handle never spins.
        before = heading + 360.0 * ((before - heading) / 360.0).round();
        sample.twist_deg = before;
    }
    samples
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::golden::assert_near;

    #[test]
    fn a_hand_moves_evenly_through_its_points() {
        let samples = Hand::across(0.4).along(&[(10.0, 5.0), (13.5, 5.0), (13.5, 15.0)]);
        assert_eq!(samples.len(), 1 + 4 + 10);
        for pair in samples.windows(2) {
            let length = (pair[1].x_mm - pair[0].x_mm).hypot(pair[1].y_mm - pair[0].y_mm);
            let speed = length / (pair[1].seconds - pair[0].seconds);
            assert_near("speed", &[speed], &[SPEED], 1e-9);
            assert!(length <= 1.0 + 1e-9, "a sample every mm: {length}");
        }
        let last = samples[samples.len() - 1];
        assert_eq!((last.x_mm, last.y_mm, last.pressure, last.twist_deg), (13.5, 15.0, 0.4, 90.0));
    }

    #[test]
    fn a_turning_hand_follows_two_circles_without_spinning_back() {
        let point = (0..=96).map(|step| {
            let (sin, cos) = (f64::from(step) / 48.0 * TAU).sin_cos();
            (20.0 + 8.0 * cos, 20.0 + 8.0 * sin)
        });
        let points: Vec<(f64, f64)> = point.collect();
        let samples = turning(Hand::across(0.4).along(&points));
        let turns: Vec<f64> =
            samples.windows(2).map(|pair| pair[1].twist_deg - pair[0].twist_deg).collect();
        assert!(turns.iter().all(|turn| (-1e-9..10.0).contains(turn)), "{turns:?}");
        assert_near("two turns", &[turns.iter().sum()], &[720.0], 10.0);
        // Down the right side of the circle the broad side lies along x.
        assert_near("at the start", &[samples[0].twist_deg.rem_euclid(180.0)], &[0.0], 5.0);
    }
}
