//! Chromatic adaptation: the corresponding colour under another white.

use super::matrix::Matrix3;
use super::xyz::Xyz;

/// The cone space in which von Kries adaptation is computed.
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

    /// The matrix for an eye that adapted from the white `from` to the white `to` by a `degree`
    /// D of 0 (XYZ stay) to 1 (completely). It scales each response of the cones by
    /// D to / from + 1 - D (CIECAM02, CIE 159:2004, for whites of the same luminance).
    #[must_use]
    pub fn partial_matrix(self, from: Xyz, to: Xyz, degree: f64) -> Matrix3 {
        let cone_from_xyz = self.cone_from_xyz();
        let from = cone_from_xyz.apply(from.to_array());
        let to = cone_from_xyz.apply(to.to_array());
        let scale = |cone: usize| degree * (to[cone] / from[cone]) + (1.0 - degree);
        let scale = Matrix3::diagonal([scale(0), scale(1), scale(2)]);
        cone_from_xyz.inverse().after(&scale).after(&cone_from_xyz)
    }
}

/// The colour that looks under the white `to` as `xyz` does under the white `from`.
#[must_use]
pub fn adapt(xyz: Xyz, from: Xyz, to: Xyz, adaptation: Adaptation) -> Xyz {
    adaptation.matrix(from, to).apply(xyz.to_array()).into()
}
