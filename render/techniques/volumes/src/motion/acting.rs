//! The forces that act on one volume in a step, and the bounds of its particles.

use glam::Vec3;

use super::forces::gravity;
use super::growth::moved;
use super::keep_in::KeepIn;
use super::push::Push;
use super::settings::MotionSettings;
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
