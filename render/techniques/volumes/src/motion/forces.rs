//! The forces on one particle, per unit of mass. Also pushes (e.g. by blown air), the random
//! velocities with which volumes begin, how radius and centre follow their targets, and the regions
//! that volumes must stay in.

use glam::Vec3;
use graphics::noise::random;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::volume::Volume;

/// Pressure. It brings a particle to its resting radius along the ray from the centre (ten Bosch
/// 2005, but this formula is ours).
#[inline(always)]
pub(super) fn pressure(stiffness: f32, resting: f32, radius: f32, outward: Vec3) -> Vec3 {
    outward * (stiffness * (resting - radius))
}

/// The elastic force, which brings a particle back to its original direction (ten Bosch 2005). It
/// acts across the ray only, so that it does not hinder growth. You get the `deviation` if you
/// subtract the resting place from the place.
#[inline(always)]
pub(super) fn elastic(stiffness: f32, deviation: Vec3, outward: Vec3) -> Vec3 {
    (outward * deviation.dot(outward) - deviation) * stiffness
}

/// Cohesion, which makes the deviation of a particle like the mean of its neighbours' deviations.
/// `sum` is the sum over six neighbours. If a particle has five of them, it counts itself too.
/// `stiffness` is the stiffness of cohesion over the number of neighbours.
#[inline(always)]
pub(super) fn cohesion(stiffness: f32, deviation: Vec3, sum: Vec3) -> Vec3 {
    (sum - deviation * 6.0) * stiffness
}

/// The pull of a sample of the surface. The sample is `way` from the particle and less than a cell
/// away. Beyond the radius the pull does not grow, so that it does not tear small volumes.
#[inline(always)]
pub(super) fn surface_pull(way: Vec3, stiffness: f32, radius: f32, cell: f32) -> Vec3 {
    let square = way.dot(way);
    if square >= cell * cell {
        return Vec3::ZERO;
    }
    let far = square > radius * radius;
    way * if far { stiffness * radius / square.sqrt() } else { stiffness }
}

/// Gravity along a surface with this unit normal. If the normal is zero, this is the whole gravity.
pub(super) fn gravity(acceleration: f32, down: Vec3, normal: Vec3) -> Vec3 {
    (down - normal * down.dot(normal)) * acceleration
}

/// The velocity after a step of `seconds` with friction. We treat friction implicitly, so that any
/// friction is stable.
#[inline(always)]
pub(super) fn velocity(before: Vec3, force: Vec3, seconds: f32, damping: f32) -> Vec3 {
    (before + force * seconds) * damping
}

/// The factor by which friction damps a step of `seconds`: 1 / (1 + h k_f).
pub(super) fn damping(friction: f32, seconds: f32) -> f32 {
    1.0 / (1.0 + seconds * friction)
}

/// A push on everything inside a ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Push {
    /// Centre of the ball, in the unit of the scene.
    pub center: Vec3,
    /// Unit direction of the push.
    pub direction: Vec3,
    /// Radius of the ball, above 0, in the unit of the scene.
    pub radius: f32,
    /// Acceleration at the centre in cells/s^2, at most 1e6. It falls to 0 at the radius.
    pub strength: f32,
}

impl Push {
    pub(super) const STRONGEST: f32 = 1e6;

    /// The acceleration of a particle at `place`, for cells of size `cell`.
    #[must_use]
    pub fn at(&self, place: Vec3, cell: f32) -> Vec3 {
        let from = (place - self.center) / self.radius;
        let fall = 1.0 - from.dot(from);
        if fall > 0.0 { self.direction * (self.strength * cell * fall) } else { Vec3::ZERO }
    }

    /// Whether the push acts anywhere in the ball about `center`.
    pub(super) fn reaches(&self, center: Vec3, radius: f32) -> bool {
        let far = self.radius + radius;
        (center - self.center).length_squared() < far * far
    }
}

/// We cut normal numbers at this distance from the mean, in standard deviations.
const MOST: f32 = 3.0;

/// Adds a random velocity to every particle: normal numbers along x, y and z, cut at 3, times
/// `kick` radii per second. Call this once when the volume begins, and again wherever you pour
/// paint. Pass another `moment` for each kick of one volume.
pub fn kick(volume: &mut Volume, kick: f32, moment: u64) {
    let mut random = random(volume.seed, moment);
    let speed = kick * volume.radius;
    let [x, y, z] = &mut volume.particles.velocities;
    for ((x, y), z) in x.iter_mut().zip(y).zip(z) {
        for along in [x, y, z] {
            *along += speed * normal(&mut random);
        }
    }
    volume.rests_under = 0;
}

/// A normal number of mean 0 and deviation 1, cut at [`MOST`]. We choose it by comparisons alone,
/// so that it is the same on every machine: we keep a uniform number x with probability exp(-x^2 /
/// 2).
fn normal(random: &mut ChaCha8Rng) -> f32 {
    loop {
        let x = MOST * (2.0 * random.random::<f32>() - 1.0);
        // The exponent is at most 4.5, and `survives` takes at most 1.
        let fifth = x * x * 0.1;
        if (0..5).all(|_| survives(random, fifth)) {
            return x;
        }
    }
}

/// True with probability exp(-decay), for a decay of 0 to 1 (von Neumann 1951). In a run, each
/// uniform number is below the one before, the first below `decay`. This is true if the length of
/// the run is even.
fn survives(random: &mut ChaCha8Rng, decay: f32) -> bool {
    let mut last = decay;
    let mut even = true;
    loop {
        let next = random.random::<f32>();
        if next >= last {
            return even;
        }
        (last, even) = (next, !even);
    }
}

/// The radius takes about this time to come near to its target, in seconds.
const DELAY: f32 = 0.15;

/// The radius jumps to the target from this share of the target on, once rounding stops its
/// growth. The centre does so at this share of the radius.
const NEAR: f32 = 1e-4;

/// The radius after `seconds`. It goes to its `target` at the speed `(target - radius) / 0.15 s`,
/// at most `fastest` (per second). Implicit Euler never goes past the target.
pub(super) fn grown(radius: f32, target: f32, fastest: f32, seconds: f32) -> f32 {
    let missing = target - radius;
    let most = fastest * seconds;
    let next = radius + (missing * (seconds / (DELAY + seconds))).clamp(-most, most);
    if next == radius && missing.abs() <= NEAR * target { target } else { next }
}

/// Greatest speed of the centre of a small volume, relative to the speed of its growth. This keeps
/// dents of the skin from baring the place where the volume began.
const KEEPING: f32 = 0.6;

/// Centre and radius after `seconds`. Both go to their targets as in [`grown`]. No place of the
/// skin gets ahead faster than `fastest`. If a volume is small beside a `cell`, its centre moves
/// more slowly than it grows, so that it keeps what it held.
pub(super) fn moved(
    (center, radius): (Vec3, f32),
    (target_center, target): (Vec3, f32),
    (fastest, cell): (f32, f32),
    seconds: f32,
) -> (Vec3, f32) {
    let next = grown(radius, target, fastest, seconds);
    let way = target_center - center;
    let distance = way.length();
    if distance <= NEAR * next {
        return (target_center, next);
    }
    let growth = (next - radius).max(0.0);
    let free = if next == target { 1.0 } else { (radius / cell) * (radius / cell) };
    let step = distance * (seconds / (DELAY + seconds));
    let step = step.min(KEEPING * growth + step * free);
    let share = (fastest * seconds / (step + growth)).min(1.0);
    let next = if growth > 0.0 { radius + growth * share } else { next };
    let moved = center + way * (step * share / distance);
    (if moved == center { target_center } else { moved }, next)
}

/// A convex region that holds every volume. Its walls push particles back, and no particle passes
/// them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KeepIn {
    /// A box along the axes.
    Box {
        /// Its least corner.
        low: Vec3,
        /// Its greatest corner.
        high: Vec3,
    },
    /// The inside of a ball.
    Ball {
        /// Centre in the unit of the scene.
        center: Vec3,
        /// Radius, above 0, in the unit of the scene.
        radius: f32,
    },
    /// The half of space above a plane.
    Above {
        /// A point of the plane.
        point: Vec3,
        /// The unit normal of the plane. It points into the region.
        normal: Vec3,
    },
}

impl KeepIn {
    /// The way from `place` to the nearest point that is at least `inset` inside. It is zero if
    /// `place` already is.
    #[must_use]
    pub fn way_back(&self, place: Vec3, inset: f32) -> Vec3 {
        match *self {
            Self::Box { low, high } => {
                let middle = (low + high) * 0.5;
                let low = (low + inset).min(middle);
                let high = (high - inset).max(middle);
                place.max(low).min(high) - place
            }
            Self::Ball { center, radius } => {
                let from = place - center;
                let distance = from.dot(from).sqrt();
                let most = (radius - inset).max(0.0);
                if distance > most { from * (most / distance - 1.0) } else { Vec3::ZERO }
            }
            Self::Above { point, normal } => {
                normal * (inset - (place - point).dot(normal)).max(0.0)
            }
        }
    }

    /// The greatest share, 0 to 1, of the way from `center` to `center + offset` that lies inside.
    /// If `center` lies outside, this is 0.
    #[must_use]
    pub fn share_inside(&self, center: Vec3, offset: Vec3) -> f32 {
        match *self {
            Self::Box { low, high } => {
                let mut share = 1.0;
                for axis in 0..3 {
                    let rise = high[axis] - center[axis];
                    let fall = center[axis] - low[axis];
                    share = within(rise, offset[axis], share);
                    share = within(fall, -offset[axis], share);
                }
                share
            }
            Self::Ball { center: middle, radius } => {
                let from = center - middle;
                let room = radius * radius - from.dot(from);
                let square = offset.dot(offset);
                let along = from.dot(offset);
                if room <= 0.0 {
                    return 0.0;
                }
                if square + 2.0 * along <= room {
                    return 1.0;
                }
                // This takes the positive root of `square t^2 + 2 along t = room` without
                // cancellation.
                let root = (along * along + square * room).sqrt();
                if along > 0.0 { room / (along + root) } else { (root - along) / square }
            }
            Self::Above { point, normal } => {
                within((center - point).dot(normal), -offset.dot(normal), 1.0)
            }
        }
    }

    /// Whether the whole ball about `center` lies at least `inset` inside.
    pub(super) fn holds_ball(&self, center: Vec3, radius: f32, inset: f32) -> bool {
        let far = radius + inset;
        match *self {
            Self::Box { low, high } => {
                (center - low).cmpge(Vec3::splat(far)).all()
                    && (high - center).cmpge(Vec3::splat(far)).all()
            }
            Self::Ball { center: middle, radius } => {
                (center - middle).length_squared().sqrt() + far <= radius
            }
            Self::Above { point, normal } => (center - point).dot(normal) >= far,
        }
    }

    /// The shape as numbers. Different regions have different numbers.
    pub(super) fn numbers(&self) -> [f32; 7] {
        let (kind, [a, b, c], [d, e, f]) = match *self {
            Self::Box { low, high } => (0.0, low.to_array(), high.to_array()),
            Self::Ball { center, radius } => (1.0, center.to_array(), [radius, 0.0, 0.0]),
            Self::Above { point, normal } => (2.0, point.to_array(), normal.to_array()),
        };
        [kind, a, b, c, d, e, f]
    }
}

/// The share of a path towards a wall that `room`, the distance to the wall, allows. The path has
/// this `length`. You get at most `share`.
fn within(room: f32, length: f32, share: f32) -> f32 {
    if room <= 0.0 {
        0.0
    } else if length * share > room {
        room / length
    } else {
        share
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

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
        fn pull(x: f32, radius: f32) -> f32 {
            surface_pull(Vec3::X * x, 50.0, radius, 1.0).x
        }
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

    #[test]
    fn a_push_is_strongest_at_its_centre_and_ends_at_its_radius() {
        let push = Push { center: Vec3::X, direction: Vec3::Y, radius: 2.0, strength: 3.0 };
        assert_eq!(push.at(Vec3::X, 0.5), Vec3::new(0.0, 1.5, 0.0));
        assert_eq!(push.at(Vec3::X * 2.0, 0.5), Vec3::new(0.0, 1.125, 0.0));
        assert_eq!(push.at(Vec3::X * 3.0, 0.5), Vec3::ZERO);
        assert!(push.reaches(Vec3::X * 4.0, 1.1) && !push.reaches(Vec3::X * 4.0, 0.9));
    }

    #[test]
    fn normal_numbers_have_the_moments_of_a_cut_normal_distribution() {
        let mut random = random(7, 0);
        let numbers: Vec<f64> = (0..200_000).map(|_| normal(&mut random).into()).collect();
        let [first, second, third, fourth] = [1, 2, 3, 4]
            .map(|power: i32| numbers.iter().map(|x: &f64| x.powi(power)).sum::<f64>() / 200_000.0);
        // Moments between -3 and 3: 1 - 2 3 phi(3) / 0.9973 = 0.97334, and 3 times this, less 2 27
        // phi(3) / 0.9973, is 2.68005.
        assert!(first.abs() < 0.01 && third.abs() < 0.03, "{first} {third}");
        assert!((second - 0.97334).abs() < 0.01 && (fourth - 2.68005).abs() < 0.06, "{fourth}");
        assert!(numbers.iter().all(|x| x.abs() <= 3.0));
    }

    #[test]
    fn kicks_of_one_volume_differ_by_moment_only() {
        fn kicked(moment: u64) -> Volume {
            let mut ball = Volume::ball(Vec3::ZERO, 2.0, 2, 5);
            kick(&mut ball, 0.3, moment);
            ball
        }
        assert_eq!(kicked(1), kicked(1));
        assert_ne!(kicked(1), kicked(2));
        let squares = kicked(1).particles.velocities.concat().iter().map(|v| v * v).sum::<f32>();
        assert!(((squares / 486.0).sqrt() - 0.6).abs() < 0.06, "{squares}");
    }

    fn after(seconds: f32, step: f32, target: f32, fastest: f32) -> f32 {
        let steps = (seconds / step).round() as usize;
        (0..steps).fold(1.0, |radius, _| grown(radius, target, fastest, step))
    }

    #[test]
    fn a_radius_comes_to_its_target_and_stays() {
        // exp(-0.3 / 0.15) of the way is left. The implicit form lags by a third of a step in ten.
        let left = 2.0 - after(0.3, 1e-3, 2.0, 100.0);
        assert!((left - (-2.0_f32).exp()).abs() < 2e-3, "{left}");
        assert_eq!(after(4.0, 1.0 / 120.0, 2.0, 100.0), 2.0);
        assert_eq!(after(4.0, 1.0 / 120.0, 0.5, 100.0), 0.5);
    }

    #[test]
    fn growth_is_no_faster_than_allowed() {
        assert!((after(1.0, 1.0 / 120.0, 9.0, 0.25) - 1.25).abs() < 1e-4);
        assert!((after(1.0, 1.0 / 120.0, 0.0, 0.25) - 0.75).abs() < 1e-4);
    }

    #[test]
    fn the_skin_gets_ahead_no_faster_than_allowed() {
        let targets = (Vec3::new(1.6, 0.3, -0.7), 1.5);
        let mut center = Vec3::X;
        let mut radius = 0.1;
        let ahead = targets.0 - center;
        let mut tip = radius;
        for _ in 0..2400 {
            (center, radius) = moved((center, radius), targets, (0.5, 1.0), 1.0 / 120.0);
            let next = radius + (center - Vec3::X).dot(ahead) / ahead.length();
            // At last the centre takes on its target.
            let most = 0.5 / 120.0 + NEAR * radius;
            assert!((-1e-6..most).contains(&(next - tip)), "{next} after {tip}");
            tip = next;
            if radius < 0.3 {
                assert!(center.distance(Vec3::X) < 0.85 * radius, "{center} {radius}");
            }
        }
        assert_eq!((center, radius), targets);
        // Without a way to go the radius grows as for itself.
        let alone = moved((Vec3::X, 0.1), (Vec3::X, 1.5), (0.5, 1.0), 0.1);
        assert_eq!(alone, (Vec3::X, grown(0.1, 1.5, 0.5, 0.1)));
    }

    #[test]
    fn a_long_step_does_not_go_past_the_target() {
        let radius = grown(1.0, 2.0, 1e3, 10.0);
        assert!((1.9..2.0).contains(&radius), "{radius}");
    }

    fn regions() -> [KeepIn; 3] {
        [
            KeepIn::Box { low: Vec3::splat(-1.0), high: Vec3::new(1.0, 2.0, 3.0) },
            KeepIn::Ball { center: Vec3::new(0.2, 0.1, 0.0), radius: 1.5 },
            KeepIn::Above { point: Vec3::new(0.0, -0.5, 0.0), normal: Vec3::new(0.6, 0.8, 0.0) },
        ]
    }

    #[test]
    fn the_share_inside_ends_at_the_wall() {
        let center = Vec3::new(0.3, 0.2, -0.1);
        for region in regions() {
            for offset in [Vec3::new(-3.0, -4.0, 1.0), Vec3::new(-0.1, 0.1, 0.0), Vec3::NEG_Y * 9.0]
            {
                let share = region.share_inside(center, offset);
                let end = center + offset * share;
                assert!(region.way_back(end, 0.0).length() < 1e-5, "{region:?} {offset}");
                let further = center + offset * (share * 1.01);
                assert!(
                    share == 1.0 || region.way_back(further, 0.0).length() > 1e-4,
                    "{region:?}"
                );
            }
            assert_eq!(region.share_inside(Vec3::new(-9.0, -9.0, 0.0), Vec3::X), 0.0);
        }
    }

    #[test]
    fn the_way_back_leads_inside_and_no_farther() {
        for region in regions() {
            let place = Vec3::new(-4.0, -3.0, 0.5);
            let back = place + region.way_back(place, 0.25);
            assert!(region.way_back(back, 0.2499).length() < 1e-6, "{region:?}");
            assert!(region.way_back(back, 0.26).length() > 0.005, "{region:?}");
            assert!(region.holds_ball(Vec3::new(0.2, 0.4, 0.0), 0.3, 0.1), "{region:?}");
            assert!(!region.holds_ball(Vec3::new(0.2, 0.4, 0.0), 2.0, 0.1), "{region:?}");
        }
    }
}
