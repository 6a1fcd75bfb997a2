//! Encoded values as linear ones within the reach of paint.

use spectra::color::Rgb;

/// Steps of the table that decodes encoded values.
const STEPS: usize = 4096;

/// The linear values that are painted for encoded ones: from the darkest tone that paint reaches to
/// the lightest, so that differences in shadows and lights survive.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tones {
    black: f32,
    white: f32,
    /// Linear values of encoded ones in even steps.
    linear: Vec<f32>,
}

impl Tones {
    /// Tones from the linear values `black` to `white`.
    pub(super) fn between(black: f32, white: f32) -> Self {
        let linear = |step: usize| linear(step.min(STEPS) as f32 / STEPS as f32);
        Self { black, white, linear: (0..=STEPS + 1).map(linear).collect() }
    }

    /// The linear value that is painted for an encoded one; what is no number counts as 0.
    pub(super) fn target(&self, encoded: f32) -> f32 {
        let place = within_one(encoded) * STEPS as f32;
        let step = place as usize;
        let rest = place.fract();
        let linear = self.linear[step] + rest * (self.linear[step + 1] - self.linear[step]);
        self.black + (self.white - self.black) * linear
    }
}

/// The nearest value from 0 to 1; what is no number counts as 0.
#[inline]
pub(super) fn within_one(value: f32) -> f32 {
    if value > 0.0 { value.min(1.0) } else { 0.0 }
}

/// Linear value of an encoded one.
pub(super) fn linear(encoded: f32) -> f32 {
    Rgb([f64::from(encoded); 3]).linear().0[0] as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tones_are_those_of_srgb_between_black_and_white() {
        let tones = Tones::between(0.03, 0.9);
        assert_eq!(tones.target(0.0), 0.03);
        assert_eq!(tones.target(-2.0), 0.03);
        assert_eq!(tones.target(f32::NAN), 0.03);
        assert!((tones.target(1.0) - 0.9).abs() < 1e-6 && (tones.target(7.0) - 0.9).abs() < 1e-6);
        // 0.5 encoded is 0.2140 linear (IEC 61966-2-1).
        assert!((tones.target(0.5) - (0.03 + 0.87 * 0.214_04)).abs() < 1e-5);
    }
}
