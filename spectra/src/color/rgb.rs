//! Display RGB: sRGB and Display P3.

use palette::encoding::{FromLinear, IntoLinear, Srgb};

use super::adaptation::{Adaptation, adapt};
use super::matrix::Matrix3;
use super::xyz::{Xyy, Xyz};

/// The RGB space of a display. Both have the white point D65 (x 0.3127, y 0.3290) and the
/// transfer curve of IEC 61966-2-1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum RgbSpace {
    /// sRGB (IEC 61966-2-1).
    #[default]
    Srgb,
    /// Display P3 (primaries of SMPTE EG 432-1).
    DisplayP3,
}

/// Red, green and blue, linear or encoded, each 0 to 1 inside the gamut of the display.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rgb(pub [f64; 3]);

impl RgbSpace {
    fn primaries(self) -> [(f64, f64); 3] {
        match self {
            Self::Srgb => [(0.640, 0.330), (0.300, 0.600), (0.150, 0.060)],
            Self::DisplayP3 => [(0.680, 0.320), (0.265, 0.690), (0.150, 0.060)],
        }
    }

    /// Note on a colour that a display of this space cannot show, for people.
    #[must_use]
    pub fn outside_note(self) -> &'static str {
        match self {
            Self::Srgb => "outside sRGB, shown clipped",
            Self::DisplayP3 => "outside Display P3, shown clipped",
        }
    }

    /// White point of the display, from the chromaticity that both standards define.
    #[must_use]
    pub fn white(self) -> Xyz {
        Xyy { x: 0.3127, y: 0.3290, luminance: 100.0 }.into()
    }

    /// The matrix from linear RGB (white 1) to XYZ (white Y = 100). Computed from the primaries
    /// at full precision; the standards list a rounded one.
    #[must_use]
    pub fn xyz_from_linear(self) -> Matrix3 {
        let columns = self.primaries().map(|(x, y)| [x / y, 1.0, (1.0 - x - y) / y]);
        let mut rows = [[0.0; 3]; 3];
        for (j, column) in columns.iter().enumerate() {
            for (i, value) in column.iter().enumerate() {
                rows[i][j] = *value;
            }
        }
        let primaries = Matrix3(rows);
        let scale = primaries.inverse().apply(self.white().to_array());
        primaries.after(&Matrix3::diagonal(scale))
    }

    /// Linear RGB of `xyz` under the white point `white`, adapted to the white of the display.
    /// Below 0 or above 1 outside the gamut.
    #[must_use]
    pub fn linear_from_xyz(self, xyz: Xyz, white: Xyz, adaptation: Adaptation) -> Rgb {
        let at_display = adapt(xyz, white, self.white(), adaptation);
        Rgb(self.xyz_from_linear().inverse().apply(at_display.to_array()))
    }

    /// Encoded RGB of `xyz`: [`RgbSpace::linear_from_xyz`] followed by the transfer curve.
    #[must_use]
    pub fn encoded_from_xyz(self, xyz: Xyz, white: Xyz, adaptation: Adaptation) -> Rgb {
        self.linear_from_xyz(xyz, white, adaptation).encoded()
    }

    /// XYZ of an encoded colour under the white point `white`: the inverse of
    /// [`RgbSpace::encoded_from_xyz`].
    #[must_use]
    pub fn xyz_from_encoded(self, rgb: Rgb, white: Xyz, adaptation: Adaptation) -> Xyz {
        let at_display = self.xyz_from_linear().apply(rgb.linear().0);
        adapt(at_display.into(), self.white(), white, adaptation)
    }
}

impl Rgb {
    /// Encodes linear RGB by the sRGB transfer curve. Its linear part below 0.0031308 continues
    /// below 0.
    #[must_use]
    pub fn encoded(self) -> Self {
        Self(self.0.map(<Srgb as FromLinear<f64, f64>>::from_linear))
    }

    /// Decodes encoded RGB to linear RGB.
    #[must_use]
    pub fn linear(self) -> Self {
        Self(self.0.map(<Srgb as IntoLinear<f64, f64>>::into_linear))
    }

    /// Whether the display can show the colour (to a millionth).
    #[must_use]
    pub fn in_gamut(self) -> bool {
        self.0.iter().all(|v| (-1e-6..=1.0 + 1e-6).contains(v))
    }

    /// The colour in 8 bits, each channel clipped to the gamut.
    #[must_use]
    pub fn to_bytes(self) -> [u8; 3] {
        self.0.map(|v| (v.clamp(0.0, 1.0) * 255.0).round() as u8)
    }

    /// Parses encoded RGB from `#rrggbb` or `#rgb`; the `#` may be missing. `None` for any
    /// other text.
    #[must_use]
    pub fn from_hex(text: &str) -> Option<Self> {
        let digits = text.strip_prefix('#').unwrap_or(text);
        if !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
            return None;
        }
        let value = |from: usize, to: usize| u8::from_str_radix(&digits[from..to], 16).ok();
        let bytes = match digits.len() {
            3 => [17 * value(0, 1)?, 17 * value(1, 2)?, 17 * value(2, 3)?],
            6 => [value(0, 2)?, value(2, 4)?, value(4, 6)?],
            _ => return None,
        };
        Some(Self(bytes.map(|byte| f64::from(byte) / 255.0)))
    }

    /// The colour as `#rrggbb`, clipped to the gamut.
    #[must_use]
    pub fn to_hex(self) -> String {
        let [r, g, b] = self.to_bytes();
        format!("#{r:02x}{g:02x}{b:02x}")
    }

    /// The code of [`Rgb::to_hex`] for people: a colour outside of `space` is marked, since its code is that of
    /// another colour.
    #[must_use]
    pub fn to_hex_with_note(self, space: RgbSpace) -> String {
        let hex = self.to_hex();
        if self.in_gamut() { hex } else { format!("{hex} ({})", space.outside_note()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hex_codes_are_read_back_as_written() {
        for text in ["#000000", "#2a5caa", "#ffffff"] {
            assert_eq!(Rgb::from_hex(text).unwrap().to_hex(), text);
        }
        assert_eq!(Rgb::from_hex("fa0"), Rgb::from_hex("#ffaa00"));
        for text in ["", "#", "#12345", "#12345g", "red", "#+1+1+1", "\u{e9}\u{e9}\u{e9}"] {
            assert_eq!(Rgb::from_hex(text), None, "{text}");
        }
    }

    #[test]
    fn a_color_that_a_display_cannot_show_is_marked() {
        let [inside, outside] = [[0.2, 1.0, 0.0], [-0.1, 1.0, 0.0]].map(Rgb);
        assert_eq!(inside.to_hex_with_note(RgbSpace::Srgb), "#33ff00");
        let note = "#00ff00 (outside sRGB, shown clipped)";
        assert_eq!(outside.to_hex_with_note(RgbSpace::Srgb), note);
        assert!(outside.to_hex_with_note(RgbSpace::DisplayP3).contains("outside Display P3,"));
    }

    #[test]
    fn conversion_to_xyz_and_back_is_the_identity() {
        let white = Xyz { x: 109.85, y: 100.0, z: 35.58 };
        for rgb in [[0.0, 0.0, 0.0], [1.0, 0.2, 0.01], [0.5, 0.5, 0.9]] {
            let xyz = RgbSpace::Srgb.xyz_from_encoded(Rgb(rgb), white, Adaptation::Bradford);
            let back = RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford).0;
            assert!(rgb.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-9), "{rgb:?} {back:?}");
        }
    }
}
