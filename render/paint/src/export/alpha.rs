//! Films as colours with opacity, for programs that know nothing else.
//!
//! Light passes through a film of paint twice and is scattered on its way; the film does not
//! blend with what lies below by one share of opacity. But at one pixel, over one colour, every
//! colour can be reached: with `b` the colour below and `c` the colour with the film, both as
//! stored (encoded sRGB, 0 to 1), programs show
//! ```text
//! c = a f + (1 - a) b
//! ```
//! for opacity a and colour f. f lies within 0..1 if a is at least the share by which some channel
//! of b is moved towards black or white,
//! ```text
//! least = max over channels of (b - c) / b and (c - b) / (1 - b)
//! ```
//! So the greater of this and of the film's own hiding power is taken, and f solved for it: no
//! value is ever clipped, and the stack of layers shows the painting to the rounding of 16 bits.

/// Greatest value of a channel.
const FULL: f64 = 65535.0;

/// Colour and opacity that show `above` over `below`, all in 16 bits. The opacity is `hiding`, 0 to
/// 1, or more where that cannot reach the colour.
#[must_use]
pub(super) fn over(below: [u16; 3], above: [u16; 3], hiding: f64) -> [u16; 4] {
    let pairs = [0, 1, 2].map(|i| (f64::from(below[i]) / FULL, f64::from(above[i]) / FULL));
    let least = pairs.map(|(b, c)| if c < b { (b - c) / b } else { (c - b) / (1.0 - b).max(1e-9) });
    let alpha = least.into_iter().fold(hiding.clamp(0.0, 1.0), f64::max).min(1.0);
    // Rounded up, so that the colour stays within its range.
    let stored = (alpha * FULL).ceil();
    if stored == 0.0 {
        return [0; 4];
    }
    let share = stored / FULL;
    let [r, g, b] = pairs.map(|(b, c)| {
        let color = (c - (1.0 - share) * b) / share;
        (color.clamp(0.0, 1.0) * FULL).round() as u16
    });
    [r, g, b, stored as u16]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn composited(below: [u16; 3], layer: [u16; 4]) -> [f64; 3] {
        let share = f64::from(layer[3]) / FULL;
        [0, 1, 2].map(|i| share * f64::from(layer[i]) + (1.0 - share) * f64::from(below[i]))
    }

    #[test]
    fn every_colour_is_reached_over_every_other() {
        let values = [0_u16, 1, 2, 300, 20_000, 32_768, 65_000, 65_534, 65_535];
        let mut clear = 0;
        for below in values {
            for above in values {
                for hiding in [0.0, 1e-6, 0.02, 0.5, 0.99, 1.0] {
                    let below = [below, 9000, 65_535];
                    let above = [above, 9000, 60_000];
                    let layer = over(below, above, hiding);
                    for (found, wanted) in composited(below, layer).into_iter().zip(above) {
                        let error = (found - f64::from(wanted)).abs();
                        assert!(error <= 0.5 + 1e-6, "{below:?} {above:?} {hiding}: {layer:?}");
                    }
                    assert!(f64::from(layer[3]) >= hiding * FULL, "{layer:?} hides {hiding}");
                    clear += usize::from(layer[3] < 65_535);
                }
            }
        }
        assert!(clear > 200, "most are not opaque: {clear}");
    }

    #[test]
    fn nothing_that_changes_nothing_is_clear() {
        assert_eq!(over([5, 6, 7], [5, 6, 7], 0.0), [0; 4]);
        let [.., alpha] = over([5, 6, 7], [5, 6, 7], 0.25);
        assert_eq!(alpha, 16_384);
    }
}
