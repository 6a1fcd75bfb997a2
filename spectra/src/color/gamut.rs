//! Colours that a display cannot show, by the most colourful ones of their hue and lightness.

use std::sync::LazyLock;

use super::lab::{KAPPA, TOE};
use super::matrix::Matrix3;
use super::rgb::{Rgb, RgbSpace};

/// Halvings of the range of chroma: to a 16,000th of it, below a step of 8 bits.
const HALVINGS: usize = 14;

/// XYZ relative to the white of sRGB from linear sRGB, and the inverse.
static MATRICES: LazyLock<[Matrix3; 2]> = LazyLock::new(|| {
    let white = RgbSpace::Srgb.white().to_array();
    let from_white = Matrix3::diagonal(white.map(f64::recip));
    let xyz_from_rgb = from_white.after(&RgbSpace::Srgb.xyz_from_linear());
    [xyz_from_rgb, xyz_from_rgb.inverse()]
});

impl Rgb {
    /// The linear sRGB colour itself if the display can show it (bit for bit), else the most
    /// colourful one that it can show of the same lightness L* and hue angle of CIELAB. Lighter
    /// than white is white, darker than black is black.
    ///
    /// On the line from a colour to the grey of its lightness, f(X) and f(Z) of CIELAB move evenly
    /// to f(Y), which stays (ISO/CIE 11664-4, equations 1 to 6).
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

/// The function f of CIELAB.
fn root(t: f64) -> f64 {
    if t > TOE { t.cbrt() } else { (KAPPA * t + 16.0) / 116.0 }
}

/// The inverse of [`root`].
fn cubed(f: f64) -> f64 {
    if f > 6.0 / 29.0 { f * f * f } else { (116.0 * f - 16.0) / KAPPA }
}

#[cfg(test)]
mod tests {
    use super::super::lab::{Lab, Lch};
    use super::*;

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
