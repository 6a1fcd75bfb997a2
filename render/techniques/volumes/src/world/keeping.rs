//! Regions that volumes stay in.

use std::sync::Arc;

use glam::Vec3;

use super::error::WorldError;
use super::settings::WorldSettings;
use super::state::World;
use crate::motion::KeepIn;
use crate::wetting::Spilling;

impl World {
    /// Keeps all volumes inside of a region from now on. No paint spills to surface outside of it;
    /// paint that is there already stays, in volumes that shrink to dots.
    ///
    /// # Errors
    /// If a number of the region is out of its range.
    pub fn keep(&mut self, region: KeepIn) -> Result<(), WorldError> {
        let mut kept = self.surroundings.clone();
        kept.regions.push(region);
        kept.check()?;
        let regions = &kept.regions;
        let inside = |at: Vec3| regions.iter().all(|region| region.way_back(at, 0.0) == Vec3::ZERO);
        let grid = self.whole.within(inside);
        let WorldSettings { rate, slope, .. } = self.settings;
        self.spilling = Spilling::new(&grid.cells, self.scale.cell, rate, slope)?;
        for volume in self.volumes.iter_mut().filter(|volume| !volume.dry) {
            let cell = volume.cell.map_or(0, |cell| cell as usize);
            let wettable = volume.cell.is_some() && grid.cells.capacities[cell] > 0;
            if wettable && !inside(volume.target_center) {
                volume.target_center = grid.cells.centers[cell];
            }
            if wettable && !inside(volume.center) {
                volume.center = volume.target_center;
            }
        }
        self.grid = Arc::new(grid);
        self.surroundings = kept;
        self.settled = false;
        for index in 0..self.volumes.len() {
            if self.volumes[index].cell.is_some() && !self.volumes[index].dry {
                self.set_paint(index, self.volumes[index].paint);
            }
        }
        Ok(())
    }
}
