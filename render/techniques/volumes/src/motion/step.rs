//! Moves all volumes over one step, and each of them over its sub-steps. Also the forces that act
//! on one volume in a step, and the bounds of its particles.

use std::ops::RangeInclusive;

use glam::Vec3;
use rayon::prelude::*;

use super::forces::{
    KeepIn, Push, cohesion, damping, elastic, gravity, moved, pressure, surface_pull, velocity,
};
use super::settings::{MotionError, MotionSettings, in_range};
use super::star::{Corner, RestingRadii, is_star, mend};
use super::surroundings::Surroundings;
use crate::volume::{Particles, SphereMesh, Volume};

/// Memory for the steps of volumes. You can use it for one volume after another.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    resting: Vec<f32>,
    deviations: Vec<[f32; 4]>,
    forces: [Vec<f32>; 3],
    distances: Vec<f32>,
    corners: Vec<Corner>,
}

impl Scratch {
    fn fit(&mut self, count: usize) {
        self.resting.resize(count, 0.0);
        self.deviations.resize(count, [0.0; 4]);
        self.forces.iter_mut().for_each(|along| along.resize(count, 0.0));
        self.distances.resize(count, 0.0);
        self.corners.resize(count, [0.0; 4]);
    }
}

/// Moves one volume over all sub-steps. If a volume rested under the same forces, it stays as it
/// is.
pub(super) fn advance_volume(volume: &mut Volume, conditions: Conditions, scratch: &mut Scratch) {
    let Some(acting) = Acting::on(volume, conditions) else { return };
    let mesh = SphereMesh::of_detail(volume.detail);
    scratch.fit(mesh.directions.len());
    volume.particles.samples.resize(mesh.directions.len(), u32::MAX);
    let mut resting_radii = RestingRadii::new(
        conditions.surroundings.microstructure,
        conditions.settings,
        conditions.surroundings.cell,
        volume.center.to_array(),
        mesh.inradius,
    );
    let mut still = false;
    for _ in 0..conditions.count {
        (volume.center, volume.radius) =
            acting.moved((volume.center, volume.radius), volume, conditions);
        (resting_radii.center, resting_radii.radius) = (volume.center.to_array(), volume.radius);
        let step = SubStep {
            conditions,
            mesh,
            resting_radii,
            center: volume.center,
            constant: acting.constant,
            pushes: &acting.pushes,
            regions: &acting.regions,
            particles: &mut volume.particles,
            scratch,
        };
        still = graphics::lanes::vectorized(step);
        if !acting.regions.is_empty() {
            let least = NEAREST * volume.radius;
            keep_inside(&acting.regions, volume.center, least, &mut volume.particles);
        }
    }
    acting.end(volume, still, conditions);
}

struct SubStep<'a> {
    conditions: Conditions<'a>,
    mesh: &'a SphereMesh,
    resting_radii: RestingRadii,
    center: Vec3,
    constant: Vec3,
    pushes: &'a [Push],
    regions: &'a [KeepIn],
    particles: &'a mut Particles,
    scratch: &'a mut Scratch,
}

impl pulp::WithSimd for SubStep<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(mut self, _: S) -> bool {
        let axes = self.mesh.axes.each_ref().map(Vec::as_slice);
        self.resting_radii.write(axes, &mut self.scratch.resting);
        self.deviate();
        self.cohere();
        self.press();
        let still = self.integrate();
        self.set_corners();
        if is_star(self.mesh, &self.scratch.corners) {
            return still;
        }
        let velocities = self.particles.velocities.each_mut().map(Vec::as_mut_slice);
        mend(self.mesh, &mut self.scratch.corners, velocities);
        for (axis, along) in self.particles.places.iter_mut().enumerate() {
            for (place, corner) in along.iter_mut().zip(&self.scratch.corners) {
                *place = corner[axis];
            }
        }
        false
    }
}

impl SubStep<'_> {
    #[inline(always)]
    fn deviate(&mut self) {
        let count = self.scratch.resting.len();
        let places = self.particles.places.each_ref().map(|along| &along[..count]);
        let axes = self.mesh.axes.each_ref().map(|along| &along[..count]);
        let resting = &self.scratch.resting[..count];
        let deviations = &mut self.scratch.deviations[..count];
        for i in 0..count {
            let [x, y, z] = [0, 1, 2].map(|axis| places[axis][i] - resting[i] * axes[axis][i]);
            deviations[i] = [x, y, z, 0.0];
        }
    }

    #[inline(always)]
    fn cohere(&mut self) {
        let count = self.scratch.resting.len();
        let deviations = &self.scratch.deviations[..count];
        let [x, y, z] = self.scratch.forces.each_mut().map(|along| &mut along[..count]);
        let neighbours = &self.mesh.neighbours[..count];
        let stiffness = self.conditions.settings.cohesion;
        for i in 0..count {
            let sum = neighbours[i].iter().fold([0.0; 4], |sum: [f32; 4], &other| {
                let other = deviations[other as usize];
                [0, 1, 2, 3].map(|axis| sum[axis] + other[axis])
            });
            // The first 12 vertices have only five neighbours.
            let stiffness = stiffness / if i < 12 { 5.0 } else { 6.0 };
            let own = Vec3::from_slice(&deviations[i]);
            let force = cohesion(stiffness, own, Vec3::from_slice(&sum));
            [x[i], y[i], z[i]] = force.to_array();
        }
    }

    #[inline(always)]
    fn press(&mut self) {
        let Conditions { settings, surroundings, .. } = self.conditions;
        let pull = settings.surface_pull;
        let surface = surroundings.surface.as_deref().filter(|_| pull > 0.0);
        let cell = surroundings.cell;
        let inset = self.conditions.inset();
        let radius = self.resting_radii.radius;
        if surface.is_none() && self.pushes.is_empty() && self.regions.is_empty() {
            return;
        }
        let count = self.scratch.resting.len();
        let places = self.particles.places.each_ref().map(|along| &along[..count]);
        let samples = &mut self.particles.samples[..count];
        let forces = self.scratch.forces.each_mut().map(|along| &mut along[..count]);
        for i in 0..count {
            let from_center = Vec3::new(places[0][i], places[1][i], places[2][i]);
            let place = self.center + from_center;
            let mut force = Vec3::ZERO;
            if let Some(surface) = surface {
                let (index, sample) = surface.pulling(place, samples[i]);
                samples[i] = index;
                // We go from the centre, because places in the scene are too coarse for small
                // volumes.
                let way = sample.map_or(Vec3::ZERO, |at| (at - self.center) - from_center);
                force += surface_pull(way, pull, radius, cell);
            }
            for push in self.pushes {
                force += push.at(place, cell);
            }
            for region in self.regions {
                force += region.way_back(place, inset) * settings.keep;
            }
            for axis in 0..3 {
                forces[axis][i] += force[axis];
            }
        }
    }

    /// Moves all particles and writes their distances. Returns whether all of them are still.
    #[inline(always)]
    fn integrate(&mut self) -> bool {
        let Conditions { settings, seconds, .. } = self.conditions;
        let damping = damping(settings.friction, seconds);
        let count = self.scratch.resting.len();
        let [px, py, pz] = self.particles.places.each_mut().map(|along| &mut along[..count]);
        let [vx, vy, vz] = self.particles.velocities.each_mut().map(|along| &mut along[..count]);
        let [ux, uy, uz] = self.mesh.axes.each_ref().map(|along| &along[..count]);
        let [fx, fy, fz] = self.scratch.forces.each_ref().map(|along| &along[..count]);
        let resting = &self.scratch.resting[..count];
        let distances = &mut self.scratch.distances[..count];
        let radius = self.resting_radii.radius * self.resting_radii.scale;
        let nearest = NEAREST * radius;
        let farthest = FARTHEST * radius;
        let weakest = self.conditions.weakest();
        let still = self.conditions.still() * radius;
        let most_force = (weakest * still) * (weakest * still);
        let most_speed = weakest * still * still;
        let mut moving = 0_u32;
        for i in 0..count {
            let place = Vec3::new(px[i], py[i], pz[i]);
            let before = Vec3::new(vx[i], vy[i], vz[i]);
            let at_rest = Vec3::new(ux[i], uy[i], uz[i]) * resting[i];
            let distance = place.dot(place).sqrt();
            let outward = place * (1.0 / distance);
            let force = Vec3::new(fx[i], fy[i], fz[i])
                + self.constant
                + pressure(settings.pressure, resting[i], distance, outward)
                + elastic(settings.elastic, place - at_rest, outward);
            let speed = velocity(before, force, seconds, damping);
            let after = place + speed * seconds;
            let quiet = force.dot(force) <= most_force && speed.dot(speed) <= most_speed;
            moving |= u32::from(!quiet);
            let (after, speed, distance) = bounded(after, speed, nearest, farthest, at_rest);
            [px[i], py[i], pz[i]] = after.to_array();
            [vx[i], vy[i], vz[i]] = speed.to_array();
            distances[i] = distance;
        }
        moving == 0
    }

    #[inline(always)]
    fn set_corners(&mut self) {
        let count = self.scratch.distances.len();
        let [x, y, z] = self.particles.places.each_ref().map(|along| &along[..count]);
        let distances = &self.scratch.distances[..count];
        let corners = &mut self.scratch.corners[..count];
        for i in 0..count {
            corners[i] = [x[i], y[i], z[i], distances[i]];
        }
    }
}

/// Brings a place and velocity to between `nearest` and `farthest` from the centre, and returns
/// this distance too. If a place is not a number or has no direction, it goes to its place of
/// rest.
#[inline(always)]
fn bounded(
    place: Vec3,
    velocity: Vec3,
    nearest: f32,
    farthest: f32,
    at_rest: Vec3,
) -> (Vec3, Vec3, f32) {
    let distance = place.dot(place).sqrt();
    let is_inside = distance >= nearest && distance <= farthest;
    let is_sane = distance > f32::MIN_POSITIVE && distance < f32::MAX;
    let to = if distance < nearest { nearest } else { farthest };
    let scale = if is_inside { 1.0 } else { to / distance };
    let outward = place * (1.0 / distance);
    let along = if is_inside { 0.0 } else { velocity.dot(outward) };
    let scaled = place * scale;
    let slowed = velocity - outward * along;
    let rest = at_rest.dot(at_rest).sqrt();
    let choose = |sane: f32, other: f32| if is_sane { sane } else { other };
    let place = Vec3::new(
        choose(scaled.x, at_rest.x),
        choose(scaled.y, at_rest.y),
        choose(scaled.z, at_rest.z),
    );
    let velocity = Vec3::new(choose(slowed.x, 0.0), choose(slowed.y, 0.0), choose(slowed.z, 0.0));
    let bounded = if is_inside { distance } else { to };
    (place, velocity, choose(bounded, rest))
}

/// Brings particles that passed a wall back to it, and takes their outward velocity. They go along
/// the ray to the centre, so that cones stay as they are.
fn keep_inside(regions: &[KeepIn], center: Vec3, least: f32, particles: &mut Particles) {
    let [px, py, pz] = &mut particles.places;
    let [vx, vy, vz] = &mut particles.velocities;
    for i in 0..px.len() {
        let place = Vec3::new(px[i], py[i], pz[i]);
        let share = regions
            .iter()
            .map(|region| region.share_inside(center, place))
            .fold(1.0, |least, share| if share < least { share } else { least });
        if share >= 1.0 {
            continue;
        }
        let distance = place.dot(place).sqrt();
        // We stay a little inside of the wall, so that rounding does not pass it.
        let to = (distance * share * (1.0 - 1e-5)).max(least / 1024.0);
        let outward = place * (1.0 / distance);
        let velocity = Vec3::new(vx[i], vy[i], vz[i]);
        let velocity = velocity - outward * velocity.dot(outward).max(0.0);
        [px[i], py[i], pz[i]] = (outward * to).to_array();
        [vx[i], vy[i], vz[i]] = velocity.to_array();
    }
}

/// Least and greatest distance of particles from the centre, in resting radii.
pub(super) const NEAREST: f32 = 1.0 / 32.0;
pub(super) const FARTHEST: f32 = 6.0;

/// A volume shrinks down to this radius, in cells.
const LEAST_RADIUS: f32 = 1.0 / 1024.0;

/// A region's wall pushes back within this width, in cells.
const WALL: f32 = 1.0 / 16.0;

/// A particle rests if its way to its place of rest, in radii, is below this. Rounding stops a
/// slow particle early and adds at most as much again.
const STILL: f32 = 2e-6;
const STILL_ROUNDED: f32 = 1e-5;

#[derive(Debug, Clone, Copy)]
pub(super) struct Conditions<'a> {
    pub(super) settings: &'a MotionSettings,
    pub(super) surroundings: &'a Surroundings,
    pub(super) fingerprint: u64,
    pub(super) count: u32,
    pub(super) seconds: f32,
}

impl Conditions<'_> {
    pub(super) fn inset(&self) -> f32 {
        WALL * self.surroundings.cell
    }

    /// The lesser of the two stiffnesses that bring a particle to its place of rest.
    pub(super) fn weakest(&self) -> f32 {
        self.settings.pressure.min(self.settings.elastic)
    }

    /// A particle rests if its way to its place of rest, in radii, is below this.
    pub(super) fn still(&self) -> f32 {
        // Friction lets a force move a particle by h F / k_f per step, which rounding may swallow.
        let swallowed = f32::EPSILON * self.settings.friction / (self.seconds * self.weakest());
        (STILL + swallowed).min(STILL_ROUNDED)
    }
}

/// The growth of one volume in a step, and the forces of the surroundings that reach it.
#[derive(Debug, Clone)]
pub(super) struct Acting {
    target: f32,
    least: f32,
    pub(super) constant: Vec3,
    pub(super) pushes: Vec<Push>,
    pub(super) regions: Vec<KeepIn>,
}

impl Acting {
    /// Collects what moves a volume in this step. `None` if the volume is dry, or came to rest
    /// under the same forces.
    pub(super) fn on(volume: &Volume, conditions: Conditions<'_>) -> Option<Self> {
        let Conditions { settings, surroundings, .. } = conditions;
        let least = LEAST_RADIUS * surroundings.cell;
        let target = volume.target_radius.max(least);
        let way = volume.center.distance(volume.target_center);
        let reach = FARTHEST * volume.radius.max(target) / volume.mesh().inradius + way;
        let pushes: Vec<Push> = surroundings
            .pushes
            .iter()
            .filter(|push: &&Push| push.reaches(volume.center, reach))
            .copied()
            .collect();
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

    /// Ends a step. A volume rests under these forces if all its particles are still and nothing
    /// else changes.
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

const MOST_SUB_STEPS: u32 = 1000;

/// Moves all volumes by `seconds`, 0 to 1000. The forces decide how many equal sub-steps we need,
/// and you get this number: `ceil(seconds sqrt(k))`, with k the stiffness of all forces.
/// Semi-implicit Euler with implicit friction is stable while `h^2 k < 4 + 2 h k_f`. We keep `h^2
/// k <= 1`.
///
/// Dry volumes do not move. If a volume rests, it stays as it is until a force changes. The result
/// does not depend on the number of threads.
///
/// # Errors
/// [`MotionError::OutOfRange`] for a setting, surroundings or a time out of range,
/// [`MotionError::TooStiff`] for more than 1000 sub-steps, [`MotionError::Volume`] for a volume if
/// its centres or radii are not finite, or its radius is not above 0. No volume has moved then.
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

/// The conditions of a step. `None` for a step of 0 seconds.
///
/// # Errors
/// This fails like [`advance`].
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

fn sub_steps(stiffness: f32, seconds: f32) -> Result<u32, MotionError> {
    let needed = (seconds * stiffness.sqrt()).ceil().max(1.0);
    if needed <= MOST_SUB_STEPS as f32 {
        return Ok(needed as u32);
    }
    let most = MOST_SUB_STEPS;
    // This is a little less than fits, because we round both for the message.
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
