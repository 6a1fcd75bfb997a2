//! A single volume, split into volumes of the grid.

use paint::layer::SLOTS;

use super::error::WorldError;
use super::recipe::{amounts_of, as_cell, fitting};
use super::state::World;
use crate::containing::Inside;

impl World {
    /// Splits a single volume: its paint is dealt to the cells that its inside samples of the
    /// surface lie in, by area, in whole quanta, with the remainder to the first cell. The volume
    /// vanishes; only what cells have no room for stays in it. Returns the number of cells.
    ///
    /// # Errors
    /// If there is no such volume, it is dry or of the grid, it holds no surface, there is no
    /// grid, or there are too many volumes.
    pub fn split(&mut self, index: usize) -> Result<usize, WorldError> {
        let count = self.volumes.len();
        let refused = |why| Err(WorldError::Volume { index, count, why });
        let Some(volume) = self.volumes.get(index) else { return refused("does not exist") };
        if volume.cell.is_some() || volume.dry {
            return refused("is dry or of the grid already");
        }
        if self.settings.cell == 0.0 {
            return refused("cannot be split without a grid");
        }
        let region = volume.region;
        let center = volume.center;
        let paint = volume.paint;
        let parts = self.held_samples(index);
        let all: u64 = parts.iter().map(|(_, samples)| samples).sum();
        if all == 0 {
            return refused("holds no surface");
        }
        let whole = amounts_of(&paint);
        let share = |samples: u64| whole.map(|amount| amount * samples / all);
        let mut dealt: Vec<[u64; SLOTS + 1]> = parts.iter().map(|part| share(part.1)).collect();
        for slot in 0..=SLOTS {
            dealt[0][slot] += whole[slot] - dealt.iter().map(|amounts| amounts[slot]).sum::<u64>();
        }
        let mut left = [0; SLOTS + 1];
        for (&(cell, _), amounts) in parts.iter().zip(dealt) {
            // A volume begins at the surface of its cell nearest to the centre of the whole.
            let own = &self.grid.samples.places[self.grid.samples.of_cell(cell)];
            let nearest = own
                .iter()
                .min_by(|a, b| a.distance_squared(center).total_cmp(&b.distance_squared(center)));
            let place = nearest.copied().unwrap_or(center);
            let taker = self.volume_in(cell, place, region)?;
            let before = self.volumes[taker].paint;
            let room = self.grid.cells.room(cell).saturating_sub(before.volume());
            let taken = fitting(amounts, room);
            self.set_paint(taker, before.plus(&as_cell(taken)));
            for slot in 0..=SLOTS {
                left[slot] += amounts[slot] - taken[slot];
            }
            // Whatever happens next, no paint is there twice.
            let rest = amounts_of(&self.volumes[index].paint);
            self.volumes[index].paint = as_cell(std::array::from_fn(|i| rest[i] - taken[i]));
        }
        self.set_single_paint(index, as_cell(left));
        Ok(parts.len())
    }

    /// Wettable cells whose samples a volume holds, and how many.
    fn held_samples(&self, index: usize) -> Vec<(usize, u64)> {
        let inside = Inside::of(&self.volumes[index]);
        let samples = &self.grid.samples;
        let wettable =
            (0..self.grid.cells.len()).filter(|&cell| self.grid.cells.capacities[cell] > 0);
        let held = wettable.map(|cell| {
            let own = samples.places[samples.of_cell(cell)].iter();
            (cell, own.filter(|&&place| inside.holds(place)).count() as u64)
        });
        held.filter(|(_, count)| *count > 0).collect()
    }
}
