//! CIECAM02 and its uniform space CAM02-UCS, for the conditions of CIE 224: adapting luminance 100 cd/m2,
//! background 20 %, average surround, full adaptation.

use crate::color::{Matrix3, Xyz};

/// The adaptation transform CAT02 (CIE 159:2004, equation 1).
const CAT02: Matrix3 =
    Matrix3([[0.7328, 0.4296, -0.1624], [-0.7036, 1.6975, 0.0061], [0.0030, 0.0136, 0.9834]]);
/// Cone responses of Hunt, Pointer and Estevez (CIE 159:2004, equation 11).
const CONES: Matrix3 =
    Matrix3([[0.38971, 0.68898, -0.07868], [-0.22981, 1.18340, 0.04641], [0.0, 0.0, 1.0]]);

/// Adapting luminance in cd/m2.
const ADAPTING: f64 = 100.0;
/// Luminance factor of the background relative to the white.
const BACKGROUND: f64 = 0.2;
/// Constants of the average surround: impact c; the induction factor is 1.
const IMPACT: f64 = 0.69;

/// A light to which an observer is adapted.
#[derive(Debug, Clone)]
pub(super) struct Appearance {
    /// From XYZ to the cone responses of the adapted observer.
    cones: Matrix3,
    /// Luminance-level adaptation factor F_L.
    level: f64,
    /// Achromatic response of the white.
    white: f64,
}

/// A colour in CAM02-UCS.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct UniformColor {
    /// Lightness J', 0 to 100.
    pub(super) lightness: f64,
    /// Red-green coordinate a'.
    pub(super) a: f64,
    /// Yellow-blue coordinate b'.
    pub(super) b: f64,
    /// Hue angle in degrees, 0 to 360.
    pub(super) hue_deg: f64,
}

impl Appearance {
    /// An observer adapted to a white with Y = 100.
    pub(super) fn under(white: Xyz) -> Self {
        let sharpened = CAT02.apply(white.to_array());
        let scale = Matrix3::diagonal(sharpened.map(|response| white.y / response));
        let k = 1.0 / (5.0 * ADAPTING + 1.0);
        let level = 0.2 * k.powi(4) * 5.0 * ADAPTING
            + 0.1 * (1.0 - k.powi(4)).powi(2) * (5.0 * ADAPTING).cbrt();
        let cones = CONES.after(&CAT02.inverse()).after(&scale).after(&CAT02);
        let mut adapted = Self { cones, level, white: 1.0 };
        adapted.white = achromatic(adapted.responses(white));
        adapted
    }

    /// Compressed cone responses.
    fn responses(&self, xyz: Xyz) -> [f64; 3] {
        self.cones.apply(xyz.to_array()).map(|response| {
            let strength = (self.level * response.abs() / 100.0).powf(0.42);
            (400.0 * strength / (strength + 27.13)).copysign(response) + 0.1
        })
    }

    /// Coordinates of a colour in CAM02-UCS (Luo, Cui and Li 2006).
    pub(super) fn of(&self, xyz: Xyz) -> UniformColor {
        let responses = self.responses(xyz);
        let [red, green, blue] = responses;
        let a = red - 12.0 * green / 11.0 + blue / 11.0;
        let b = (red + green - 2.0 * blue) / 9.0;
        let hue = b.atan2(a);
        let eccentricity = ((hue + 2.0).cos() + 3.8) / 4.0;
        let lightness =
            100.0 * (achromatic(responses) / self.white).powf(IMPACT * (1.48 + BACKGROUND.sqrt()));
        let t = 50_000.0 / 13.0 * induction() * eccentricity * a.hypot(b)
            / (red + green + 21.0 / 20.0 * blue);
        let chroma = t.powf(0.9)
            * (lightness / 100.0).sqrt()
            * (1.64 - 0.29_f64.powf(BACKGROUND)).powf(0.73);
        let colorfulness = (0.0228 * chroma * self.level.powf(0.25)).ln_1p() / 0.0228;
        let degrees = hue.to_degrees();
        UniformColor {
            lightness: 1.7 * lightness / (1.0 + 0.007 * lightness),
            a: colorfulness * hue.cos(),
            b: colorfulness * hue.sin(),
            hue_deg: if degrees < 0.0 { degrees + 360.0 } else { degrees },
        }
    }
}

/// Achromatic response of compressed cone responses.
fn achromatic([red, green, blue]: [f64; 3]) -> f64 {
    (2.0 * red + green + blue / 20.0 - 0.305) * induction()
}

/// Induction factor of background and chroma.
fn induction() -> f64 {
    0.725 * (1.0 / BACKGROUND).powf(0.2)
}
