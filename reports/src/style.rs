//! Sizes, line weights and colours of every figure, in one place.

use spectra::color::{Adaptation, Lab, Rgb, RgbSpace, Xyz};

/// Width of a figure in px; fits a laptop's screen at 100 % with room around.
pub const WIDTH: u32 = 960;
/// Size of axis names and of text in general, in px.
pub const TEXT: f64 = 12.0;
/// Size of tick labels and of what stands in small panels, in px.
pub const SMALL_TEXT: f64 = 10.5;
/// Width of a curve, in px.
pub const CURVE: f64 = 1.6;
/// Width of a frame or a grid line, in px.
pub const HAIR: f64 = 0.7;
/// Radius of a dot that is a reading, in px.
pub const DOT: f64 = 1.2;
/// Opacity of a band of uncertainty.
pub const BAND: f64 = 0.25;
/// The fonts of a figure; pictures take the first, a page what is there.
pub const FONTS: &str = "Ubuntu,system-ui,sans-serif";

/// Text and frames. Reserved, as the next three: no data has exactly these
/// colours, so that a page can exchange them for a dark screen.
pub const INK: Color = Color([0x26, 0x29, 0x2C]);
/// Tick labels and remarks. Reserved.
pub const FAINT: Color = Color([0x5C, 0x64, 0x6B]);
/// Grid lines. Reserved.
pub const GRID: Color = Color([0xDF, 0xE3, 0xE7]);
/// What a figure is drawn on. Reserved.
pub const PAPER: Color = Color([0xFD, 0xFD, 0xFC]);
/// The reserved colours, each with the one that takes its place in the dark.
pub const RESERVED: [(Color, Color); 4] = [
    (INK, Color([0xE6, 0xE9, 0xEC])),
    (FAINT, Color([0xA9, 0xB1, 0xB9])),
    (GRID, Color([0x3A, 0x40, 0x47])),
    (PAPER, Color([0x1B, 0x1E, 0x22])),
];

/// Colours for what is no pigment: told apart by people who see red and green
/// alike (after Okabe and Ito 2008), dark enough for thin lines.
pub const SERIES: [Color; 4] = [
    Color([0x00, 0x64, 0xA8]),
    Color([0xC4, 0x4E, 0x00]),
    Color([0x00, 0x82, 0x62]),
    Color([0x9A, 0x4F, 0x86]),
];

/// A colour of a figure, sRGB in 8 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Color(pub [u8; 3]);

impl Color {
    /// The colour that sRGB shows for `xyz` seen under `white`, as a patch.
    #[must_use]
    pub fn of(xyz: Xyz, white: Xyz) -> Self {
        Self::shown(RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford))
    }

    /// The nearest that sRGB shows of an encoded colour, as a patch.
    #[must_use]
    pub fn shown(srgb: Rgb) -> Self {
        Self(srgb.to_bytes()).unreserved()
    }

    /// `#RRGGBB`.
    #[must_use]
    pub fn hex(self) -> String {
        let [r, g, b] = self.0;
        format!("#{r:02X}{g:02X}{b:02X}")
    }

    /// The same hue, as light as a thin line on paper may be and still be seen.
    #[must_use]
    pub fn for_line(self) -> Self {
        self.with_lightness(|lightness| lightness.clamp(18.0, 70.0)).unreserved()
    }

    /// The same hue, as dark as a line on a dark screen may be.
    #[must_use]
    pub fn for_line_in_the_dark(self) -> Self {
        self.with_lightness(|lightness| lightness.max(50.0 + 0.3 * lightness)).unreserved()
    }

    /// Darker, or lighter where it is dark, for dots on a line of this colour.
    #[must_use]
    pub fn beside(self) -> Self {
        self.with_lightness(
            |lightness| if lightness > 40.0 { lightness - 26.0 } else { lightness + 30.0 },
        )
        .unreserved()
    }

    /// What it looks like on paper with this opacity.
    #[must_use]
    pub fn over_paper(self, opacity: f64) -> Self {
        let mixed = |index: usize| {
            let (own, paper) = (f64::from(self.0[index]), f64::from(PAPER.0[index]));
            (opacity * own + (1.0 - opacity) * paper).round() as u8
        };
        Self([mixed(0), mixed(1), mixed(2)])
    }

    fn lab(self) -> Lab {
        let white = RgbSpace::Srgb.white();
        let linear = Rgb(self.0.map(|v| f64::from(v) / 255.0)).linear();
        let xyz = RgbSpace::Srgb.xyz_from_linear().apply(linear.0);
        Lab::from_xyz(xyz.into(), white)
    }

    fn with_lightness(self, changed: impl Fn(f64) -> f64) -> Self {
        let lab = self.lab();
        let lightness = changed(lab.lightness);
        if (lightness - lab.lightness).abs() < 1e-9 {
            return self;
        }
        let white = RgbSpace::Srgb.white();
        let xyz = Lab { lightness, ..lab }.to_xyz(white);
        Self(RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford).to_bytes())
    }

    /// A step beside a reserved colour.
    fn unreserved(self) -> Self {
        let [r, g, b] = self.0;
        let reserved = RESERVED.iter().any(|(color, _)| *color == self);
        if reserved { Self([r, g, b - 1]) } else { self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_data_has_a_reserved_color() {
        let white = RgbSpace::Srgb.white();
        for (reserved, _) in RESERVED {
            let linear = Rgb(reserved.0.map(|v| f64::from(v) / 255.0)).linear();
            let xyz: Xyz = RgbSpace::Srgb.xyz_from_linear().apply(linear.0).into();
            assert_ne!(Color::of(xyz, white), reserved);
        }
        let own = SERIES.iter().all(|c| RESERVED.iter().all(|(reserved, _)| reserved != c));
        assert!(own, "the series stand apart from ink and paper");
    }

    #[test]
    fn lines_are_seen_on_paper_and_in_the_dark() {
        for color in [Color([255; 3]), Color([0; 3]), Color([250, 230, 40])] {
            assert!(color.for_line().lab().lightness < 75.0, "{color:?}");
            let dark = color.for_line().for_line_in_the_dark();
            assert!(dark.lab().lightness > 50.0, "{color:?} is {dark:?}");
        }
        assert_eq!(SERIES[0].for_line(), SERIES[0]);
    }
}
