//! Colours of values.

/// Colours from one value to another, linear in encoded sRGB. Values beyond the ends have the colours of
/// the ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ramp {
    /// Value and encoded sRGB of the beginning.
    pub from: (f32, [u8; 3]),
    /// Value and encoded sRGB of the end.
    pub to: (f32, [u8; 3]),
}

impl Ramp {
    /// Shares or probabilities: white for none, `ink` for all.
    #[must_use]
    pub fn of_ink(ink: [u8; 3]) -> Self {
        Self { from: (0.0, [255; 3]), to: (1.0, ink) }
    }

    /// Encoded sRGB and opacity of a value. NaN is transparent.
    #[must_use]
    pub fn color(&self, value: f32) -> [u8; 4] {
        if value.is_nan() {
            return [0; 4];
        }
        let way = ((value - self.from.0) / (self.to.0 - self.from.0)).clamp(0.0, 1.0);
        let mut color = [255; 4];
        for (channel, (from, to)) in color.iter_mut().zip(self.from.1.iter().zip(self.to.1)) {
            let (from, to) = (f32::from(*from), f32::from(to));
            *channel = (from + way * (to - from)).round() as u8;
        }
        color
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_between_the_ends_are_blended() {
        let ramp = Ramp::of_ink([55, 0, 155]);
        assert_eq!(ramp.color(0.0), [255; 4]);
        assert_eq!(ramp.color(0.5), [155, 128, 205, 255]);
        assert_eq!(ramp.color(7.0), [55, 0, 155, 255]);
        assert_eq!(ramp.color(-7.0), [255; 4]);
        assert_eq!(ramp.color(f32::NAN), [0; 4], "no value");
        let falling = Ramp { from: (4.0, [0; 3]), to: (2.0, [200; 3]) };
        assert_eq!(falling.color(3.0), [100, 100, 100, 255]);
    }
}
