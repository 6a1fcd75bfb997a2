//! Paint that dries.

use glam::Vec3;

use super::error::{WorldError, in_range};
use super::state::{NONE, World};
use crate::containing::Inside;

/// Share of a volume's surface below the dryer from which on the whole volume dries.
const SHARE: f32 = 0.5;

impl World {
    /// Dries all paint on the scene: from now on its shape and its amounts are frozen. Wet paint
    /// poured later lies over it, in volumes of its own.
    pub fn dry(&mut self) {
        self.volumes.iter_mut().for_each(|volume| volume.dry = true);
        self.of_cell.fill(NONE);
        self.settled = false;
    }

    /// Dries the volumes that hold a place, in the unit of the scene, and those with half of the
    /// surface below their paint within `radius` of it, as [`World::dry`] does. Wet paint beside
    /// them flows on, also over them. Returns how many dried.
    ///
    /// # Errors
    /// If the radius or a coordinate of the place is out of its range.
    pub fn dry_within(&mut self, place: Vec3, radius: f32) -> Result<usize, WorldError> {
        in_range("radius", radius.into(), [1e-15, 1e15], "above 0")?;
        for along in place.to_array() {
            in_range("at", along.into(), [-1e15, 1e15], "finite")?;
        }
        let mut dried = 0;
        for index in 0..self.volumes.len() {
            if self.volumes[index].dry || !self.is_below(index, place, radius) {
                continue;
            }
            let volume = &mut self.volumes[index];
            volume.dry = true;
            if let Some(cell) = volume.cell {
                self.of_cell[cell as usize] = NONE;
            }
            dried += 1;
        }
        self.settled &= dried == 0;
        Ok(dried)
    }

    /// Whether a dryer at `place` dries a volume.
    fn is_below(&self, index: usize, place: Vec3, radius: f32) -> bool {
        let volume = &self.volumes[index];
        let reach = volume.radius.max(2.0 * self.scale.cell);
        if volume.center.distance(place) > radius + reach {
            return false;
        }
        let share = self.share_below(index, |at| at.distance(place) < radius);
        share >= SHARE || Inside::of(volume).holds(place)
    }
}
