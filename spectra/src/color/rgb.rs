//! Display RGB (sRGB and Display P3), colours as text, and the mapping of colours that a display
//! cannot show to ones that it can.

use std::str::FromStr;
use std::sync::LazyLock;

use documents::hint::Explain;
use palette::encoding::{FromLinear, IntoLinear, Srgb};

use super::xyz::{Adaptation, KAPPA, Lab, Matrix3, TOE, Xyy, Xyz, adapt};

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

    /// The note that people read beside a colour that this display cannot show.
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

    /// The matrix from linear RGB (white 1) to XYZ (white Y = 100). We compute it from the
    /// primaries at full precision, because the standards list a rounded one.
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

    /// Linear RGB of `xyz` under the white point `white`, adapted to the white of the display. If
    /// the display cannot show the colour, a channel is below 0 or above 1.
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

    /// Parses encoded RGB from `#rrggbb` or `#rgb`. The `#` may be missing. This returns `None` for any other
    /// text.
    #[must_use]
    pub fn from_hex(text: &str) -> Option<Self> {
        let digits = text.strip_prefix('#').unwrap_or(text);
        if !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
            return None;
        }
        let bytes = match digits.len() {
            3 => [
                17 * hex_value(digits, 0, 1)?,
                17 * hex_value(digits, 1, 2)?,
                17 * hex_value(digits, 2, 3)?,
            ],
            6 => [hex_value(digits, 0, 2)?, hex_value(digits, 2, 4)?, hex_value(digits, 4, 6)?],
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

    /// The code of [`Rgb::to_hex`] for people. If the colour lies outside `space`, this adds a
    /// note, because the code then belongs to another colour.
    #[must_use]
    pub fn to_hex_with_note(self, space: RgbSpace) -> String {
        let hex = self.to_hex();
        if self.in_gamut() { hex } else { format!("{hex} ({})", space.outside_note()) }
    }
}

fn hex_value(digits: &str, from: usize, to: usize) -> Option<u8> {
    u8::from_str_radix(&digits[from..to], 16).ok()
}

/// The colour of an object under one light, in XYZ, CIELAB and sRGB.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorValues {
    /// Tristimulus values. Y = 100 for the perfect diffuser.
    pub xyz: Xyz,
    /// CIELAB relative to the white of the light.
    pub lab: Lab,
    /// Encoded sRGB, adapted from the light's white to the display's (Bradford). A channel is
    /// outside 0 to 1 if the display cannot show the colour.
    pub srgb: Rgb,
}

impl ColorValues {
    /// The colour `xyz` under a light with the white point `white`.
    #[must_use]
    pub fn from_xyz(xyz: Xyz, white: Xyz) -> Self {
        Self {
            xyz,
            lab: Lab::from_xyz(xyz, white),
            srgb: RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford),
        }
    }

    /// The colour as `#rrggbb`, clipped to the sRGB gamut.
    #[must_use]
    pub fn hex(&self) -> String {
        self.srgb.to_hex()
    }
}

/// A colour as a user types it: `#rrggbb` or `#rgb` in sRGB, or CIELAB as `L,a,b`.
///
/// ```
/// use spectra::color::ColorCode;
///
/// let blue: ColorCode = "#2a5caa".parse()?;
/// assert_eq!(blue.lab().lightness.round(), 40.0);
/// assert!("blue".parse::<ColorCode>().is_err());
/// # Ok::<(), spectra::color::ColorCodeError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ColorCode {
    /// Encoded sRGB, each channel 0 to 1.
    Srgb(Rgb),
    /// CIELAB relative to the white of the light that you choose later.
    Lab(Lab),
}

impl ColorCode {
    /// CIELAB of the colour. For sRGB it is relative to the display's white.
    #[must_use]
    pub fn lab(self) -> Lab {
        match self {
            Self::Srgb(_) => {
                let white = RgbSpace::Srgb.white();
                Lab::from_xyz(self.xyz(white), white)
            }
            Self::Lab(lab) => lab,
        }
    }

    /// XYZ of the colour under a light with the given white. This adapts sRGB from the display's
    /// white (Bradford).
    #[must_use]
    pub fn xyz(self, white: Xyz) -> Xyz {
        match self {
            Self::Srgb(rgb) => RgbSpace::Srgb.xyz_from_encoded(rgb, white, Adaptation::Bradford),
            Self::Lab(lab) => lab.to_xyz(white),
        }
    }
}

impl FromStr for ColorCode {
    type Err = ColorCodeError;

    fn from_str(text: &str) -> Result<Self, ColorCodeError> {
        let rgb = Rgb::from_hex(text).map(Self::Srgb);
        rgb.or_else(|| Lab::from_text(text).map(Self::Lab))
            .ok_or_else(|| ColorCodeError { text: text.to_owned() })
    }
}

/// A text that is not a colour.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
#[hint("try \"#2a5caa\" or 40,5,-45")]
#[error("a colour is #rrggbb or L,a,b, found `{text}`")]
pub struct ColorCodeError {
    /// The text that was given.
    pub text: String,
}

/// Halvings of the range of chroma. This reaches a 16,000th of it, less than a step of 8 bits.
const HALVINGS: usize = 14;

/// XYZ relative to the white of sRGB from linear sRGB, and the inverse.
static MATRICES: LazyLock<[Matrix3; 2]> = LazyLock::new(|| {
    let white = RgbSpace::Srgb.white().to_array();
    let from_white = Matrix3::diagonal(white.map(f64::recip));
    let xyz_from_rgb = from_white.after(&RgbSpace::Srgb.xyz_from_linear());
    [xyz_from_rgb, xyz_from_rgb.inverse()]
});

impl Rgb {
    /// Maps a linear sRGB colour into the gamut. You get the colour back bit for bit if the display
    /// can show it. Otherwise this returns the most colourful displayable colour of the same
    /// lightness L* and hue angle. A colour lighter than white becomes white, and one darker than
    /// black becomes black.
    ///
    /// On the line from a colour to the grey of its lightness, f(X) and f(Z) of CIELAB move evenly
    /// to f(Y), which does not change (ISO/CIE 11664-4, equations 1 to 6).
    #[must_use]
    pub fn mapped_into_gamut(self) -> Self {
        if self.in_gamut() || self.0.iter().any(|value| value.is_nan()) {
            return self;
        }
        let [xyz_from_rgb, rgb_from_xyz] = &*MATRICES;
        let xyz = xyz_from_rgb.apply(self.0.map(|value| value.clamp(-1e3, 1e3)));
        let y = xyz[1];
        if y >= 1.0 || y <= 0.0 {
            return Self([if y > 0.0 { 1.0 } else { 0.0 }; 3]);
        }
        let [x, grey, z] = xyz.map(root);
        let at = |chroma: f64| {
            let [x, z] = [x, z].map(|end| cubed(grey + chroma * (end - grey)));
            Self(rgb_from_xyz.apply([x, y, z]))
        };
        let mut inside = 0.0;
        let mut outside = 1.0;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inside + outside);
            *if at(middle).in_gamut() { &mut inside } else { &mut outside } = middle;
        }
        Self(at(inside).0.map(|value| value.clamp(0.0, 1.0)))
    }
}

fn root(t: f64) -> f64 {
    if t > TOE { t.cbrt() } else { (KAPPA * t + 16.0) / 116.0 }
}

fn cubed(f: f64) -> f64 {
    if f > 6.0 / 29.0 { f * f * f } else { (116.0 * f - 16.0) / KAPPA }
}

#[cfg(test)]
mod tests {
    use super::super::xyz::{Lab, Lch};
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

    fn lch(rgb: Rgb) -> Lch {
        let xyz = RgbSpace::Srgb.xyz_from_linear().apply(rgb.0);
        Lab::from_xyz(xyz.into(), RgbSpace::Srgb.white()).to_lch()
    }

    #[test]
    fn colors_that_a_display_shows_keep_their_bits() {
        for rgb in [[0.0, 0.5, 1.0], [1.0, 1.0, 1.0], [0.2, 1e-9, 0.7], [-1e-7, 0.3, 1.0 + 1e-7]] {
            assert_eq!(Rgb(rgb).mapped_into_gamut(), Rgb(rgb));
        }
        assert!(Rgb([f64::NAN, 0.0, 2.0]).mapped_into_gamut().0[0].is_nan());
    }

    #[test]
    fn others_keep_hue_and_lightness_and_come_to_the_edge_of_the_gamut() {
        for rgb in [[-0.1, 0.2, 0.6], [0.7, -0.05, 0.02], [-0.2, 0.5, 0.1], [1.2, 0.6, -0.02]] {
            let mapped = Rgb(rgb).mapped_into_gamut();
            let exact = lch(Rgb(rgb));
            let shown = lch(mapped);
            assert!((exact.lightness - shown.lightness).abs() < 1e-3, "{exact:?} {shown:?}");
            assert!((exact.hue_degrees - shown.hue_degrees).abs() < 0.01, "{exact:?} {shown:?}");
            let kept = shown.chroma / exact.chroma;
            assert!(kept > 0.3 && kept < 1.0, "{exact:?} {shown:?}");
            assert!(mapped.0.iter().all(|value| (0.0..=1.0).contains(value)), "{mapped:?}");
            let edge = mapped.0.iter().any(|value| value.min(1.0 - value) < 1e-3);
            assert!(edge, "{rgb:?}: {mapped:?}");
        }
        assert_eq!(Rgb([3.0, 2.0, 1.5]).mapped_into_gamut(), Rgb([1.0; 3]));
        assert_eq!(Rgb([-0.3, -0.1, 0.0]).mapped_into_gamut(), Rgb([0.0; 3]));
    }
}
