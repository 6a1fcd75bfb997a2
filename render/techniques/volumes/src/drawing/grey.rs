//! The grey of a colour.

use std::sync::OnceLock;

use glam::Vec3;
use serde::{Deserialize, Serialize};
use spectra::color::Rgb;

/// How the grey of a colour is weighed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GreyWeights {
    /// The luminance Y of linear sRGB, encoded again: as light as the colour.
    #[default]
    Luminance,
    /// 0.299, 0.587 and 0.114 of the encoded values (ITU-R BT.601), as was usual in 2005.
    Rec601,
}

/// Share of linear red, green and blue in the luminance of sRGB (IEC 61966-2-1).
const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// Share of encoded red, green and blue in luma (ITU-R BT.601).
const LUMA: [f32; 3] = [0.299, 0.587, 0.114];

/// Steps of the tables.
const STEPS: usize = 1024;

/// The transfer function of sRGB and its inverse at equal steps over 0 to 1.
#[derive(Debug)]
pub(super) struct Transfer {
    linear: Vec<f32>,
    encoded: Vec<f32>,
}

impl Transfer {
    pub(super) fn get() -> &'static Self {
        static TABLES: OnceLock<Transfer> = OnceLock::new();
        TABLES.get_or_init(|| {
            let steps = (0..=STEPS + 1).map(|i| Rgb([(i as f64 / STEPS as f64).min(1.0); 3]));
            Self {
                linear: steps.clone().map(|value| value.linear().0[0] as f32).collect(),
                encoded: steps.map(|value| value.encoded().0[0] as f32).collect(),
            }
        })
    }

    /// The grey of an encoded sRGB colour in 0..1, encoded.
    #[inline(always)]
    pub(super) fn grey(&self, color: Vec3, weights: GreyWeights) -> f32 {
        match weights {
            GreyWeights::Luminance => {
                let [r, g, b] = color.to_array().map(|value| between(&self.linear, value));
                let y = LUMINANCE[0] * r + LUMINANCE[1] * g + LUMINANCE[2] * b;
                between(&self.encoded, y)
            }
            GreyWeights::Rec601 => color.dot(Vec3::from(LUMA)),
        }
    }
}

#[inline(always)]
fn between(table: &[f32], value: f32) -> f32 {
    let at = value.clamp(0.0, 1.0) * STEPS as f32;
    let below = at as usize;
    table[below] + (table[below + 1] - table[below]) * (at - below as f32)
}

/// The grey of an encoded sRGB colour, 0..1; values outside are clipped.
#[must_use]
pub fn grey_of(color: [f32; 3], weights: GreyWeights) -> f32 {
    Transfer::get().grey(Vec3::from(color).clamp(Vec3::ZERO, Vec3::ONE), weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grey_is_as_light_as_the_colour() {
        for i in 0..17 * 17 * 17 {
            let color = [i % 17, i / 17 % 17, i / 289].map(|step| step as f64 / 16.0);
            let [r, g, b] = Rgb(color).linear().0;
            let y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
            let wanted = Rgb([y; 3]).encoded().0[0] as f32;
            let found = grey_of(color.map(|value| value as f32), GreyWeights::Luminance);
            assert!((found - wanted).abs() < 0.25 / 255.0, "{color:?}: {found} {wanted}");
        }
    }

    #[test]
    fn a_grey_stays_what_it_is() {
        for i in 0..=255 {
            let value = i as f32 / 255.0;
            for weights in [GreyWeights::Luminance, GreyWeights::Rec601] {
                let found = grey_of([value; 3], weights);
                assert!((found - value).abs() < 0.15 / 255.0, "{value} {weights:?}: {found}");
            }
        }
        assert_eq!(grey_of([0.0; 3], GreyWeights::Luminance), 0.0);
        assert_eq!(grey_of([9.0, f32::INFINITY, 1.0], GreyWeights::Luminance), 1.0);
        let red = grey_of([1.0, 0.0, 0.0], GreyWeights::Rec601);
        assert!((red - 0.299).abs() < 1e-6);
    }
}
