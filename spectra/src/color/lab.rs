//! CIELAB in rectangular and in cylindrical coordinates.

use super::matrix::Matrix3;
use super::xyz::Xyz;

/// A colour in CIE 1976 L*a*b* (ISO/CIE 11664-4).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Lab {
    /// Lightness, 0 for black to 100 for the white.
    pub lightness: f64,
    /// Green (negative) to red (positive).
    pub a: f64,
    /// Blue (negative) to yellow (positive).
    pub b: f64,
}

/// A CIELAB colour in cylindrical coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lch {
    /// Lightness, 0 to 100.
    pub lightness: f64,
    /// Chroma, 0 for grey and up.
    pub chroma: f64,
    /// Hue angle in degrees, 0 to 360.
    pub hue_degrees: f64,
}

/// (6/29)^3, the relative luminance below which L* is linear.
pub(super) const TOE: f64 = 216.0 / 24389.0;
/// (29/3)^3, the slope of L* in the linear part.
pub(super) const KAPPA: f64 = 24389.0 / 27.0;

impl Lab {
    /// The CIELAB colour of `xyz` under the white point `white` (ISO/CIE 11664-4, equations 1
    /// to 6).
    #[must_use]
    pub fn from_xyz(xyz: Xyz, white: Xyz) -> Self {
        let f = |t: f64| if t > TOE { t.cbrt() } else { (KAPPA * t + 16.0) / 116.0 };
        let fx = f(xyz.x / white.x);
        let fy = f(xyz.y / white.y);
        let fz = f(xyz.z / white.z);
        Self { lightness: 116.0 * fy - 16.0, a: 500.0 * (fx - fy), b: 200.0 * (fy - fz) }
    }

    /// The derivatives of L*, a*, b* (rows) with respect to X, Y, Z (columns) at `xyz`.
    #[must_use]
    pub fn slopes_over_xyz(xyz: Xyz, white: Xyz) -> Matrix3 {
        let slope = |value: f64, white: f64| {
            let t = value / white;
            (if t > TOE { t.powf(-2.0 / 3.0) / 3.0 } else { KAPPA / 116.0 }) / white
        };
        let x = slope(xyz.x, white.x);
        let y = slope(xyz.y, white.y);
        let z = slope(xyz.z, white.z);
        Matrix3([[0.0, 116.0 * y, 0.0], [500.0 * x, -500.0 * y, 0.0], [0.0, 200.0 * y, -200.0 * z]])
    }

    /// XYZ under the white point `white`: the inverse of [`Lab::from_xyz`].
    #[must_use]
    pub fn to_xyz(self, white: Xyz) -> Xyz {
        let inverse = |f: f64| if f > 6.0 / 29.0 { f.powi(3) } else { (116.0 * f - 16.0) / KAPPA };
        let fy = (self.lightness + 16.0) / 116.0;
        Xyz {
            x: white.x * inverse(fy + self.a / 500.0),
            y: white.y * inverse(fy),
            z: white.z * inverse(fy - self.b / 200.0),
        }
    }

    /// Converts to lightness, chroma and hue. Grey has hue 0.
    #[must_use]
    pub fn to_lch(self) -> Lch {
        let degrees = self.b.atan2(self.a).to_degrees();
        Lch {
            lightness: self.lightness,
            chroma: self.a.hypot(self.b),
            hue_degrees: if degrees < 0.0 { degrees + 360.0 } else { degrees },
        }
    }

    /// Parses three numbers separated by commas or blanks: L* from 0 to 100, a* and b* from
    /// -300 to 300, optionally inside `lab(..)`. `None` for any other text.
    #[must_use]
    pub fn from_text(text: &str) -> Option<Self> {
        let lower = text.trim().to_ascii_lowercase();
        let inside = lower.strip_prefix("lab(").and_then(|rest| rest.strip_suffix(')'));
        let parts = inside.unwrap_or(&lower).split([',', ' ']).filter(|part| !part.is_empty());
        let numbers: Vec<f64> = parts.map(str::parse).collect::<Result<_, _>>().ok()?;
        match numbers[..] {
            [lightness, a, b]
                if (0.0..=100.0).contains(&lightness) && a.abs() <= 300.0 && b.abs() <= 300.0 =>
            {
                Some(Self { lightness, a, b })
            }
            _ => None,
        }
    }

    /// L*, a* and b* in this order.
    #[must_use]
    pub fn to_array(self) -> [f64; 3] {
        [self.lightness, self.a, self.b]
    }
}

impl From<[f64; 3]> for Lab {
    fn from([lightness, a, b]: [f64; 3]) -> Self {
        Self { lightness, a, b }
    }
}

impl From<Lch> for Lab {
    fn from(lch: Lch) -> Self {
        let (sin, cos) = lch.hue_degrees.to_radians().sin_cos();
        Self { lightness: lch.lightness, a: lch.chroma * cos, b: lch.chroma * sin }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_three_numbers_in_range_are_parsed() {
        let expected = Some(Lab { lightness: 52.0, a: -10.5, b: 8.0 });
        for text in ["52,-10.5,8", "52 -10.5 8", "lab(52, -10.5, 8)", " LAB(52,-10.5,8) "] {
            assert_eq!(Lab::from_text(text), expected, "{text}");
        }
        for text in ["", "52,8", "52,8,1,2", "101,0,0", "-1,0,0", "50,400,0", "lab(1,2,3", "#fff"] {
            assert_eq!(Lab::from_text(text), None, "{text}");
        }
    }
}
