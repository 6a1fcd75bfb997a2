//! Tangent planes: axes at a place of a surface, lines and arrows in them, and how they are carried
//! from one plane to another.
//!
//! Plane vectors are complex numbers: x along the first axis, y along the second. A line
//! (a direction of arbitrary sign) is the square of its vector, whose angle is doubled, so that
//! both signs are one number (Palacios and Zhang, "Rotational symmetry field design on surfaces",
//! 2007). [`DVec2::rotate`] is the complex product.

use glam::{DVec2, DVec3};

/// Smallest value of 1 + cosine of the angle between two normals at which a vector can be carried.
const LEAST_OPENING: f64 = 1e-9;

/// A tangent plane: its unit normal and two unit axes, right-handed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TangentPlane {
    pub(super) normal: DVec3,
    pub(super) right: DVec3,
    pub(super) up: DVec3,
}

impl TangentPlane {
    /// A plane with this unit normal and axes that depend on it alone.
    pub(super) fn of_normal(normal: DVec3) -> Self {
        let (right, up) = normal.any_orthonormal_pair();
        Self { normal, right, up }
    }

    /// The plane seen from its other side; the first axis stays.
    pub(super) fn reversed(&self) -> Self {
        Self { normal: -self.normal, right: self.right, up: -self.up }
    }

    /// Part of a vector in the plane.
    pub(super) fn projected(&self, vector: DVec3) -> DVec2 {
        DVec2::new(vector.dot(self.right), vector.dot(self.up))
    }

    /// Unit vector along a line that is given by its square of any length but 0; the sign is
    /// arbitrary.
    pub(super) fn along(&self, squared: DVec2) -> DVec3 {
        let root = square_root(squared);
        (self.right * root.x + self.up * root.y).normalize_or(self.right)
    }

    /// Factor that carries squares of vectors from this plane to another: the shortest turn
    /// between both normals, in the axes of both. `None` if the normals are opposite.
    pub(super) fn turn_of_squares(&self, other: &Self) -> Option<DVec2> {
        let right = carried(self.right, self.normal, other.normal)?;
        let turn = other.projected(right).try_normalize()?;
        Some(turn.rotate(turn))
    }
}

/// Carries a vector that is perpendicular to the unit normal `from` by the shortest turn that takes
/// `from` to `to`. `None` if they are opposite.
pub(super) fn carried(vector: DVec3, from: DVec3, to: DVec3) -> Option<DVec3> {
    let opening = 1.0 + from.dot(to);
    (opening > LEAST_OPENING).then(|| vector - (from + to) * (to.dot(vector) / opening))
}

/// Complex square root of a number of any length but 0, as a unit vector; 1 for 0.
fn square_root(squared: DVec2) -> DVec2 {
    let unit = squared.normalize_or(DVec2::X);
    // Each form loses digits on the other side.
    if unit.x >= 0.0 {
        let x = f64::sqrt(0.5 * (1.0 + unit.x));
        DVec2::new(x, unit.y / (2.0 * x))
    } else {
        let y = f64::sqrt(0.5 * (1.0 - unit.x));
        DVec2::new(unit.y / (2.0 * y), y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn planes() -> Vec<TangentPlane> {
        let normals = [[0.0, 1.0, 0.0], [0.3, -0.5, 0.8], [-1.0, 1e-9, 0.0], [0.6, 0.6, -0.5]];
        normals.map(|normal| TangentPlane::of_normal(DVec3::from(normal).normalize())).to_vec()
    }

    #[test]
    fn a_line_is_the_root_of_its_square_up_to_the_sign() {
        for plane in planes() {
            for degrees in 0..360 {
                let unit = DVec2::from_angle(f64::from(degrees).to_radians());
                let vector = plane.right * unit.x + plane.up * unit.y;
                let line = plane.along(unit.rotate(unit) * 7.0);
                assert!((line.dot(vector).abs() - 1.0).abs() < 1e-14, "{degrees}: {line}");
                assert!(line.dot(plane.normal).abs() < 1e-14, "{degrees}: {line}");
            }
        }
    }

    #[test]
    fn a_square_is_carried_as_the_line_that_it_stands_for_and_back() {
        for from in planes() {
            for to in planes() {
                let turn = from.turn_of_squares(&to).unwrap();
                let back = to.turn_of_squares(&from).unwrap();
                assert!((turn.rotate(back) - DVec2::X).length() < 1e-12, "{turn} {back}");
                let square = DVec2::from_angle(0.7);
                let line = carried(from.along(square), from.normal, to.normal).unwrap();
                let same = to.along(turn.rotate(square)).dot(line).abs();
                assert!((same - 1.0).abs() < 1e-12, "{from:?} {to:?}: {same}");
            }
        }
    }

    #[test]
    fn nothing_is_carried_between_opposite_planes() {
        let plane = TangentPlane::of_normal(DVec3::Y);
        assert_eq!(plane.turn_of_squares(&TangentPlane::of_normal(-DVec3::Y)), None);
    }
}
