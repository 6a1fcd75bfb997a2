//! Linear light to 8-bit sRGB, as fast as a table and as exact as the export.

use spectra::color::Rgb;

/// Buckets of equal width between 0 and 1. Narrower than the nearest two
/// thresholds lie apart (1 / 255 / 12.92), so that none holds two.
const BUCKETS: usize = 4096;

/// From linear sRGB to the byte that a PNG of the same picture holds
/// ([`render::export::png8`]).
#[derive(Debug, Clone)]
pub(super) struct SrgbBytes {
    /// The byte of each bucket's lower end.
    lowest: Vec<u8>,
    /// The least value that gives each byte; none gives 256.
    least: [f32; 257],
}

impl SrgbBytes {
    /// The tables; they take about a tenth of a millisecond.
    pub(super) fn new() -> Self {
        let mut least = [f32::INFINITY; 257];
        for (byte, least) in least.iter_mut().enumerate().take(256) {
            *least = least_giving(byte as u8);
        }
        let bucket = |index: usize| exact(index as f32 / BUCKETS as f32);
        // One more for white itself.
        Self { lowest: (0..=BUCKETS).map(bucket).collect(), least }
    }

    /// The byte of one channel; what lies outside 0..1 is cut off.
    #[inline(always)]
    pub(super) fn byte(&self, linear: f32) -> u8 {
        let linear = linear.clamp(0.0, 1.0);
        // Exact, as the number of buckets is a power of two; no number gives 0.
        let lowest = self.lowest[(linear * BUCKETS as f32) as usize];
        lowest + u8::from(linear >= self.least[usize::from(lowest) + 1])
    }

    /// An opaque pixel.
    #[inline(always)]
    pub(super) fn pixel(&self, [r, g, b, _]: [f32; 4]) -> [u8; 4] {
        [self.byte(r), self.byte(g), self.byte(b), 255]
    }
}

/// The byte by the curve itself.
fn exact(linear: f32) -> u8 {
    Rgb([f64::from(linear); 3]).encoded().to_bytes()[0]
}

/// The least value in 0..=1 whose byte is `byte`, or more: halved over the bits,
/// whose order is that of positive numbers.
fn least_giving(byte: u8) -> f32 {
    let (mut low, mut high) = (0, 1.0_f32.to_bits());
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
