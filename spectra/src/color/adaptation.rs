//! Chromatic adaptation: the colour that looks alike under another white.

use super::matrix::Matrix3;
use super::xyz::Xyz;

/// The space of sharpened cone responses in which von Kries scaling is done;
/// adaptation is complete.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Adaptation {
    /// Bradford (Lam 1985), linear form; what ICC profiles use.
    #[default]
    Bradford,
    /// CAT16 (Li et al. 2017).
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

    /// The matrix that carries XYZ under the white `from` to XYZ under `to`.
    #[must_use]
    pub fn matrix(self, from: Xyz, to: Xyz) -> Matrix3 {
        let cone_from_xyz = self.cone_from_xyz();
        let from = cone_from_xyz.apply(from.to_array());
        let to = cone_from_xyz.apply(to.to_array());
        let scale = Matrix3::diagonal([to[0] / from[0], to[1] / from[1], to[2] / from[2]]);
        cone_from_xyz.inverse().after(&scale).after(&cone_from_xyz)
    }
}

/// `xyz` under the white `from`, adapted to the white `to`.
#[must_use]
pub fn adapt(xyz: Xyz, from: Xyz, to: Xyz, adaptation: Adaptation) -> Xyz {
    adaptation.matrix(from, to).apply(xyz.to_array()).into()
}
