//! Sizes, line widths and colours of all figures.

use spectra::color::{Adaptation, Lab, Rgb, RgbSpace, Xyz};

/// Width of a figure in px. This fits the screen of a laptop at 100 % zoom.
pub const WIDTH: u32 = 960;
/// Font size of axis names and of general text, in px.
pub const TEXT: f64 = 12.0;
/// Font size of tick labels and of text in small panels, in px.
pub const SMALL_TEXT: f64 = 10.5;
/// Width of a curve, in px.
pub const CURVE: f64 = 1.6;
/// Width of a frame or a grid line, in px.
pub const HAIR: f64 = 0.7;
/// Radius of the dot of a reading, in px.
pub const DOT: f64 = 1.2;
/// Opacity of a band of uncertainty, 0 to 1.
pub const BAND: f64 = 0.25;
/// Font families of a figure. PNG files use the first, which we build in. A page uses the first
/// that the reader has.
pub const FONTS: &str = "Ubuntu,system-ui,sans-serif";

/// Colour of text and frames. We reserve this and the next three: no data has exactly these
/// colours, so that a page can replace them on a dark screen.
pub const INK: Color = Color([0x26, 0x29, 0x2C]);
/// Colour of tick labels and remarks. Reserved like [`INK`].
pub const FAINT: Color = Color([0x5C, 0x64, 0x6B]);
/// Colour of grid lines. Reserved like [`INK`].
pub const GRID: Color = Color([0xDF, 0xE3, 0xE7]);
/// Background colour of a figure. Reserved like [`INK`].
pub const PAPER: Color = Color([0xFD, 0xFD, 0xFC]);
/// The reserved colours, each with its replacement on a dark screen.
pub const RESERVED: [(Color, Color); 4] = [
    (INK, Color([0xE6, 0xE9, 0xEC])),
    (FAINT, Color([0xA9, 0xB1, 0xB9])),
    (GRID, Color([0x3A, 0x40, 0x47])),
    (PAPER, Color([0x1B, 0x1E, 0x22])),
];

/// Colours for series that are not pigments. You can tell them apart with red-green colour
/// blindness (after Okabe and Ito 2008), and they are dark enough for thin lines. Reserved like
/// [`INK`].
pub const SERIES: [Color; 4] = [
    Color([0x00, 0x64, 0xA8]),
    Color([0xC4, 0x4E, 0x00]),
    Color([0x00, 0x82, 0x62]),
    Color([0x9A, 0x4F, 0x86]),
];

/// A colour of a figure, sRGB with 8 bits per channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Color(pub [u8; 3]);

impl Color {
    /// The colour of `xyz` under `white`, for a patch: adapted to D65 and clipped to sRGB.
    #[must_use]
    pub fn from_xyz(xyz: Xyz, white: Xyz) -> Self {
        Self::from_rgb(RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford))
    }

    /// An encoded sRGB colour, clipped to the gamut, for a patch.
    #[must_use]
    pub fn from_rgb(srgb: Rgb) -> Self {
        Self(srgb.to_bytes()).unreserved()
    }

    /// The colour as `#RRGGBB`.
    #[must_use]
    pub fn hex(self) -> String {
        let [r, g, b] = self.0;
        format!("#{r:02X}{g:02X}{b:02X}")
    }

    /// The colour with L* limited to 18 to 70, so that a thin line is visible on paper.
    #[must_use]
    pub fn for_line(self) -> Self {
        self.with_lightness(|lightness| lightness.clamp(18.0, 70.0)).unreserved()
    }

    /// The colour with L* raised to at least 50, so that a line is visible on a dark screen.
    #[must_use]
    pub fn for_dark_screen(self) -> Self {
        self.with_lightness(|lightness| lightness.max(50.0 + 0.3 * lightness)).unreserved()
    }

    /// A darker version, or a lighter one if the colour is dark. Use this for dots on a line of
    /// this colour.
    #[must_use]
    pub fn contrasting(self) -> Self {
        self.with_lightness(
            |lightness| if lightness > 40.0 { lightness - 26.0 } else { lightness + 30.0 },
        )
        .unreserved()
    }

    fn lab(self) -> Lab {
        let white = RgbSpace::Srgb.white();
        let linear = Rgb(self.0.map(|v| f64::from(v) / 255.0)).linear();
        let xyz = RgbSpace::Srgb.xyz_from_linear().apply(linear.0);
        Lab::from_xyz(xyz.into(), white)
    }

    fn with_lightness(self, change: impl Fn(f64) -> f64) -> Self {
        let lab = self.lab();
        let lightness = change(lab.lightness);
        if (lightness - lab.lightness).abs() < 1e-9 {
            return self;
        }
        let white = RgbSpace::Srgb.white();
        let xyz = Lab { lightness, ..lab }.to_xyz(white);
        Self(RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford).to_bytes())
    }

    /// The colour itself, or its neighbour in blue if we reserve it.
    fn unreserved(self) -> Self {
        let [r, g, b] = self.0;
        if self.is_reserved() { Self([r, g, b.checked_sub(1).unwrap_or(1)]) } else { self }
    }

    /// Whether this is one of the [`RESERVED`] colours.
    #[must_use]
    pub fn is_reserved(self) -> bool {
        RESERVED.iter().any(|(color, _)| *color == self) || SERIES.contains(&self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_data_has_a_reserved_color() {
        let white = RgbSpace::Srgb.white();
        for reserved in RESERVED.map(|(color, _)| color).into_iter().chain(SERIES) {
            let linear = Rgb(reserved.0.map(|v| f64::from(v) / 255.0)).linear();
            let xyz: Xyz = RgbSpace::Srgb.xyz_from_linear().apply(linear.0).into();
            let data = Color::from_xyz(xyz, white);
            assert!(!data.is_reserved() && reserved.is_reserved(), "{reserved:?}, {data:?}");
        }
        let own = SERIES.iter().all(|c| RESERVED.iter().all(|(reserved, _)| reserved != c));
        assert!(own, "no series has a reserved colour");
    }

    #[test]
    fn lines_are_visible_on_paper_and_on_a_dark_screen() {
        for color in [Color([255; 3]), Color([0; 3]), Color([250, 230, 40])] {
            assert!(color.for_line().lab().lightness < 75.0, "{color:?}");
            let dark = color.for_line().for_dark_screen();
            assert!(dark.lab().lightness > 50.0, "{color:?} is {dark:?}");
        }
        assert_eq!(Color([0, 100, 160]).for_line(), Color([0, 100, 160]));
    }
}
