//! Volumes for themselves, outside of the grid.

use glam::Vec3;
use paint::layer::Cell;

use super::actions::Single;
use super::error::WorldError;
use super::recipe::amounts_of;
use super::state::{BIRTH, World};
use super::tally::add;
use crate::volume::Volume;
use crate::wetting::QUANTA_PER_FACE;

impl World {
    /// Adds a volume with as much paint of its recipe as makes a film on all surface within its
    /// radius. Returns its index.
    ///
    /// # Errors
    /// If a number is out of its range or there are too many volumes.
    pub fn add_volume(&mut self, single: &Single) -> Result<usize, WorldError> {
        let index = self.begin(single.center, single.radius, single.detail)?;
        let (normal, amount) = self.surface_within(single.center, single.radius);
        let volume = &mut self.volumes[index];
        (volume.region, volume.normal) = (single.region, normal);
        if let Some(recipe) = &single.recipe {
            volume.paint = recipe.measured(amount);
            add(&mut self.poured, amounts_of(&volume.paint));
        }
        Ok(index)
    }

    /// Mean normal of the surface within a ball, and quanta of a film on it.
    fn surface_within(&self, center: Vec3, radius: f32) -> (Vec3, u32) {
        let samples = &self.grid.samples;
        let mut normal = Vec3::ZERO;
        let mut count = 0_u32;
        for (place, own) in samples.places.iter().zip(&samples.normals) {
            if place.distance_squared(center) < radius * radius {
                normal += *own;
                count += 1;
            }
        }
        let quanta = (self.quanta_per_sample() * f64::from(count)).round();
        (normal.normalize_or_zero(), quanta.min(f64::from(paint::amount::MAX_COLUMN)) as u32)
    }

    fn quanta_per_sample(&self) -> f64 {
        let cell = f64::from(self.scale.cell);
        let area = self.grid.samples.areas.first().copied().map_or(0.0, f64::from);
        f64::from(QUANTA_PER_FACE) * area / (cell * cell)
    }

    /// Radius about `center` within which a film on all surface has `amount` quanta.
    fn radius_of_film(&self, center: Vec3, amount: u32) -> f32 {
        let places = &self.grid.samples.places;
        let mut squares: Vec<f32> =
            places.iter().map(|place| place.distance_squared(center)).collect();
        if squares.is_empty() {
            return 0.0;
        }
        let covered = f64::from(amount) / self.quanta_per_sample();
        let last = squares.len() - 1;
        let (_, nth, _) =
            squares.select_nth_unstable_by(last.min(covered as usize), f32::total_cmp);
        // Less than a sample: a disk of its area around the nearest.
        nth.sqrt() * (covered.min(1.0) as f32).sqrt()
    }

    /// Gives a single volume its paint: with more it grows, with less it shrinks to where its film
    /// reaches.
    pub(super) fn set_single_paint(&mut self, index: usize, paint: Cell) {
        let Volume { center, target_radius, .. } = self.volumes[index];
        let before = self.volumes[index].paint.volume();
        let now = paint.volume();
        let film = self.radius_of_film(center, now).max(BIRTH * self.scale.cell);
        let volume = &mut self.volumes[index];
        volume.target_radius = match now {
            0 => 0.0,
            _ if now > before => target_radius.max(film),
            _ => target_radius.min(film),
        };
        volume.paint = paint;
        volume.rests_under = 0;
    }
}
