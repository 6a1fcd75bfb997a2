//! Linear light to 8-bit sRGB by a table: the bytes of the PNG export.

use spectra::color::Rgb;

/// Number of buckets of equal width between 0 and 1. A bucket is narrower than the smallest
/// distance between two entries of `least` (1 / 255 / 12.92), so it contains at most one of them.
const BUCKETS: usize = 4096;

/// Tables from linear sRGB to the bytes of a PNG of the same picture
/// ([`graphics::export::png8`]).
#[derive(Debug, Clone)]
pub(super) struct SrgbBytes {
    /// Byte at the lower end of each bucket.
    lowest: Vec<u8>,
    /// Smallest linear value that gives each byte; the last entry, for 256, is infinite.
    least: [f32; 257],
}

impl SrgbBytes {
    /// Computes the tables, in about 0.1 ms.
    pub(super) fn new() -> Self {
        let mut least = [f32::INFINITY; 257];
        for (byte, least) in least.iter_mut().enumerate().take(256) {
            *least = least_giving(byte as u8);
        }
        // One more bucket, for the value 1.
        Self {
            lowest: (0..=BUCKETS)
                .map(|index: usize| exact(index as f32 / BUCKETS as f32))
                .collect(),
            least,
        }
    }

    /// Byte of one channel; values outside 0 to 1 are clipped.
    #[inline(always)]
    pub(super) fn byte(&self, linear: f32) -> u8 {
        let linear = linear.clamp(0.0, 1.0);
        // The product is exact, because the number of buckets is a power of two. NaN gives bucket
        // 0.
        let lowest = self.lowest[(linear * BUCKETS as f32) as usize];
        lowest + u8::from(linear >= self.least[usize::from(lowest) + 1])
    }

    /// The opaque pixel of a colour. Outside the gamut it keeps hue and lightness.
    #[inline(always)]
    pub(super) fn pixel(&self, [r, g, b, _]: [f32; 4]) -> [u8; 4] {
        if [r, g, b].iter().all(|value| (0.0..=1.0).contains(value)) {
            [self.byte(r), self.byte(g), self.byte(b), 255]
        } else {
            mapped([r, g, b])
        }
    }
}

/// The opaque pixel of a colour that may lie outside the gamut.
#[inline(never)]
fn mapped(linear: [f32; 3]) -> [u8; 4] {
    let [r, g, b] = Rgb(linear.map(f64::from)).mapped_into_gamut().encoded().to_bytes();
    [r, g, b, 255]
}

/// Byte computed by the sRGB curve.
fn exact(linear: f32) -> u8 {
    Rgb([f64::from(linear); 3]).encoded().to_bytes()[0]
}

/// Smallest value from 0 to 1 whose byte is at least `byte`. Bisects the bit patterns, which have
/// the same order as the non-negative numbers that they represent.
fn least_giving(byte: u8) -> f32 {
    let mut low = 0;
    let mut high = 1.0_f32.to_bits();
    while low < high {
        let middle = low.midpoint(high);
        if exact(f32::from_bits(middle)) >= byte {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    f32::from_bits(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_those_of_the_curve_around_every_threshold_and_between() {
        let table = SrgbBytes::new();
        for least in &table.least[1..256] {
            for step in -3..=3_i32 {
                let value = f32::from_bits(least.to_bits().saturating_add_signed(step)).min(1.0);
                assert_eq!(table.byte(value), exact(value), "{value:e}");
            }
        }
        for index in 0..=200_000 {
            let value = index as f32 / 200_000.0;
            assert_eq!(table.byte(value), exact(value), "{value}");
        }
    }

    #[test]
    fn what_no_screen_shows_is_cut_off() {
        let table = SrgbBytes::new();
        for (value, byte) in [(-1.0, 0), (-0.0, 0), (1e-40, 0), (1.0, 255), (7.0, 255)] {
            assert_eq!(table.byte(value), byte, "{value}");
        }
        assert_eq!(table.byte(f32::NAN), 0, "no number is black");
        assert_eq!(table.byte(f32::INFINITY), 255, "without end is white");
    }
}
