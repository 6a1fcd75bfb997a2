//! Tristimulus values, chromaticity, CIELAB, CIELUV and chromatic adaptation, with the 3 x 3 matrices between
//! them.

/// Tristimulus values of the CIE, scaled so that the white has Y = 100.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Xyz {
    /// Tristimulus value X, 0 and up.
    pub x: f64,
    /// Tristimulus value Y: the luminance factor in percent.
    pub y: f64,
    /// Tristimulus value Z, 0 and up.
    pub z: f64,
}

/// Chromaticity x, y and luminance factor Y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Xyy {
    /// Chromaticity x, 0 to 1 for real colours.
    pub x: f64,
    /// Chromaticity y, 0 to 1 for real colours.
    pub y: f64,
    /// Luminance factor in percent, 100 for the white.
    pub luminance: f64,
}

impl Xyz {
    /// X, Y and Z in this order.
    #[must_use]
    pub fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// Chromaticity and luminance. Black gets the chromaticity of `white`.
    #[must_use]
    pub fn to_xyy(self, white: Self) -> Xyy {
        let total = self.x + self.y + self.z;
        let (of, total) =
            if total == 0.0 { (white, white.x + white.y + white.z) } else { (self, total) };
        Xyy { x: of.x / total, y: of.y / total, luminance: self.y }
    }
}

impl From<[f64; 3]> for Xyz {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self { x, y, z }
    }
}

impl From<Xyy> for Xyz {
    /// Converts to XYZ. If y is 0, X and Z have no finite value, and you get black.
    fn from(xyy: Xyy) -> Self {
        if xyy.y == 0.0 {
            return Self::default();
        }
        let scale = xyy.luminance / xyy.y;
        Self { x: xyy.x * scale, y: xyy.luminance, z: (1.0 - xyy.x - xyy.y) * scale }
    }
}

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
        let fx = lab_f(xyz.x / white.x);
        let fy = lab_f(xyz.y / white.y);
        let fz = lab_f(xyz.z / white.z);
        Self { lightness: 116.0 * fy - 16.0, a: 500.0 * (fx - fy), b: 200.0 * (fy - fz) }
    }

    /// The derivatives of L*, a*, b* (rows) with respect to X, Y, Z (columns) at `xyz`.
    #[must_use]
    pub fn slopes_over_xyz(xyz: Xyz, white: Xyz) -> Matrix3 {
        let x = lab_slope(xyz.x, white.x);
        let y = lab_slope(xyz.y, white.y);
        let z = lab_slope(xyz.z, white.z);
        Matrix3([[0.0, 116.0 * y, 0.0], [500.0 * x, -500.0 * y, 0.0], [0.0, 200.0 * y, -200.0 * z]])
    }

    /// XYZ under the white point `white`: the inverse of [`Lab::from_xyz`].
    #[must_use]
    pub fn to_xyz(self, white: Xyz) -> Xyz {
        let fy = (self.lightness + 16.0) / 116.0;
        Xyz {
            x: white.x * lab_f_inverse(fy + self.a / 500.0),
            y: white.y * lab_f_inverse(fy),
            z: white.z * lab_f_inverse(fy - self.b / 200.0),
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

    /// Parses three numbers separated by commas or blanks: L* from 0 to 100, a* and b* from -300 to
    /// 300, optionally inside `lab(..)`. Any other text gives `None`.
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

fn lab_f_inverse(f: f64) -> f64 {
    if f > 6.0 / 29.0 { f.powi(3) } else { (116.0 * f - 16.0) / KAPPA }
}

fn lab_slope(value: f64, white: f64) -> f64 {
    let t = value / white;
    (if t > TOE { t.powf(-2.0 / 3.0) / 3.0 } else { KAPPA / 116.0 }) / white
}

fn lab_f(t: f64) -> f64 {
    if t > TOE { t.cbrt() } else { (KAPPA * t + 16.0) / 116.0 }
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

/// A colour in CIE 1976 L*u*v* (ISO/CIE 11664-5).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Luv {
    /// Lightness, 0 for black to 100 for the white.
    pub lightness: f64,
    /// Green (negative) to red (positive).
    pub u: f64,
    /// Blue (negative) to yellow (positive).
    pub v: f64,
}

impl Luv {
    /// The CIELUV colour of `xyz` under the white point `white` (ISO/CIE 11664-5, equations 1
    /// to 5). Black has u* = v* = 0.
    #[must_use]
    pub fn from_xyz(xyz: Xyz, white: Xyz) -> Self {
        let relative = xyz.y / white.y;
        let lightness =
            if relative > TOE { 116.0 * relative.cbrt() - 16.0 } else { KAPPA * relative };
        let [u, v] = uniform_chromaticity(xyz);
        let [white_u, white_v] = uniform_chromaticity(white);
        let scale = 13.0 * lightness;
        Self { lightness, u: scale * (u - white_u), v: scale * (v - white_v) }
    }

    /// L*, u* and v* in this order.
    #[must_use]
    pub fn to_array(self) -> [f64; 3] {
        [self.lightness, self.u, self.v]
    }
}

/// CIE 1976 chromaticity u', v', 0 for black.
fn uniform_chromaticity(xyz: Xyz) -> [f64; 2] {
    let sum = xyz.x + 15.0 * xyz.y + 3.0 * xyz.z;
    if sum > 0.0 { [4.0 * xyz.x / sum, 9.0 * xyz.y / sum] } else { [0.0; 2] }
}

/// The cone space in which we compute von Kries adaptation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Adaptation {
    /// Bradford transform (Lam 1985) in its linear form, as used by ICC profiles.
    #[default]
    Bradford,
    /// CAT16 (Li et al. 2017), the transform of CIECAM16.
    Cat16,
}

impl Adaptation {
    fn cone_from_xyz(self) -> Matrix3 {
        match self {
            Self::Bradford => Matrix3([
                [0.8951, 0.2664, -0.1614],
                [-0.7502, 1.7135, 0.0367],
                [0.0389, -0.0685, 1.0296],
            ]),
            Self::Cat16 => Matrix3([
                [0.401288, 0.650173, -0.051461],
                [-0.250268, 1.204414, 0.045854],
                [-0.002079, 0.048952, 0.953127],
            ]),
        }
    }

    /// The matrix that adapts XYZ under the white `from` to the white `to`, completely.
    #[must_use]
    pub fn matrix(self, from: Xyz, to: Xyz) -> Matrix3 {
        self.partial_matrix(from, to, 1.0)
    }

    /// The matrix for an eye that adapted from the white `from` to the white `to` by the `degree`
    /// D. With 0 this leaves XYZ as they are. With 1 the eye adapts completely. The matrix scales
    /// each response of the cones by D to / from + 1 - D (CIECAM02, CIE 159:2004, for whites of the
    /// same luminance).
    #[must_use]
    pub fn partial_matrix(self, from: Xyz, to: Xyz, degree: f64) -> Matrix3 {
        let cone_from_xyz = self.cone_from_xyz();
        let from = cone_from_xyz.apply(from.to_array());
        let to = cone_from_xyz.apply(to.to_array());
        let scale = [0, 1, 2].map(|cone| degree * (to[cone] / from[cone]) + (1.0 - degree));
        let scale = Matrix3::diagonal(scale);
        cone_from_xyz.inverse().after(&scale).after(&cone_from_xyz)
    }
}

/// The colour that looks under the white `to` as `xyz` does under the white `from`.
#[must_use]
pub fn adapt(xyz: Xyz, from: Xyz, to: Xyz, adaptation: Adaptation) -> Xyz {
    adaptation.matrix(from, to).apply(xyz.to_array()).into()
}

/// A 3 x 3 matrix as an array of rows. We name matrices by target and source, e.g. `rgb_from_xyz`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Matrix3(pub [[f64; 3]; 3]);

impl Matrix3 {
    /// The diagonal matrix with the given elements.
    #[must_use]
    pub fn diagonal(diagonal: [f64; 3]) -> Self {
        let mut rows = [[0.0; 3]; 3];
        for (index, value) in diagonal.into_iter().enumerate() {
            rows[index][index] = value;
        }
        Self(rows)
    }

    /// The product of the matrix and a column vector.
    #[must_use]
    pub fn apply(&self, column: [f64; 3]) -> [f64; 3] {
        self.0.map(|row| row[0] * column[0] + row[1] * column[1] + row[2] * column[2])
    }

    /// The matrix product `self * first`, which applies `first` first.
    #[must_use]
    pub fn after(&self, first: &Self) -> Self {
        let mut rows = [[0.0; 3]; 3];
        for (i, row) in rows.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value = (0..3).map(|k| self.0[i][k] * first.0[k][j]).sum();
            }
        }
        Self(rows)
    }

    /// The inverse, by cofactors.
    ///
    /// # Panics
    /// If the matrix is singular. This never happens for independent primaries or cone responses.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let m = &self.0;
        let determinant: f64 = (0..3).map(|j| m[0][j] * cofactor(m, 0, j)).sum();
        assert!(determinant != 0.0, "a colour matrix is never singular: {m:?}");
        let mut rows = [[0.0; 3]; 3];
        for (i, row) in rows.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value = cofactor(m, j, i) / determinant;
            }
        }
        Self(rows)
    }
}

fn cofactor(m: &[[f64; 3]; 3], i: usize, j: usize) -> f64 {
    let a = (i + 1) % 3;
    let b = (i + 2) % 3;
    let c = (j + 1) % 3;
    let d = (j + 2) % 3;
    m[a][c] * m[b][d] - m[a][d] * m[b][c]
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
