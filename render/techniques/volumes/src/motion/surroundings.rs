//! The world around the volumes: its scale, the surface, regions to stay in, pushes.

use std::sync::Arc;

use glam::Vec3;

use super::forces::{KeepIn, Push};
use super::settings::{MotionError, MotionSettings, in_range};
use super::star::Microstructure;
use super::surface_lattice::SurfaceLattice;

/// The surroundings of all volumes at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Surroundings {
    /// Size of a cell in the unit of the scene. You give lengths in settings in cells.
    pub cell: f32,
    /// Unit vector downwards.
    pub down: Vec3,
    /// The microstructure of all surfaces.
    pub microstructure: Microstructure,
    /// Samples of the surface. They pull particles within one cell. If you pass `None`, nothing
    /// pulls.
    pub surface: Option<Arc<SurfaceLattice>>,
    /// Every volume must stay in all these regions. If its centre lies outside of one, the volume
    /// shrinks to a dot.
    pub regions: Vec<KeepIn>,
    /// The pushes at this time.
    pub pushes: Vec<Push>,
}

impl Surroundings {
    /// Empty surroundings. The y axis points upwards.
    #[must_use]
    pub fn new(cell: f32, seed: u64) -> Self {
        Self {
            cell,
            down: Vec3::NEG_Y,
            microstructure: Microstructure::of_seed(seed),
            surface: None,
            regions: Vec::new(),
            pushes: Vec::new(),
        }
    }

    /// Checks the ranges of all numbers.
    ///
    /// # Errors
    /// [`MotionError::OutOfRange`] for the first number out of range.
    pub fn check(&self) -> Result<(), MotionError> {
        /// Places and radii must be finite and leave room for their squares.
        const FARTHEST: f32 = 1e15;
        fn place(key: &'static str, place: Vec3) -> Result<(), MotionError> {
            let mut along = place.to_array().into_iter();
            along.try_for_each(|along| in_range(key, along, -FARTHEST, FARTHEST))
        }
        in_range("cell", self.cell, 1e-15, FARTHEST)?;
        place("down", self.down)?;
        for region in &self.regions {
            let mut numbers = region.numbers().into_iter();
            numbers.try_for_each(|number| in_range("keep", number, -FARTHEST, FARTHEST))?;
        }
        for push in &self.pushes {
            place("push", push.center)?;
            place("push", push.direction)?;
            in_range("push radius", push.radius, 1e-15, FARTHEST)?;
            in_range("push strength", push.strength, -Push::STRONGEST, Push::STRONGEST)?;
        }
        Ok(())
    }

    /// The stiffness of all forces together in 1/s^2.
    pub(super) fn stiffness(&self, settings: &MotionSettings) -> f32 {
        let own = settings.pressure.max(settings.elastic) + 2.0 * settings.cohesion;
        let pull = if self.surface.is_some() { settings.surface_pull } else { 0.0 };
        let keep = if self.regions.is_empty() { 0.0 } else { settings.keep };
        own + pull + keep
    }

    /// A number above 0 for all lasting forces, which are settings and surroundings without
    /// pushes. If you change a force, this number changes.
    pub(crate) fn fingerprint(&self, settings: &MotionSettings) -> u64 {
        // FNV-1a (Fowler, Noll, Vo 1991) over words.
        let mut fingerprint = 0xcbf2_9ce4_8422_2325_u64;
        let mut add = |word: u32| {
            fingerprint = (fingerprint ^ u64::from(word)).wrapping_mul(0x0100_0000_01b3);
        };
        for (_, value, ..) in settings.numbers() {
            add(value.to_bits());
        }
        for value in self.down.to_array().into_iter().chain([self.cell]) {
            add(value.to_bits());
        }
        // We add the height at one place instead of the seed, which does as well.
        add(self.microstructure.hills().at([0.3, 0.4, 0.6]).to_bits());
        for value in self.regions.iter().flat_map(KeepIn::numbers) {
            add(value.to_bits());
        }
        let [high, low] = self.surface.as_ref().map_or([0, 1], |lattice| lattice.fingerprint());
        add(high);
        add(low);
        fingerprint | 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surroundings_out_of_range_are_refused() {
        let push = Push { center: Vec3::X, direction: Vec3::Y, radius: 0.0, strength: 1.0 };
        let pushed = Surroundings { pushes: vec![push], ..Surroundings::new(1.0, 1) };
        assert!(pushed.check().unwrap_err().to_string().starts_with("push radius is"));
        let wall = KeepIn::Ball { center: Vec3::NAN, radius: 1.0 };
        let kept = Surroundings { regions: vec![wall], ..Surroundings::new(1.0, 1) };
        assert!(kept.check().is_err() && Surroundings::new(0.0, 1).check().is_err());
    }

    #[test]
    fn every_lasting_force_changes_the_fingerprint() {
        let settings = MotionSettings::default();
        let plain = Surroundings::new(1.0, 1);
        fn lattice(x: f32) -> Option<Arc<SurfaceLattice>> {
            Some(Arc::new(SurfaceLattice::of(&[Vec3::X * x], 1.0).unwrap()))
        }
        let wall = KeepIn::Ball { center: Vec3::ZERO, radius: 1.0 };
        let others = [
            plain.clone(),
            Surroundings::new(1.0, 2),
            Surroundings::new(2.0, 1),
            Surroundings { surface: lattice(1.0), ..plain.clone() },
            Surroundings { surface: lattice(2.0), ..plain.clone() },
            Surroundings { regions: vec![wall], ..plain.clone() },
        ];
        let mut prints: Vec<u64> = others.iter().map(|s| s.fingerprint(&settings)).collect();
        prints.push(plain.fingerprint(&MotionSettings { gravity: 1.0, ..settings }));
        prints.sort_unstable();
        prints.dedup();
        assert_eq!(prints.len(), 7);
    }
}
