//! Volumes of the grid: paint spills from one to the next, and they grow with their paint.

use glam::Vec3;
use paint::layer::Cell;

use super::error::WorldError;
use super::state::{BIRTH, NONE, World};
use super::step_device::OpenedDevice;
use crate::volume::Volume;
use crate::wetting::Grid;

/// Share of the giver's radius within which a volume begins: less than its deepest dents, as a rule.
const HIDDEN: f32 = 0.7;

/// Level of detail of the volumes of the grid.
const DETAIL: u8 = 2;

impl World {
    /// The wet volume in a cell; without one, a new one at `place` in the region.
    pub(super) fn volume_in(
        &mut self,
        cell: usize,
        place: Vec3,
        region: u16,
    ) -> Result<usize, WorldError> {
        if self.of_cell[cell] != NONE {
            return Ok(self.of_cell[cell] as usize);
        }
        let index = self.begin(place, BIRTH * self.scale.cell, DETAIL)?;
        let volume = &mut self.volumes[index];
        volume.cell = Some(cell as u32);
        volume.region = region;
        volume.normal = self.grid.cells.normals[cell];
        volume.body = self.grid.bodies.of_cells[cell];
        self.of_cell[cell] = index as u32;
        Ok(index)
    }

    /// Begins the volume of a cell that paint reaches from a neighbour. It begins inside of the
    /// giver's volume and moves to where it enters its cell no faster than volumes grow, so that
    /// paint shows only where it has soaked to.
    fn soak(&mut self, cell: usize, giver: usize) -> Result<(), WorldError> {
        let Volume { center, radius, region, .. } = self.volumes[self.of_cell[giver] as usize];
        let Grid { cells, reach, .. } = &*self.grid;
        let full = reach.radius(giver, cells.capacities[giver], 0.0);
        let mut entrance = self.grid.entrance(cell, cells.centers[giver]);
        if entrance.distance(cells.centers[giver]) > full {
            // The giver never comes there: its own surface does.
            entrance = self.grid.entrance(giver, entrance);
        }
        let begin = center + (entrance - center).clamp_length_max(HIDDEN * radius);
        let index = self.volume_in(cell, begin, region)?;
        self.volumes[index].target_center = entrance;
        Ok(())
    }

    /// One step of spilling between all wet volumes of the grid.
    pub(super) fn spill(&mut self, device: Option<&mut OpenedDevice>) -> Result<(), WorldError> {
        if self.settled {
            return Ok(());
        }
        let grid = std::sync::Arc::clone(&self.grid);
        let mut reached = Vec::new();
        let mut over = false;
        for volume in self.volumes.iter().filter(|volume| !volume.dry) {
            let Some(cell) = volume.cell.map(|cell| cell as usize) else { continue };
            if volume.paint.volume() > grid.cells.capacities[cell] {
                over = true;
                let others = grid.graph.links(cell).map(|link| grid.graph.others[link]);
                reached.extend(others.filter(|&other| self.of_cell[other as usize] == NONE));
            }
        }
        if !over {
            return Ok(());
        }
        self.paint.fill(Cell::default());
        for volume in self.volumes.iter().filter(|volume| !volume.dry) {
            if let Some(cell) = volume.cell {
                self.paint[cell as usize] = volume.paint;
            }
        }
        reached.sort_unstable();
        reached.dedup();
        // Near the limit paint stays where it is wet.
        let births = self.has_room(reached.len(), DETAIL).is_ok();
        let born = match device {
            None => {
                let cells = (&grid.graph, &grid.cells);
                self.spilling.step(cells, &mut self.paint, births)
            }
            Some(OpenedDevice { device, spilling, .. }) => {
                spilling.step(device, (&self.spilling, &grid), &mut self.paint, births)?
            }
        };
        for birth in born {
            let cell = birth.cell as usize;
            let giver = birth.giver as usize;
            self.soak(cell, giver)?;
        }
        let mut settled = true;
        for index in 0..self.volumes.len() {
            let Some(cell) = self.volumes[index].cell.filter(|_| !self.volumes[index].dry) else {
                continue;
            };
            let now = self.paint[cell as usize];
            if now != self.volumes[index].paint {
                self.set_paint(index, now);
                settled = false;
            }
        }
        self.settled = settled;
        Ok(())
    }

    /// Gives a volume of the grid its paint, and sends its centre from where it enters towards the
    /// middle of its cell as the cell fills: a full cell's volume holds all its surface.
    pub(super) fn set_paint(&mut self, index: usize, paint: Cell) {
        let Some(cell) = self.volumes[index].cell.map(|cell| cell as usize) else { return };
        let capacity = self.grid.cells.capacities[cell].max(1) as f32;
        // Squared: a ball that is as wide as its paint then ends where the paint of its cell does.
        let filled = |paint: &Cell| {
            let share = (paint.volume() as f32 / capacity).min(1.0);
            share * share
        };
        let volume = &mut self.volumes[index];
        let before = filled(&volume.paint);
        let now = filled(&paint);
        if now > before {
            let way = self.grid.cells.centers[cell] - volume.target_center;
            let share = if now < 1.0 { (now - before) / (1.0 - before) } else { 1.0 };
            if self.grid.cells.capacities[cell] > 0 {
                volume.target_center += way * share;
            }
        }
        volume.paint = paint;
        self.settled = false;
        volume.target_radius = match paint.volume() {
            0 => 0.0,
            amount => {
                let roughness = self.settings.motion.microstructure;
                let radius = self.grid.reach.radius(cell, amount, roughness);
                radius.max(BIRTH * self.scale.cell)
            }
        };
        volume.rests_under = 0;
    }
}
