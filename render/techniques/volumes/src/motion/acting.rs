//! The forces that act on one volume in a step, and the bounds of its particles.
//!
//! All volumes over one step.

use std::ops::RangeInclusive;

use glam::Vec3;
use rayon::prelude::*;

use super::forces::{KeepIn, Push, gravity, moved};
use super::settings::{MotionError, MotionSettings, in_range};
use super::step::{Scratch, advance_volume};
use super::surroundings::Surroundings;
use crate::volume::Volume;

/// Nearest and farthest that particles come to the centre, in resting radii.
pub(super) const NEAREST: f32 = 1.0 / 32.0;
pub(super) const FARTHEST: f32 = 6.0;

/// Least radius that a volume shrinks to, in cells.
const LEAST_RADIUS: f32 = 1.0 / 1024.0;

/// Width of the wall of a region before which it pushes back, in cells.
const WALL: f32 = 1.0 / 16.0;

/// Way to its place of rest, in radii, below which a particle rests; and the most that rounding,
/// which stops a slow particle early, adds to it.
const STILL: f32 = 2e-6;
const STILL_ROUNDED: f32 = 1e-5;

/// All that is the same for every volume in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Conditions<'a> {
    pub(super) settings: &'a MotionSettings,
    pub(super) surroundings: &'a Surroundings,
    /// Fingerprint of both.
    pub(super) fingerprint: u64,
    /// Number of sub-steps.
    pub(super) count: u32,
    /// Length of a sub-step in seconds.
    pub(super) seconds: f32,
}

impl Conditions<'_> {
    /// Width of the wall of a region, in the unit of the scene.
    pub(super) fn inset(&self) -> f32 {
        WALL * self.surroundings.cell
    }

    /// The lesser of the two stiffnesses that bring a particle to its place of rest.
    pub(super) fn weakest(&self) -> f32 {
        self.settings.pressure.min(self.settings.elastic)
    }

    /// Way to its place of rest, in radii, below which a particle rests.
    pub(super) fn still(&self) -> f32 {
        // Friction lets a force move a particle by h F / k_f a step, which rounding may swallow.
        let swallowed = f32::EPSILON * self.settings.friction / (self.seconds * self.weakest());
        (STILL + swallowed).min(STILL_ROUNDED)
    }
}

/// The growth of one volume in a step, and those forces of the surroundings that reach it.
#[derive(Debug, Clone)]
pub(super) struct Acting {
    /// Radius that it grows or shrinks to.
    target: f32,
    /// Radius that it does not shrink below.
    least: f32,
    /// The acceleration of all particles alike.
    pub(super) constant: Vec3,
    pub(super) pushes: Vec<Push>,
    pub(super) regions: Vec<KeepIn>,
}

impl Acting {
    /// All that moves a volume; none for one that is dry, or that rested under the same forces.
    pub(super) fn on(volume: &Volume, conditions: Conditions<'_>) -> Option<Self> {
        let Conditions { settings, surroundings, .. } = conditions;
        let least = LEAST_RADIUS * surroundings.cell;
        let target = volume.target_radius.max(least);
        let way = volume.center.distance(volume.target_center);
        let reach = FARTHEST * volume.radius.max(target) / volume.mesh().inradius + way;
        let reaches = |push: &&Push| push.reaches(volume.center, reach);
        let pushes: Vec<Push> = surroundings.pushes.iter().filter(reaches).copied().collect();
        let rests = volume.rests_under == conditions.fingerprint;
        if volume.dry || (rests && has_arrived(volume, target) && pushes.is_empty()) {
            return None;
        }
        let inset = conditions.inset();
        let regions = surroundings
            .regions
            .iter()
            .filter(|region: &&KeepIn| !region.holds_ball(volume.center, reach, inset))
            .copied()
            .collect();
        let gravity_here = settings.gravity * surroundings.cell;
        let constant = gravity(gravity_here, surroundings.down, volume.normal);
        Some(Self { target, least, constant, pushes, regions })
    }

    /// The centre and the resting radius of a volume after a sub-step from `now`.
    pub(super) fn moved(
        &self,
        now: (Vec3, f32),
        volume: &Volume,
        conditions: Conditions<'_>,
    ) -> (Vec3, f32) {
        let cell = conditions.surroundings.cell;
        let fastest = conditions.settings.fastest * cell;
        let targets = (volume.target_center, self.target);
        let (center, radius) = moved(now, targets, (fastest, cell), conditions.seconds);
        (center, radius.max(self.least))
    }

    /// Ends a step: a volume whose particles are all still, and that nothing else changes, rests
    /// under these forces.
    pub(super) fn end(&self, volume: &mut Volume, still: bool, conditions: Conditions<'_>) {
        volume.rests_under = 0;
        if still && has_arrived(volume, self.target) && self.pushes.is_empty() {
            volume.particles.velocities.iter_mut().for_each(|along| along.fill(0.0));
            volume.rests_under = conditions.fingerprint;
        }
    }
}

/// Whether a volume has its target radius, `target`, and its target centre.
fn has_arrived(volume: &Volume, target: f32) -> bool {
    volume.radius == target && volume.center == volume.target_center
}

/// Greatest number of sub-steps of one step.
const MOST_SUB_STEPS: u32 = 1000;

/// Moves all volumes by `seconds`, 0 to 1000, in as many equal sub-steps as the forces need, whose
/// number it returns: `ceil(seconds sqrt(k))`, with k the stiffness of all forces. Semi-implicit
/// Euler with implicit friction is stable while `h^2 k < 4 + 2 h k_f`; this keeps `h^2 k <= 1`.
///
/// Dry volumes do not move. Volumes that rest stay as they are until a force changes. The result
/// does not depend on the number of threads.
///
/// # Errors
/// [`MotionError::OutOfRange`] for a setting, surroundings or a time out of range,
/// [`MotionError::TooStiff`] for more than 1000 sub-steps, [`MotionError::Volume`] for a volume
/// whose centres or radii are not finite, or whose radius is not above 0. No volume has moved then.
pub fn advance(
    volumes: &mut [Volume],
    settings: &MotionSettings,
    surroundings: &Surroundings,
    seconds: f32,
) -> Result<u32, MotionError> {
    let Some(conditions) = conditions(volumes, settings, surroundings, seconds)? else {
        return Ok(0);
    };
    volumes.par_iter_mut().for_each_init(Scratch::default, |scratch, volume| {
        advance_volume(volume, conditions, scratch);
    });
    Ok(conditions.count)
}

/// The conditions of a step; none for one of 0 seconds.
///
/// # Errors
/// Those of [`advance`].
pub(super) fn conditions<'a>(
    volumes: &[Volume],
    settings: &'a MotionSettings,
    surroundings: &'a Surroundings,
    seconds: f32,
) -> Result<Option<Conditions<'a>>, MotionError> {
    settings.check()?;
    surroundings.check()?;
    in_range("seconds", seconds, 0.0, 1000.0)?;
    for (index, volume) in volumes.iter().enumerate() {
        check_volume(index, volume)?;
    }
    if seconds == 0.0 {
        return Ok(None);
    }
    let count = sub_steps(surroundings.stiffness(settings), seconds)?;
    let fingerprint = surroundings.fingerprint(settings);
    let seconds = seconds / count as f32;
    Ok(Some(Conditions { settings, surroundings, fingerprint, count, seconds }))
}

/// Number of sub-steps of a step.
fn sub_steps(stiffness: f32, seconds: f32) -> Result<u32, MotionError> {
    let needed = (seconds * stiffness.sqrt()).ceil().max(1.0);
    if needed <= MOST_SUB_STEPS as f32 {
        return Ok(needed as u32);
    }
    let most = MOST_SUB_STEPS;
    // A little less than fits, as both are rounded for the message.
    let fitting_seconds = 0.999 * most as f32 / stiffness.sqrt();
    let fitting = 0.999 * most as f32 / seconds;
    let fitting_stiffness = fitting * fitting;
    Err(MotionError::TooStiff {
        seconds,
        stiffness,
        needed,
        most,
        fitting_seconds,
        fitting_stiffness,
    })
}

fn check_volume(index: usize, volume: &Volume) -> Result<(), MotionError> {
    const FINITE: RangeInclusive<f32> = -1e15..=1e15;
    let fault = |what, value, must| Err(MotionError::Volume { index, what, value, must });
    for (what, at) in [("centre", volume.center), ("target centre", volume.target_center)] {
        let far = at.to_array().into_iter().find(|along| !FINITE.contains(along));
        if let Some(value) = far {
            return fault(what, value, "finite, at most 1e15");
        }
    }
    if !(1e-15..=1e15).contains(&volume.radius) {
        return fault("radius", volume.radius, "above 0, 1e-15 to 1e15");
    }
    if !(0.0..=1e15).contains(&volume.target_radius) {
        return fault("target radius", volume.target_radius, "0 to 1e15");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn too_stiff_forces_are_refused_with_times_and_forces_that_fit() {
        let error = sub_steps(3e6, 1.0).unwrap_err();
        let MotionError::TooStiff { fitting_seconds, fitting_stiffness, .. } = error else {
            panic!("{error}")
        };
        assert!(sub_steps(3e6, fitting_seconds).is_ok(), "{error}");
        assert!(sub_steps(fitting_stiffness, 1.0).is_ok(), "{error}");
        assert_eq!(sub_steps(800.0, 1.0 / 120.0), Ok(1));
        assert_eq!(sub_steps(800.0, 1.0), Ok(29));
    }

    #[test]
    fn a_volume_that_cannot_be_is_named() {
        let mut volumes = vec![Volume::ball(Vec3::ZERO, 1.0, 1, 1); 2];
        let settings = MotionSettings::default();
        let surroundings = Surroundings::new(1.0, 1);
        let moved = |change: fn(&mut Volume)| {
            let mut changed = volumes.clone();
            change(&mut changed[1]);
            advance(&mut changed, &settings, &surroundings, 0.01).unwrap_err().to_string()
        };
        assert!(moved(|v| v.center.y = f32::NAN).starts_with("volume 1 has centre `NaN`"));
        assert!(moved(|v| v.target_center.x = f32::NAN).contains("target centre `NaN`"));
        assert!(moved(|v| v.radius = 0.0).starts_with("volume 1 has radius `0`"));
        assert!(moved(|v| v.target_radius = -1.0).contains("target radius `-1`"));
        assert!(advance(&mut volumes, &settings, &surroundings, -1.0).is_err());
    }
}
