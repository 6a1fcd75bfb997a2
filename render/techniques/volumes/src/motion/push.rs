//! Pushes, such as by blown air.

use glam::Vec3;

/// A push on everything inside a ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// Centre of the ball, in the unit of the scene.
    pub center: Vec3,
    /// Unit direction in which it pushes.
    pub direction: Vec3,
    /// Radius of the ball, above 0, in the unit of the scene.
    pub radius: f32,
    /// Acceleration at the centre in cells/s^2, at most 1e6; it falls to 0 at the radius.
    pub strength: f32,
}

impl Push {
    /// Greatest strength, in cells/s^2.
    pub(super) const STRONGEST: f32 = 1e6;

    /// The acceleration of a particle at `place`, for cells of size `cell`.
    #[must_use]
    pub fn at(&self, place: Vec3, cell: f32) -> Vec3 {
        let from = (place - self.center) / self.radius;
        let fall = 1.0 - from.dot(from);
        if fall > 0.0 { self.direction * (self.strength * cell * fall) } else { Vec3::ZERO }
    }

    /// Whether it reaches into the ball about `center`.
    pub(super) fn reaches(&self, center: Vec3, radius: f32) -> bool {
        let far = self.radius + radius;
        (center - self.center).length_squared() < far * far
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_push_is_strongest_at_its_centre_and_ends_at_its_radius() {
        let push = Push { center: Vec3::X, direction: Vec3::Y, radius: 2.0, strength: 3.0 };
        assert_eq!(push.at(Vec3::X, 0.5), Vec3::new(0.0, 1.5, 0.0));
        assert_eq!(push.at(Vec3::X * 2.0, 0.5), Vec3::new(0.0, 1.125, 0.0));
        assert_eq!(push.at(Vec3::X * 3.0, 0.5), Vec3::ZERO);
        assert!(push.reaches(Vec3::X * 4.0, 1.1) && !push.reaches(Vec3::X * 4.0, 0.9));
    }
}
