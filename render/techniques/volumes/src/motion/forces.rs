//! The forces on one particle, per unit of mass.

use glam::Vec3;

/// Pressure, which brings a particle to its resting radius along the ray from the centre (ten Bosch
/// 2005; the formula is ours).
#[inline(always)]
pub(super) fn pressure(stiffness: f32, resting: f32, radius: f32, outward: Vec3) -> Vec3 {
    outward * (stiffness * (resting - radius))
}

/// The elastic force, which brings a particle back to its original direction (ten Bosch 2005). It
/// acts across the ray only, so that it does not hinder growth. `deviation` is the place less the
/// resting place.
#[inline(always)]
pub(super) fn elastic(stiffness: f32, deviation: Vec3, outward: Vec3) -> Vec3 {
    (outward * deviation.dot(outward) - deviation) * stiffness
}

/// Cohesion, which makes the deviation of a particle like the mean of its neighbours' deviations.
/// `sum` is the sum over six neighbours, in which a particle with five of them counts itself;
/// `stiffness` is that of cohesion over the number of neighbours.
#[inline(always)]
pub(super) fn cohesion(stiffness: f32, deviation: Vec3, sum: Vec3) -> Vec3 {
    (sum - deviation * 6.0) * stiffness
}

/// The pull of a sample of the surface, which is `way` from the particle and less than a cell. From
/// farther than the radius it does not grow, so that it does not tear small volumes.
#[inline(always)]
pub(super) fn surface_pull(way: Vec3, stiffness: f32, radius: f32, cell: f32) -> Vec3 {
    let square = way.dot(way);
    if square >= cell * cell {
        return Vec3::ZERO;
    }
    let far = square > radius * radius;
    way * if far { stiffness * radius / square.sqrt() } else { stiffness }
}

/// Gravity along a surface of unit normal `normal`, or all of it where that is zero.
pub(super) fn gravity(acceleration: f32, down: Vec3, normal: Vec3) -> Vec3 {
    (down - normal * down.dot(normal)) * acceleration
}

/// The velocity after a step of `seconds` with friction: implicit in the friction, so that any
/// friction is stable.
#[inline(always)]
pub(super) fn velocity(before: Vec3, force: Vec3, seconds: f32, damping: f32) -> Vec3 {
    (before + force * seconds) * damping
}

/// The factor by which friction damps a step of `seconds`: 1 / (1 + h k_f).
pub(super) fn damping(friction: f32, seconds: f32) -> f32 {
    1.0 / (1.0 + seconds * friction)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elastic_and_pressure_share_a_deviation_between_them() {
        let outward = Vec3::X;
        let resting = Vec3::new(1.8, 0.6, 0.0);
        let place = Vec3::new(2.0, 0.0, 0.0);
        assert_eq!(pressure(10.0, 1.5, 2.0, outward), Vec3::new(-5.0, 0.0, 0.0));
        let pull = elastic(10.0, place - resting, outward);
        assert!(pull.abs_diff_eq(Vec3::new(0.0, 6.0, 0.0), 1e-5), "{pull}");
    }

    #[test]
    fn cohesion_counts_five_neighbours_as_well_as_six() {
        let own = Vec3::X;
        let other = Vec3::Y;
        assert_eq!(cohesion(1.0 / 6.0, own, other * 6.0), other - own);
        let five = cohesion(1.0 / 5.0, own, other * 5.0 + own);
        assert!(five.abs_diff_eq(other - own, 1e-6), "{five}");
    }

    #[test]
    fn the_surface_pulls_within_a_cell_and_small_volumes_gently() {
        let pull = |x: f32, radius: f32| surface_pull(Vec3::X * x, 50.0, radius, 1.0).x;
        assert_eq!([pull(0.25, 0.5), pull(-0.5, 0.5)], [12.5, -25.0]);
        assert_eq!([pull(0.75, 0.5), pull(-0.5, 0.125)], [25.0, -6.25]);
        assert_eq!([pull(1.0, 0.5), pull(0.0, 0.5)], [0.0, 0.0]);
    }

    #[test]
    fn gravity_runs_along_the_surface() {
        let slope = Vec3::new(0.6, 0.8, 0.0);
        let force = gravity(2.0, Vec3::NEG_Y, slope);
        assert!(force.dot(slope).abs() < 1e-6 && force.y < 0.0, "{force}");
        assert_eq!(gravity(2.0, Vec3::NEG_Y, Vec3::Y), Vec3::ZERO);
    }
}
