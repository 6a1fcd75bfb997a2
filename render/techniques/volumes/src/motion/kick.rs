//! The random velocities that volumes are born with.

use graphics::noise::random;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::volume::Volume;

/// Distance from the mean at which normal numbers are cut, in standard deviations.
const MOST: f32 = 3.0;

/// Adds a random velocity to every particle: normal numbers along x, y and z, cut at 3, times `kick`
/// radii a second. To be called once at birth, and again wherever paint is poured; `moment` tells
/// the kicks of one volume apart.
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

/// A normal number of mean 0 and deviation 1, cut at [`MOST`]. Chosen by comparisons alone, so that
/// it is the same on every machine: a uniform number x is kept with probability exp(-x^2 / 2).
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

/// True with probability exp(-decay), for a decay of 0 to 1 (von Neumann 1951): the length of the
/// run in which each uniform number is below the one before, the first below `decay`, is even.
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

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn normal_numbers_have_the_moments_of_a_cut_normal_distribution() {
        let mut random = random(7, 0);
        let numbers: Vec<f64> = (0..200_000).map(|_| normal(&mut random).into()).collect();
        let mean = |power: i32| numbers.iter().map(|x| x.powi(power)).sum::<f64>() / 200_000.0;
        // Moments between -3 and 3: 1 - 2 3 phi(3) / 0.9973 = 0.97334, and 3 of that less
        // 2 27 phi(3) / 0.9973 = 2.68005.
        assert!(mean(1).abs() < 0.01 && mean(3).abs() < 0.03, "{} {}", mean(1), mean(3));
        assert!(
            (mean(2) - 0.97334).abs() < 0.01 && (mean(4) - 2.68005).abs() < 0.06,
            "{}",
            mean(4)
        );
        assert!(numbers.iter().all(|x| x.abs() <= 3.0));
    }

    #[test]
    fn kicks_of_one_volume_differ_by_moment_only() {
        let kicked = |moment| {
            let mut ball = Volume::ball(Vec3::ZERO, 2.0, 2, 5);
            kick(&mut ball, 0.3, moment);
            ball
        };
        assert_eq!(kicked(1), kicked(1));
        assert_ne!(kicked(1), kicked(2));
        let squares = kicked(1).particles.velocities.concat().iter().map(|v| v * v).sum::<f32>();
        assert!(((squares / 486.0).sqrt() - 0.6).abs() < 0.06, "{squares}");
    }
}
