//! Samples whose strokes stand at the places of another's, as painted tones with the same strokes
//! do.

use super::level::Level;

/// Correlation of lightness from which on two samples count as nested. Samples of different
/// strokes have less than 0.2, painted tones of the same strokes more than 0.4.
const NESTED: f64 = 0.3;

/// Whether the strokes of `other` stand where those of `first` do. Both must be of one size and
/// cover the same texels.
pub(crate) fn is_nested(first: &Level, other: &Level) -> bool {
    first.mask == other.mask && correlation(first, other) >= NESTED
}

/// Correlation of the smoothed L* of two samples, texel by texel.
fn correlation(first: &Level, other: &Level) -> f64 {
    let inside = first.mask.values();
    let lightness = |level: &Level, at: usize| f64::from(level.features.values()[at][1]);
    let mut sums = [0.0; 3];
    for at in (0..inside.len()).filter(|at| inside[*at]) {
        // Features have mean 0.
        let a = lightness(first, at);
        let b = lightness(other, at);
        sums[0] += a * a;
        sums[1] += b * b;
        sums[2] += a * b;
    }
    let squares = sums[0] * sums[1];
    if squares > 0.0 { sums[2] / squares.sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::super::level::Channels;
    use super::super::settings::Features;
    use super::*;
    use crate::sample::strokes;

    fn level(tone: f32, seed: u64) -> Level {
        Level::new(&Channels::of(&strokes("a", 160, 8, tone, seed)), 8.0, Features::default())
    }

    #[test]
    fn tones_of_the_same_strokes_are_nested_and_others_are_not() {
        let first = level(0.1, 1);
        assert!(is_nested(&first, &level(0.4, 1)));
        for seed in 2..8 {
            let found = correlation(&first, &level(0.4, seed));
            assert!(found.abs() < 0.2, "seed {seed}: {found}");
        }
    }

    #[test]
    fn samples_of_other_masks_are_not_nested() {
        let first = level(0.1, 1);
        let mut other = level(0.4, 1);
        other.mask[(3, 3)] = false;
        assert!(!is_nested(&first, &other));
    }
}
